#include "base/process.h"

#include <doctest/doctest.h>
#include <unistd.h>

#include <string>

#include "support/zombie.h"

using namespace viete::base;

TEST_CASE("this_process_runs_and_its_number_with_another_start_does_not") {
  const std::string name = process_name();
  CHECK(name.starts_with(std::to_string(getpid()) + "-"));
  CHECK(process_runs(name));
  CHECK_FALSE(process_runs(name + "0"));
  CHECK_FALSE(process_runs(std::to_string(getpid())));
}

TEST_CASE("a_process_that_has_ended_does_not_run_whether_or_not_anybody_has_asked_how") {
  viete::test::Zombie zombie;
  CHECK_FALSE(process_runs(zombie.name));
  zombie.bury();
  CHECK_FALSE(process_runs(zombie.name));
}

TEST_CASE("what_is_no_process_name_does_not_run") {
  for (const char* name : {"", "-", "abc", "12x-5", "../self-1", "99999999999999999999-1"}) {
    CHECK_FALSE_MESSAGE(process_runs(name), name);
  }
}
