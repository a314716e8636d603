// The functions that differ between operating systems, on the system of this test.
#include "base/os.h"

#include <doctest/doctest.h>

#include <chrono>
#include <thread>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/process.h"
#include "support/folder.h"

using namespace viete;
namespace os = base::os;
namespace fs = std::filesystem;

TEST_CASE("a_file_has_one_identity_under_all_its_names") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a", "a");
  test::put_file(folder / "b", "a");
  CHECK(os::file_id(folder / "a") == os::file_id(folder.path() / "." / "a"));
  CHECK(os::file_id(folder / "a") != os::file_id(folder / "b"));
  CHECK_FALSE(os::file_id(folder / "c"));
  CHECK(os::count_names(folder / "a") == 1);
  fs::create_hard_link(folder / "a", folder / "link");
  CHECK(os::file_id(folder / "a") == os::file_id(folder / "link"));
  CHECK(os::count_names(folder / "a") == 2);
}

TEST_CASE("a_new_file_is_held_until_it_is_closed_and_replaces_another") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "old", "old");
  os::NewFile file;
  REQUIRE_FALSE(file.create(folder / "new", folder / "old"));
  CHECK(os::NewFile().create(folder / "new", {}) == std::errc::file_exists);
  CHECK_FALSE(file.write("some text"));
  os::remove_unless_held(folder / "new");
  CHECK(fs::exists(folder / "new"));
  CHECK_FALSE(file.take_rights(folder / "old"));
  CHECK_FALSE(file.flush_to_disk());
  CHECK_FALSE(file.close());
  fs::rename(folder / "new", folder / "old");
  CHECK(test::file_bytes(folder / "old") == "some text");
  os::remove_unless_held(folder / "old");
  CHECK_FALSE(fs::exists(folder / "old"));
  CHECK(os::NewFile().create(folder / "missing" / "a", {}) == std::errc::no_such_file_or_directory);
}

TEST_CASE("a_file_is_read_at_any_position_and_not_beyond_its_end") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a", "0123456789");
  const os::InputFile file(folder / "a");
  char bytes[4] = "";
  CHECK(file.read(7, bytes, 3));
  CHECK(std::string_view(bytes, 3) == "789");
  CHECK_FALSE(file.read(8, bytes, 3));
  CHECK_THROWS_AS(os::InputFile(folder / "missing"), std::system_error);
}

TEST_CASE("names_in_any_script_and_with_spaces_are_written_and_read") {
  const test::TemporaryFolder folder;
  for (const char* name : {"with space", "\xC3\xA9t\xC3\xA9", "\xE9\xBE\x99", "a'b&c"}) {
    CAPTURE(name);
    const fs::path inner = folder / name / name;
    fs::create_directory(inner.parent_path());
    base::replace_file(inner, "text");
    base::replace_file(inner, "other text");
    CHECK(test::file_bytes(inner) == "other text");
    CHECK(inner.filename().string() == name);
  }
  CHECK_FALSE(os::is_write_protected(folder / "with space" / "with space"));
  fs::permissions(folder / "with space" / "with space",
                  fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write,
                  fs::perm_options::remove);
  CHECK(os::is_write_protected(folder / "with space" / "with space"));
  CHECK_THROWS_AS(base::replace_file(folder / "with space" / "with space", "x"), base::Error);
}

TEST_CASE("a_process_is_known_by_number_and_start_while_it_runs") {
  const std::string name = base::process_name();
  CHECK(name.starts_with(std::to_string(os::process_id()) + "-"));
  CHECK(base::process_runs(name));
  CHECK_FALSE(base::process_runs(name + "1"));
  CHECK_FALSE(base::process_runs(std::to_string(os::process_id())));
  CHECK_FALSE(base::process_runs("x"));
  CHECK(fs::exists(os::program_file()));
}

// The child is this program, which lists its test cases.
TEST_CASE("a_child_gets_its_words_and_ends_and_a_missing_program_is_reported") {
  const auto ended = [](os::Child& child) {
    for (int i = 0; child.running() && i < 1000; ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return !child.running();
  };
  const std::string program = os::program_file().string();
  os::Child good({program, "--test-case=with \"quotes\" and \\"}, {"VIETE_A=b"});
  CHECK(ended(good));
  CHECK_FALSE(good.succeeded());  // no test case has this name
  os::Child other({program, "--test-case=a_file_is_read*"}, {});
  CHECK(ended(other));
  CHECK(other.succeeded());
  try {
    os::Child missing({"viete-no-such-program"}, {});
    FAIL("started");
  } catch (const os::StartFailure& failure) {
    CHECK(failure.missing);
  }
}

TEST_CASE("the_machine_reports_memory_and_processor_time") {
  CHECK(os::total_memory().value() > 1e8);
  CHECK(os::free_memory().value() <= os::total_memory().value());
  const double begun = os::thread_seconds();
  volatile double sum = 0;
  for (int i = 0; i < 20'000'000; ++i) sum = sum + i;
  CHECK(os::thread_seconds() - begun > 1e-4);
  CHECK(os::local_time(0).tm_year >= 69);
  CHECK_FALSE(os::home_folder().empty());
  os::set_variable("VIETE_TEST_VARIABLE", "\xC3\xA9");
  CHECK(os::variable("VIETE_TEST_VARIABLE") == "\xC3\xA9");
  CHECK(os::variable("VIETE_NO_SUCH_VARIABLE").empty());
}

#ifdef __linux__
#include <linux/landlock.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace {

// Returns bits for faults of the confinement. Called in a child process, which must not use doctest.
int freedoms(const test::TemporaryFolder& folder) {
  os::confine_process({folder / "in", folder / "one"});
  const auto reads = [&](const char* name) { return test::file_bytes(folder / name) == name; };
  int found = 0;
  if (!reads("in/a") || !reads("one")) found |= 1;
  if (reads("two") || std::ofstream(folder / "in/new") || std::ofstream(folder / "one")) found |= 2;
  if (socket(AF_INET, SOCK_STREAM, 0) >= 0 || errno != EPERM) found |= 4;
  if (execl("/bin/true", "true", nullptr) == 0 || errno != EPERM) found |= 8;
  return found;
}

}  // namespace

TEST_CASE("a_confined_process_reads_only_the_given_files_and_has_no_network") {
  if (syscall(SYS_landlock_create_ruleset, nullptr, 0, LANDLOCK_CREATE_RULESET_VERSION) < 1) {
    MESSAGE("this kernel has no Landlock: nothing to test");
    return;
  }
  const test::TemporaryFolder folder;
  fs::create_directory(folder / "in");
  for (const char* name : {"in/a", "one", "two"}) test::put_file(folder / name, name);
  const pid_t child = fork();
  if (child == 0) _exit(freedoms(folder));
  int status = 0;
  waitpid(child, &status, 0);
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 0);
  CHECK(std::ofstream(folder / "in/new").good());  // this process is not confined
}
#endif
