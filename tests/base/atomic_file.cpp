#include "base/atomic_file.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/error.h"
#include "base/os.h"
#include "base/process.h"
#include "base/progress.h"
#include "support/folder.h"

namespace fs = std::filesystem;
using namespace viete;
using base::check_replaceable;
using base::replace_file;

TEST_CASE("a_file_is_made_and_replaced_and_nothing_else_is_left") {
  const test::TemporaryFolder folder;
  replace_file(folder / "a", "one");
  CHECK(test::file_bytes(folder / "a") == "one");
  replace_file(folder / "a", "second", base::Durability::process);
  CHECK(test::file_bytes(folder / "a") == "second");
  check_replaceable(folder / "a");
  check_replaceable(folder / "b");
  CHECK(test::file_bytes(folder / "a") == "second");
  CHECK(folder.entries() == 1);
}

TEST_CASE("a_replaced_file_keeps_its_permissions_without_setuid_and_a_link_stays_a_link") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a", "one");
  fs::create_symlink("a", folder / "link");
  for (const auto& [before, after] : {std::pair{0640, 0640}, {07755, 0755}}) {
    REQUIRE(chmod((folder / "a").c_str(), before) == 0);
    replace_file(folder / "link", "two");
    CHECK(fs::is_symlink(folder / "link"));
    CHECK(test::file_bytes(folder / "a") == "two");
    CHECK(fs::status(folder / "a").permissions() == fs::perms(after));
  }
}

TEST_CASE("unwritable_targets_are_errors_that_name_the_file") {
  const test::TemporaryFolder folder;
  for (const fs::path& path :
       {folder / "none" / "a", folder / "", fs::path("/dev/null"), fs::path("/proc/a"), fs::path("")}) {
    CHECK_THROWS_AS_MESSAGE(replace_file(path, "x"), base::Error, path.string());
    CHECK_THROWS_AS_MESSAGE(check_replaceable(path), base::Error, path.string());
  }
  CHECK(fs::is_character_file("/dev/null"));
  CHECK(folder.entries() == 0);
}

TEST_CASE("signals_end_the_process_without_a_part") {
  for (const int number : {SIGINT, SIGTERM, SIGHUP}) {
    const test::TemporaryFolder folder;
    const pid_t child = fork();
    if (child == 0) {
      base::remove_parts_at_signals();
      replace_file(folder / "a", [number](const auto&) { raise(number); });
      _exit(0);
    }
    int status = 0;
    REQUIRE(waitpid(child, &status, 0) == child);
    CHECK((WIFSIGNALED(status) && WTERMSIG(status) == number));
    CHECK(folder.entries() == 0);
  }
}

TEST_CASE("a_failure_while_writing_leaves_the_old_file_and_no_part") {
  const test::TemporaryFolder folder;
  replace_file(folder / "a", "precious");
  {
    const test::FullDisk full(1000);
    CHECK_THROWS_AS(replace_file(folder / "a", std::string(100000, 'x')), base::Error);
  }
  CHECK(test::file_bytes(folder / "a") == "precious");
  CHECK(folder.entries() == 1);
}

TEST_CASE("generated_content_replaces_the_file_once_it_is_complete") {
  const test::TemporaryFolder folder;
  replace_file(folder / "a", [&](const base::ByteSink& out) {
    out("one ");
    out("and two");
    CHECK_FALSE(std::filesystem::exists(folder / "a"));
  });
  CHECK(test::file_bytes(folder / "a") == "one and two");
  const auto fails = [](const base::ByteSink& out) {
    out("half");
    throw base::Cancelled();
  };
  CHECK_THROWS_AS(replace_file(folder / "a", fails), base::Cancelled);
  CHECK(test::file_bytes(folder / "a") == "one and two");
  CHECK(folder.entries() == 1);
}

TEST_CASE("grouped_files_are_replaced_together_or_not_at_all") {
  const test::TemporaryFolder folder;
  replace_file(folder / "a", "old a");
  const auto put = [&](base::FilesTogether& files, const char* name, const char* bytes) {
    files.put(folder / name, [&](const base::ByteSink& out) { out(bytes); });
  };
  const auto write_all = [&](bool second_fails) {
    base::FilesTogether files;
    put(files, "a", "new a");
    CHECK(test::file_bytes(folder / "a") == "old a");
    put(files, second_fails ? "no folder/b" : "b", "new b");
    files.replace();
  };
  CHECK_THROWS_AS(write_all(true), base::Error);
  CHECK(test::file_bytes(folder / "a") == "old a");
  CHECK(folder.entries() == 1);
  write_all(false);
  CHECK(test::file_bytes(folder / "a") == "new a");
  CHECK(test::file_bytes(folder / "b") == "new b");
  CHECK(folder.entries() == 2);
}

