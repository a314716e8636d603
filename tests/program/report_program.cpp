#include <nlohmann/json.hpp>

#include "formats/write.h"
#include "program/command_line.h"
#include "support/shapes.h"
#include "support/xml.h"

using namespace viete;
using namespace viete::test;

namespace {

/// The files of a small model and its posed cage.
struct ReportedModel {
  explicit ReportedModel(const TemporaryFolder& scratch) {
    auto cube = test::moved(test::cube(), 1.5);
    formats::write(scratch / "ball.obj", test::sphere(3));
    formats::write(scratch / "box.obj", cube);
    for (auto& p : cube.positions) p[2] *= 2;
    formats::write(scratch / "pose_tall.obj", cube);
    files = quoted(scratch / "ball.obj") + " " + quoted(scratch / "box.obj") + " " +
            quoted(scratch / "pose_tall.obj");
  }
  std::string files;
};

}  // namespace

TEST_CASE("a_quick_report_is_one_page_that_needs_nothing_else_with_its_numbers_beside_it") {
  const TemporaryFolder scratch;
  const ReportedModel model(scratch);
  const fs::path folder = scratch / "out";
  const std::string command = "report --quick " + model.files + " -o " + quoted(folder);
  const auto outcome = run(command);
  REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "index.html and its numbers"));
  const std::string page = file_bytes(folder / "index.html");
  CHECK(xml_problem(page) == "");
  for (const char* part : {"Figure 3 of the paper", "tall", "viete report ", "$", "Deformers"})
    CHECK_MESSAGE(page.find(part) != std::string::npos, part);
  const auto json = nlohmann::json::parse(file_bytes(folder / "report.json"));
  CHECK(json["figure"] == "report");
  CHECK(json["deformation"][0]["vertices"] == 258);
  CHECK(json["shapes"].size() == 3);
  // The command does not overwrite a page that it has not written, nor any other file.
  put_file(folder / "index.html", "<html>mine</html>");
  put_file(folder / "notes.txt", "mine");
  const auto refused = run(command);
  CHECK(refused.code == 1);
  CHECK(mentions(refused, "not a report page"));
  CHECK(file_bytes(folder / "index.html") == "<html>mine</html>");
  CHECK(file_bytes(folder / "notes.txt") == "mine");
}

TEST_CASE("a_cancelled_report_leaves_no_files") {
  const TemporaryFolder scratch;
  const fs::path folder = scratch / "out";
  const auto ended = ended_by("INT", scratch.path(), "report -o out", "said", "out");
  CHECK(ended.code == 1);
  CHECK_MESSAGE(mentions(ended, "stopped; no file was changed"), ended.text);
  CHECK_FALSE(fs::exists(folder));
}

TEST_CASE("report_errors_are_reported_before_measuring") {
  const TemporaryFolder scratch;
  const ReportedModel model(scratch);
  put_file(scratch / "file", "mine");
  CHECK(mentions(run("report"), "--output is required"));
  const auto no_cage = run("report " + quoted(dragon) + " -o " + quoted(scratch / "out"));
  CHECK(no_cage.code == 2);
  CHECK(mentions(no_cage, "CAGE is required"));
  CHECK(mentions(run("report -o " + quoted(scratch / "file")), "this is not a folder"));
  CHECK(mentions(run("report -o " + quoted(scratch / "none/out")), "the folder cannot be created"));
  const auto other = run("report --quick " + model.files + " none.obj -o " + quoted(scratch / "out"));
  CHECK(other.code == 1);
  CHECK(mentions(other, "none.obj"));
  CHECK_FALSE(fs::exists(scratch / "out"));
}
