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
  for (const char* name : {"a.obj", "./a.obj", "link.obj"}) {
    CHECK_THROWS_AS(check_output(files / name, Content::surface, {files / "a.obj"}, false), base::Error);
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

TEST_CASE("numbers_and_plot_of_a_benchmark_are_two_files") {
  const test::TemporaryFolder files;
  CHECK_NOTHROW(app::BenchFiles{}.check());
  test::put_file(files / "a.json", "<svg");
  const app::BenchFiles same{.json = files / "a.json", .plot = files / "a.json"};
  CHECK_THROWS_AS(same.check(), base::Error);
}