TEST_CASE("a_write_protected_file_stays_even_where_root_writes") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a", "precious");
  fs::permissions(folder / "a", fs::perms::owner_read | fs::perms::group_write);
  fs::create_symlink("a", folder / "link");
  for (const char* name : {"a", "link"}) {
    CHECK_THROWS_WITH_AS(replace_file(folder / name, "x"), doctest::Contains("write-protected"), base::Error);
    CHECK_THROWS_WITH_AS(replace_file(folder / name, "x"), doctest::Contains(base::os::way_to_make_writable),
                         base::Error);
    CHECK_THROWS_WITH_AS(check_replaceable(folder / name), doctest::Contains("write-protected"), base::Error);
  }
  CHECK(test::file_bytes(folder / "a") == "precious");
  CHECK(folder.entries() == 2);
}

TEST_CASE("hard_links_are_reported_before_they_are_replaced") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a", "precious");
  fs::create_hard_link(folder / "a", folder / "b");
  CHECK_THROWS_WITH_AS(check_replaceable(folder / "a"), doctest::Contains("2 names"), base::Error);
  CHECK(test::file_bytes(folder / "a") == "precious");
  replace_file(folder / "a", "x");
  CHECK(test::file_bytes(folder / "a") == "x");
  CHECK(test::file_bytes(folder / "b") == "precious");
  check_replaceable(folder / "a");
}

TEST_CASE("parts_of_killed_programs_are_removed_at_the_next_write") {
  const test::TemporaryFolder folder;
  const std::string running = "a." + base::process_name() + "-7.part", stale = "a.999999999-1-0.part";
  const char* others[] = {"b.999999999-1-0.part",     "a.part",
                          "a.999999999-0.part",       "a.x-1-0.part",
                          "a.999999999-1-0.part.obj", "a.b.999999999-1-0.part"};
  for (const char* name : others) test::put_file(folder / name, "of somebody else");
  test::put_file(folder / running, "half");
  test::put_file(folder / stale, "half");
  replace_file(folder / "a", "whole");
  CHECK_FALSE(fs::exists(folder / stale));
  CHECK(fs::exists(folder / running));
  for (const char* name : others) CHECK_MESSAGE(fs::exists(folder / name), name);
  CHECK(folder.entries() == std::size(others) + 2);
}

TEST_CASE("names_of_up_to_255_bytes_are_written_and_their_parts_removed") {
  for (const std::size_t length : {191, 192, 244, 255}) {
    const test::TemporaryFolder folder;
    const std::string name(length, 'x');
    test::put_file(folder / (std::string(191, 'x') + ".999999999-1-0.part"), "half");
    replace_file(folder / name, "whole");
    CHECK(test::file_bytes(folder / name) == "whole");
    CHECK(folder.entries() == 1);
  }
}

TEST_CASE("stale_parts_of_a_folder_are_removed_and_active_ones_kept") {
  const test::TemporaryFolder folder;
  base::remove_stale_parts(folder / "none");
  fs::create_directory(folder / "d.999999999-1-0.part");
  for (const char* name : {"a.999999999-1-0.part", "b.999999999-1-3.part", "locked.999999999-1-0.part", "a"})
    test::put_file(folder / name, "x");
  test::put_file(folder / ("a." + base::process_name() + "-0.part"), "x");
  const int handle = open((folder / "locked.999999999-1-0.part").c_str(), O_RDONLY);
  REQUIRE(flock(handle, LOCK_EX) == 0);  // simulates a program in another container
  base::remove_stale_parts(folder.path());
  CHECK(folder.entries() == 4);
  CHECK_FALSE(fs::exists(folder / "a.999999999-1-0.part"));
  CHECK_FALSE(fs::exists(folder / "b.999999999-1-3.part"));
  close(handle);
  base::remove_stale_parts(folder.path());
  CHECK_FALSE(fs::exists(folder / "locked.999999999-1-0.part"));
  for (const char* name : {"b.999999999-1-0.part", "b.-1-0.part"}) test::put_file(folder / name, "x");
  base::remove_leftovers_beside(folder / "a");
  CHECK_FALSE(fs::exists(folder / "b.999999999-1-0.part"));
  CHECK(fs::exists(folder / "b.-1-0.part"));
  base::remove_leftovers_beside(folder / "none" / "a");
}

TEST_CASE("taken_names_are_numbered") {
  const test::TemporaryFolder folder;
  CHECK(base::unused_name(folder / "a.b.png") == folder / "a.b.png");
  test::put_file(folder / "a.b.png", "x");
  fs::create_symlink("nowhere", folder / "a.b-2.png");
  CHECK(base::unused_name(folder / "a.b.png") == folder / "a.b-3.png");
  CHECK(base::unused_name(folder / "none" / "a") == folder / "none" / "a");
  base::FilesTogether files;
  const auto put = [&](const char* bytes) {
    return files.put_new(folder / "a.b.png", bytes).filename().string();
  };
  CHECK(put("third") == "a.b-3.png");
  CHECK(put("fourth") == "a.b-4.png");
  CHECK(put("third") == "a.b-3.png");
  files.replace();
  CHECK(put("fourth") == "a.b-4.png");
  CHECK(test::file_bytes(folder / "a.b-3.png") == "third");
}
