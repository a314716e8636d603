#include "base/process.h"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <string>

using namespace viete::base;

TEST_CASE("this_process_runs_and_its_number_with_another_start_does_not") {
  const std::string name = process_name();
  CHECK(name.starts_with(std::to_string(getpid()) + "-"));
  CHECK(process_runs(name));
  CHECK_FALSE(process_runs(name + "0"));
  CHECK_FALSE(process_runs(std::to_string(getpid())));
}

TEST_CASE("a_process_that_has_ended_does_not_run") {
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const pid_t child = fork();
  if (child == 0) {
    const std::string name = process_name();
    _exit(write(ends[1], name.data(), name.size()) > 0 ? 0 : 1);
  }
  char text[64];
  const ssize_t size = read(ends[0], text, sizeof text);
  REQUIRE(size > 0);
  waitpid(child, nullptr, 0);
  CHECK_FALSE(process_runs(std::string(text, static_cast<std::size_t>(size))));
}

TEST_CASE("what_is_no_process_name_does_not_run") {
  for (const char* name : {"", "-", "abc", "12x-5", "../self-1", "99999999999999999999-1"}) {
    CHECK_FALSE_MESSAGE(process_runs(name), name);
  }
}
