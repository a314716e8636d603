// viete bench: short runs of every benchmark, with their files and tables.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "deform/scheme.h"
#include "mesh/formats/write.h"
#include "mesh/shapes.h"
#include "program/command_line.h"

using namespace viete;
using namespace viete::test;

TEST_CASE("small_benchmarks_run_and_write_json") {
  const TemporaryFolder scratch;
  for (const char* what : {"exp", "eigen", "frame", "sym3"}) {
    const fs::path json = scratch.path() / (std::string(what) + ".json");
    const auto outcome = run(std::string("bench ") + what + " --count 2000 --json " + quoted(json));
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    CHECK(mentions(outcome, what == std::string("frame") ? "floor" : "copy"));
    CHECK(fs::file_size(json) > 100);
  }
}

TEST_CASE("a_small_benchmark_of_binding_says_whether_its_bars_are_met") {
  const TemporaryFolder scratch;
  const fs::path json = scratch.path() / "bind.json";
  const auto outcome = run("bench bind --faces 8 --rounds 1 --json " + quoted(json));
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "50,000 vertices, 8 cage triangles"));
  CHECK(mentions(outcome, "plain loops"));
  CHECK(mentions(outcome, ">= 45"));
  CHECK(fs::file_size(json) > 100);
}

TEST_CASE("a_frame_and_a_binding_are_those_of_the_model_and_cage_that_are_named") {
  const TemporaryFolder scratch;
  const fs::path json = scratch / "frame.json";
  const std::string files = quoted(dragon) + " " + quoted(cage);
  for (const std::string what : {"frame --vertices 500 ", "bind "}) {
    const auto outcome = run("bench " + what + "--rounds 1 " + files + " --json " + quoted(json));
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    CHECK(mentions(outcome, "148 cage triangles"));  // its own
    std::ifstream in(json);
    CHECK(nlohmann::json::parse(in)["bars"].empty());  // bars are only written for generated cages
  }
  const auto made = run("bench frame --rounds 1 --vertices 500,600 --faces 8 " + quoted(dragon));
  CHECK_MESSAGE(mentions(made, "500 vertices, 8 cage triangles"), made.text);
  CHECK(run("bench frame --faces 8 " + files).code == 2);
  CHECK(mentions(run("bench bind --json " + quoted(cage) + " " + files), "is an input file"));
  CHECK(mentions(run("bench bind none.obj " + quoted(cage)), "none.obj"));
}

TEST_CASE("every_way_of_blending_is_compared_on_the_poses_that_are_named") {
  const TemporaryFolder scratch;
  const fs::path json = scratch / "modes.json", ball = scratch / "ball.obj", box = scratch / "box.obj",
                 tall = scratch / "pose_tall.obj";
  auto cube = test::moved(test::cube(), 1.5);
  mesh::write(ball, test::sphere(2));
  mesh::write(box, cube);
  for (auto& p : cube.positions) p[2] *= 2;
  mesh::write(tall, cube);
  const std::string files = quoted(ball) + " " + quoted(box) + " " + quoted(tall) + " " + quoted(box);
  const auto outcome = run("bench modes --rounds 1 --radius 1000 " + files + " --json " + quoted(json));
  REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "66 vertices, 12 cage triangles, method fast, kernel "));
  for (const char* title : {"\ntall ", "\nbox ", "\nall 2 poses "}) CHECK(mentions(outcome, title));
  std::istringstream lines(outcome.text);
  for (std::string line; std::getline(lines, line);) {
    const bool names_processor = line.starts_with("modes: ");  // the processor's name may be long
    CHECK_MESSAGE((names_processor || line.size() <= 130), line);
  }
  std::ifstream in(json);
  const auto results = nlohmann::json::parse(in)["results"];
  for (const deform::Scheme& scheme : deform::valid_schemes()) CHECK(mentions(outcome, deform::text(scheme)));
  CHECK(results.size() == deform::valid_schemes().size() + 1);  // and Way::arap
  for (const std::size_t i : {0, 1, 2, 3, 4, 5})
    CHECK(results[i].value("way", "") == deform::all_ways()[i].name);
  for (const auto& mode : results) {
    REQUIRE(mode["poses"].size() == 2);
    CHECK(double(mode["deviations"]["translation"]) < 1e-9);
    CHECK(double(mode["poses"][1]["energy"]) < 1e-9);  // the box is at rest
  }
  const auto& mean_values = *std::find_if(results.begin(), results.end(),
                                          [](const auto& mode) { return mode["weights"] == "mean-value"; });
  CHECK(double(mean_values["poses"][0]["volume"]) == doctest::Approx(2));
  CHECK(double(mean_values["poses"][0]["worst_shear"]) == doctest::Approx(2).epsilon(0.05));

  const auto stitched = run("bench modes --rounds 1 --stitched --iterations 2 " + files);
  REQUIRE_MESSAGE(stitched.code == 0, stitched.text);
  for (deform::Scheme scheme : deform::valid_schemes()) {
    scheme.iterations = scheme.has_maps() ? 2 : 0;
    CHECK(mentions(stitched, deform::text(scheme)));
  }
}

