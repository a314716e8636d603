#include "app/output.h"

#include <doctest/doctest.h>

#include <filesystem>
#include <string>

#include "base/error.h"
#include "support/folder.h"

using namespace viete;
using app::check_output;
using app::Content;

namespace fs = std::filesystem;

TEST_CASE("a_new_file_and_an_empty_one_may_be_written") {
  const test::TemporaryFolder files;
  CHECK_NOTHROW(check_output({}, Content::json, {}, false));
  CHECK_NOTHROW(check_output(files / "new.png", Content::picture, {}, false));
  test::put_file(files / "empty.png", "");
  CHECK_NOTHROW(check_output(files / "empty.png", Content::picture, {}, false));
  CHECK_FALSE(fs::exists(files / "new.png"));
}

TEST_CASE("an_input_is_written_over_only_by_force_whatever_it_is_called") {
  const test::TemporaryFolder files;
  test::put_file(files / "a.obj", "v 0 0 0\n");
  fs::create_symlink(files / "a.obj", files / "link.obj");
  fs::create_symlink("link.obj", files / "link_of_link.obj");
  fs::create_directory_symlink(files.path(), files / "folder");
  for (const char* name : {"a.obj", "./a.obj", "link.obj", "link_of_link.obj", "folder/a.obj"}) {
    CHECK_THROWS_AS(check_output(files / name, Content::surface, {files / "a.obj"}, false), base::Error);
    CHECK_THROWS_AS(check_output(files / "a.obj", Content::surface, {files / name}, false), base::Error);
    CHECK_NOTHROW(check_output(files / name, Content::surface, {files / "a.obj"}, true));
  }
  CHECK_NOTHROW(check_output(files / "a.obj", Content::surface, {{}, files / "gone.obj"}, false));
}

TEST_CASE("a_result_takes_the_place_of_its_kind_only") {
  const test::TemporaryFolder files;
  test::put_file(files / "picture.png", "\x89PNG\r\n\x1a\nrest");
  test::put_file(files / "letter.png", "Dear all");
  test::put_file(files / "plot.svg", "<?xml version=\"1.0\"?><svg/>");
  CHECK_NOTHROW(check_output(files / "picture.png", Content::picture, {}, false));
  CHECK_NOTHROW(check_output(files / "plot.svg", Content::svg, {}, false));
  CHECK_THROWS_WITH_AS(check_output(files / "letter.png", Content::picture, {}, false),
                       doctest::Contains("is not a PNG picture"), base::Error);
  CHECK_THROWS_AS(check_output(files / "letter.png", Content::svg, {}, false), base::Error);
  CHECK_THROWS_AS(check_output(files / "picture.png", Content::json, {}, false), base::Error);
  CHECK_NOTHROW(check_output(files / "letter.png", Content::picture, {}, true));
}

TEST_CASE("who_is_refused_is_told_what_the_file_is_and_another_name") {
  const test::TemporaryFolder files;
  test::put_file(files / "a.obj", "v 0 0 0\n");
  test::put_file(files / "a-2.obj", "of a user");
  fs::create_hard_link(files / "a.obj", files / "second.obj");
  scene::FilesInUse in_use;
  in_use.add(files / "second.obj", scene::the_model);
  const auto refused = [&](const char* name, scene::Force force) -> std::string {
    try {
      check_output(files / name, Content::surface, in_use, force);
    } catch (const base::Error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(refused("a.obj", scene::Force::offered) ==
        (files / "a.obj").string() +
            ": this file is one of those that are read (the model), and would be replaced; choose another "
            "name, such as a-2-2.obj, or add --force");
  CHECK(refused("a.obj", scene::Force::none).ends_with("such as a-2-2.obj"));
  CHECK(refused("gone/../a.obj", scene::Force::none) != "");
  in_use.add(files / "not_there.obj", scene::the_cage);
  CHECK(refused("./not_there.obj", scene::Force::none).ends_with("such as not_there-2.obj"));
  CHECK(refused("a-2.obj", scene::Force::none) == "");
}

TEST_CASE("a_numbered_result_never_takes_the_place_of_what_is_read") {
  const test::TemporaryFolder files;
  test::put_file(files / "f_07.obj", "v 0 0 0\n");
  scene::FilesInUse in_use{files / "f_07.obj"};
  const fs::path pattern = files / "f_##.obj";
  for (const auto force : {scene::Force::none, scene::Force::given}) {
    CHECK_THROWS_WITH_AS(check_output(pattern, {1, 10}, in_use, force),
                         doctest::Contains("such as f_##-2.obj"), base::Error);
    CHECK_NOTHROW(check_output(pattern, {1, 6}, in_use, force));
    CHECK_NOTHROW(check_output(pattern, {1, 10, 4}, in_use, force));
  }
  CHECK_NOTHROW(check_output(pattern, scene::FrameSteps{}, in_use, scene::Force::none));
  CHECK_THROWS_AS(check_output(files / "f_07.obj", {1, 10}, in_use, scene::Force::offered), base::Error);
}

TEST_CASE("a_session_takes_the_place_of_a_session_only") {
  const test::TemporaryFolder files;
  test::put_file(files / "letter.viete", "Dear all");
  test::put_file(files / "old.viete", R"({"format": "viete session", "version": 1, "model": "a.obj"})");
  CHECK_THROWS_WITH_AS(check_output(files / "letter.viete", Content::session, {}, false),
                       doctest::Contains("is not a session"), base::Error);
  CHECK_NOTHROW(check_output(files / "old.viete", Content::session, {}, false));
}
