#include "base/atomic_file.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <csignal>

#include "base/error.h"
#include "support/folder.h"

namespace fs = std::filesystem;
using namespace viete;
using base::check_replaceable;
using base::replace_file;

TEST_CASE("a_file_is_made_and_replaced_and_nothing_else_is_left") {
  const test::TemporaryFolder folder;
  replace_file(folder / "a", "one");
  CHECK(test::file_bytes(folder / "a") == "one");
  replace_file(folder / "a", "second");
  CHECK(test::file_bytes(folder / "a") == "second");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a_replaced_file_keeps_its_permissions_and_a_link_stays_a_link") {
  const test::TemporaryFolder folder;
  replace_file(folder / "a", "one");
  fs::permissions(folder / "a", fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read);
  fs::create_symlink("a", folder / "link");
  replace_file(folder / "link", "two");
  CHECK(fs::is_symlink(folder / "link"));
  CHECK(test::file_bytes(folder / "a") == "two");
  CHECK(fs::status(folder / "a").permissions() ==
        (fs::perms::owner_read | fs::perms::owner_write | fs::perms::group_read));
}

TEST_CASE("what_cannot_be_written_is_an_error_that_names_the_file") {
  const test::TemporaryFolder folder;
  for (const fs::path& path :
       {folder / "none" / "a", folder / "", fs::path("/dev/null"), fs::path("/proc/a"), fs::path("")}) {
    CHECK_THROWS_AS_MESSAGE(replace_file(path, "x"), base::Error, path.string());
    CHECK_THROWS_AS_MESSAGE(check_replaceable(path), base::Error, path.string());
  }
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(folder.entries() == 0);
}

TEST_CASE("trying_a_place_leaves_it_as_it_was") {
  const test::TemporaryFolder folder;
  check_replaceable(folder / "a");
  CHECK(folder.entries() == 0);
  replace_file(folder / "a", "precious");
  check_replaceable(folder / "a");
  CHECK(test::file_bytes(folder / "a") == "precious");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a_failure_while_writing_leaves_the_old_file_and_no_rest") {
  const test::TemporaryFolder folder;
  replace_file(folder / "a", "precious");
  // A limit on the size of files stands in for a full disk.
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_FSIZE, &before) == 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{1000, before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  CHECK_THROWS_AS(replace_file(folder / "a", std::string(100000, 'x')), base::Error);
  REQUIRE(setrlimit(RLIMIT_FSIZE, &before) == 0);
  std::signal(SIGXFSZ, handler);
  CHECK(test::file_bytes(folder / "a") == "precious");
  CHECK(folder.entries() == 1);
}

TEST_CASE("without_waiting_for_the_disk_a_file_is_still_replaced_as_a_whole") {
  const test::TemporaryFolder folder;
  replace_file(folder / "a", "one");
  replace_file(folder / "a", "two", base::Outlives::program);
  CHECK(test::file_bytes(folder / "a") == "two");
  CHECK(folder.entries() == 1);
}

TEST_CASE("parts_are_written_one_after_the_other") {
  const test::TemporaryFolder folder;
  const std::string_view parts[] = {"one ", "", "and two"};
  replace_file(folder / "a", parts);
  CHECK(test::file_bytes(folder / "a") == "one and two");
}