TEST_CASE("missing_or_unfit_inputs_are_reported_before_modes_are_compared") {
  const TemporaryFolder scratch;
  const std::string model = quoted(dragon), in_cage = model + " " + quoted(cage);
  const auto no_cage = run("bench modes " + model), no_pose = run("bench modes " + in_cage);
  CHECK(no_cage.code == 2);
  CHECK(mentions(no_cage, "CAGE is required"));
  CHECK(no_pose.code == 2);
  CHECK(mentions(no_pose, "POSE is required"));
  CHECK(run("bench modes " + in_cage + " none.obj").code == 1);
  const auto other = run("bench modes " + in_cage + " " + model);  // has another number of vertices
  CHECK(other.code == 1);
  CHECK(mentions(other, "dragon.ply"));
  const auto replaced = run("bench modes " + in_cage + " " + quoted(pose) + " --json " + quoted(pose));
  CHECK(mentions(replaced, "is an input file"));
}

TEST_CASE("benchmarks_are_drawn_as_svg_with_every_method_and_layout") {
  const TemporaryFolder scratch;
  const struct {
    const char* command;
    std::vector<const char*> names;
  } cases[] = {{"bench exp --count 3000 --float",
                {"Diag", "Improved SD", "Fast, blocks", "copy, planes", "Fast, full", "3,000 matrices"}},
               {"bench eigen --count 2000", {"QR", "Viete", "Fast", "copy"}}};
  for (const auto& c : cases) {
    const fs::path svg = scratch.path() / "plot.svg";
    const auto outcome = run(std::string(c.command) + " --plot " + quoted(svg));
    REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
    std::ifstream in(svg);
    const std::string text(std::istreambuf_iterator<char>(in), {});
    CHECK(text.rfind("<svg ", 0) == 0);
    CHECK(text.find("nan") == std::string::npos);
    CHECK(text.ends_with("</svg>\n"));
    for (const char* name : c.names)
      CHECK_MESSAGE(text.find(std::string(">") + name) != std::string::npos, name);
  }
}

TEST_CASE("numbers_and_plot_of_a_benchmark_are_two_files") {
  const TemporaryFolder scratch;
  const std::string file = quoted(scratch / "a.svg");
  const auto same = run("bench exp --count 2000 --json " + file + " --plot " + file);
  CHECK(same.code == 1);
  CHECK(mentions(same, "is an input file (the numbers)"));
}

TEST_CASE("a_program_without_benchmarks_explains_how_to_install_them") {
  const TemporaryFolder scratch;
  fs::copy_file(build_dir() / "viete", scratch / "viete");
  const auto outcome = run_of(scratch.path(), "bench exp");
  CHECK(outcome.code == 1);
  CHECK(mentions(outcome, "viete: " + (scratch / "viete-bench").string() + ": No such file"));
  CHECK(mentions(outcome, "setup.sh bench"));
}

TEST_CASE("the_accuracy_tables_show_where_the_paper_fails_and_fast_does_not") {
  const TemporaryFolder scratch;
  for (const char* precision : {"", " --float"}) {
    const fs::path json = scratch.path() / "accuracy.json";
    const auto outcome = run("bench accuracy --count 64 --json " + quoted(json) + precision);
    REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
    for (const char* part : {"| zero ", "| gap ", "| spread ", "| scale ", "NaN 100 %", "Pade", "Direct"})
      CHECK(mentions(outcome, part));
    std::ifstream in(json);
    const auto tables = nlohmann::json::parse(in)["tables"];
    REQUIRE(tables.size() == 5);
    const double u = *precision ? 0x1p-24 : 0x1p-53;
    for (const auto& table : tables) {
      for (const auto& row : table["rows"]) {
        const auto& fast = row["methods"]["Fast"];
        const double spread =
            table["by"] == "spread" ? double(row["value"]) : 35;  // maximum of the other rows
        CHECK(fast["nan"] == 0);
        CHECK(fast["worst"] <= (8 + 2.5 * spread) * u);
      }
    }
    CHECK(tables[0]["rows"][6]["methods"]["ISD unguarded"]["nan"] == 1);
    CHECK(tables[2]["rows"][4]["methods"]["SD"]["worst"] > 1e4 * u);
  }
}
