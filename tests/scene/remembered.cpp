#include "scene/workspace/remembered.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "support/folder.h"

using namespace viete;
using namespace viete::scene;

TEST_CASE("a_recent_file_stands_once_at_the_front_and_twelve_are_kept") {
  Remembered remembered;
  for (int i = 0; i < 20; ++i) remembered.add({"/m" + std::to_string(i) + ".obj", {}});
  CHECK(remembered.recent.size() == 12);
  CHECK(remembered.recent.front().file == "/m19.obj");
  remembered.add({"/m15.obj", {}});
  CHECK(remembered.recent.size() == 12);
  CHECK(remembered.recent.front().file == "/m15.obj");
  CHECK(remembered.recent[1].file == "/m19.obj");
}

TEST_CASE("what_is_remembered_comes_back") {
  const test::TemporaryFolder folder;
  Remembered remembered;
  CHECK(read_remembered(folder / "r.json") == remembered);
  remembered.add({"/a.ply", "/c.obj"});
  remembered.add({"/b.viete", {}});
  remembered.add({"/caf\xe9/a.ply", "/caf\xe9/c.obj"});
  remembered.folder =
      "/some\xff"
      "where";
  remembered.hints = false;
  write_remembered(folder / "r.json", remembered);
  CHECK(read_remembered(folder / "r.json") == remembered);
}

TEST_CASE("what_another_program_added_is_kept_behind") {
  const test::TemporaryFolder folder;
  Remembered mine, theirs;
  mine.add({"/mine.ply", {}});
  theirs.add({"/both.ply", {}});
  theirs.add({"/theirs.ply", {}});
  mine.add({"/both.ply", {}});
  write_remembered(folder / "r.json", theirs);
  write_remembered(folder / "r.json", mine);
  const auto all = read_remembered(folder / "r.json").recent;
  REQUIRE(all.size() == 3);
  CHECK(all[0].file == "/both.ply");
  CHECK(all[2].file == "/theirs.ply");
}

TEST_CASE("a_damaged_file_is_an_error_and_is_replaced_by_the_next_write") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "r.json", R"({"recent": [3]})");
  CHECK_THROWS_AS(read_remembered(folder / "r.json"), base::Error);
  Remembered remembered;
  remembered.add({"/a.ply", {}});
  write_remembered(folder / "r.json", remembered);
  CHECK(read_remembered(folder / "r.json") == remembered);
}
