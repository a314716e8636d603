#include "scene/recovery.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "base/process.h"
#include "scene/files.h"
#include "scene/session.h"
#include "support/open.h"
#include "support/zombie.h"

using namespace viete;
using namespace viete::scene;
namespace fs = std::filesystem;

TEST_CASE("only_the_work_of_programs_that_have_ended_is_left_over") {
  const test::TemporaryFolder folder;
  CHECK(find_leftovers(folder / "none").empty());
  test::put_file(recovery_file(folder.path()), "{}");
  test::put_file(set_aside_file(folder.path()), "{}");
  test::put_file(folder / "999999999-1.viete", "{}");
  test::put_file(folder / "999999999-1_2.viete", "{}");
  test::put_file(folder / "999999999-1.viete.123-0.part", "half");
  const auto leftovers = find_leftovers(folder.path());
  REQUIRE(leftovers.size() == 2);
  CHECK(leftovers[0].file.filename().string().starts_with("999999999-1"));
}

TEST_CASE("the_work_of_a_program_that_has_ended_and_is_still_listed_is_left_over_or_goes") {
  const test::TemporaryFolder folder;
  const test::Zombie zombie;
  test::put_file(folder / (zombie.name + ".viete"), "{}");
  test::put_file(folder / (zombie.name + "_1.discarded"), "{}");
  CHECK(find_leftovers(folder.path()).size() == 1);
  remove_discarded(folder.path());
  CHECK(folder.entries() == 1);
}

TEST_CASE("leftovers_come_newest_first_and_are_called_by_what_they_belong_to") {
  const test::CubeFiles files;
  Workspace w;
  REQUIRE(test::load_model(w, files.model, files.cage));
  const fs::path folder = files / "recovery";
  fs::create_directories(folder);
  const auto put = [&](const std::string& name, int minutes_ago) {
    test::put_file(folder / name, session_text(session_of(w), folder / name, false));
    fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::minutes(minutes_ago));
  };
  put("999999999-1.viete", 30);
  w.saved.session = files / "walk.viete";
  put("999999999-2.viete", 10);
  test::put_file(folder / "999999999-3.viete", "torn");
  fs::last_write_time(folder / "999999999-3.viete",
                      fs::file_time_type::clock::now() - std::chrono::minutes(20));
  const auto leftovers = find_leftovers(folder);
  REQUIRE(leftovers.size() == 3);
  CHECK(leftovers[0].name == "walk.viete");
  CHECK(leftovers[1].name == "999999999-3.viete");
  CHECK(leftovers[2].name == "model.obj");
}

TEST_CASE("names_for_work_set_aside_do_not_collide") {
  const test::TemporaryFolder folder;
  const fs::path first = set_aside_file(folder.path());
  test::put_file(first, "{}");
  CHECK(set_aside_file(folder.path()) != first);
}

TEST_CASE("what_was_discarded_comes_back_or_goes_with_its_program") {
  const test::TemporaryFolder folder;
  const fs::path file = folder / "999999999-1.viete";
  test::put_file(file, "work");
  const DiscardedLeftover discarded = discard({file, "work", 0});
  CHECK(find_leftovers(folder.path()).empty());
  CHECK(test::file_bytes(discarded.aside) == "work");
  undo_discard(discarded);
  CHECK(test::file_bytes(file) == "work");
  CHECK_THROWS_AS(undo_discard(discarded), base::Error);

  const DiscardedLeftover again = discard({file, "work", 0});
  test::put_file(folder / "999999999-1_1.discarded", "of a program that was killed");
  remove_discarded(folder.path());
  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("times_of_today_are_told_without_the_day") {
  std::tm noon{};
  noon.tm_year = 126, noon.tm_mon = 4, noon.tm_mday = 3, noon.tm_hour = 12, noon.tm_min = 5,
  noon.tm_isdst = -1;
  const std::time_t time = std::mktime(&noon);
  CHECK(when(time, time + 3600) == "today 12:05");
  CHECK(when(time, time + 86400) == "May 03, 12:05");
}
