// viete bench: short runs of all benchmarks; checks the files and tables.
#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>
#include <vector>

#include "formats/write.h"
#include "pose/deformer.h"
#include "program/command_line.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::test;

TEST_CASE("small_benchmarks_run_and_write_json") {
  const WorkFolder f;
  const std::pair<std::string, std::vector<const char*>> cases[] = {
      {"sym3 --count 2000", {"copy"}},
      {"frame --vertices 2000", {"one vertex dragged"}},
      {"bind --faces 8 --rounds 1", {"50,000 vertices, 8 cage triangles", "plain loops", ">= 45"}}};
  for (const auto& [words, said] : cases) {
    const auto outcome = f.done("bench " + words + " --json a.json");
    for (const char* part : said) CHECK_MESSAGE(mentions(outcome, part), outcome.text);
    CHECK(fs::file_size(f / "a.json") > 100);
  }
}

TEST_CASE("a_frame_and_a_binding_are_those_of_the_model_and_cage_that_are_named") {
  const WorkFolder f;
  for (const std::string what : {"frame --vertices 500 ", "bind "}) {
    CHECK(mentions(f.done("bench " + what + "--rounds 1 " + in_cage + " --json a.json"),
                   "148 cage triangles"));  // the given cage has this number of triangles
    CHECK(nlohmann::json::parse(file_bytes(f / "a.json"))["bars"].empty());  // only generated cages have bars
  }
  const auto made = f.done("bench frame --rounds 1 --vertices 500 --faces 8,10 " + quoted(dragon));
  CHECK_MESSAGE(mentions(made, "500 vertices, 8 cage triangles"), made.text);
  f.refused("bench frame --faces 8 " + in_cage, 2, "excludes");
  f.refused("bench bind --json " + quoted(cage) + " " + in_cage, 1, "is an input file");
  f.refused("bench bind none.obj " + quoted(cage), 1, "none.obj");
}

TEST_CASE("every_deformer_is_compared_on_the_poses_that_are_named") {
  const TemporaryFolder scratch;
  const fs::path json = scratch / "modes.json", ball = scratch / "ball.obj", box = scratch / "box.obj",
                 tall = scratch / "pose_tall.obj";
  auto cube = test::moved(test::cube(), 1.5);
  formats::write(ball, test::sphere(2));
  formats::write(box, cube);
  for (auto& p : cube.positions) p[2] *= 2;
  formats::write(tall, cube);
  const std::string files = quoted(ball) + " " + quoted(box) + " " + quoted(tall) + " " + quoted(box);
  const auto outcome = run("bench modes --rounds 1 --radius 1000 " + files + " --json " + quoted(json));
  REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "66 vertices, 12 cage triangles, method fast, kernel "));
  for (const char* title : {"\ntall\n", "\nbox\n", "\nall 2 poses; "}) CHECK(mentions(outcome, title));
  std::istringstream lines(outcome.text);
  for (std::string line; std::getline(lines, line);) {
    const bool names_processor = line.starts_with("modes: ");  // this line may be long
    CHECK_MESSAGE((names_processor || line.size() <= 130), line);
  }
  const auto results = nlohmann::json::parse(file_bytes(json))["results"];
  for (const pose::Deformer& deformer : pose::valid_deformers())
    CHECK(mentions(outcome, pose::text(deformer)));
  CHECK(results.size() == pose::valid_deformers().size() + 1);  // one more for Preset::arap
  for (const std::size_t i : {0, 1, 2, 3, 4, 5})
    CHECK(results[i].value("deformer", "") == choices(pose::Preset{})[i].word);
  for (const auto& mode : results) {
    REQUIRE(mode["poses"].size() == 2);
    CHECK(double(mode["deviations"]["translation"]) < 1e-9);
    CHECK(double(mode["poses"][1]["energy"]) < 1e-9);  // pose 1 is the box at rest
  }
  const auto& mean_values = *std::find_if(results.begin(), results.end(),
                                          [](const auto& mode) { return mode["weights"] == "mean-value"; });
  CHECK(double(mean_values["poses"][0]["volume"]) == doctest::Approx(2));

  const auto stitched = run("bench modes --rounds 1 --arap --iterations 2 " + files);
  REQUIRE_MESSAGE(stitched.code == 0, stitched.text);
  for (pose::Deformer deformer : pose::valid_deformers()) {
    deformer.iterations = deformer.has_maps() ? 2 : 0;
    CHECK(mentions(stitched, pose::text(deformer)));
  }
}

TEST_CASE("missing_or_unfit_inputs_are_reported_before_modes_are_compared") {
  const WorkFolder f;
  f.refused("bench modes " + quoted(dragon), 2, "CAGE is required");
  f.refused("bench modes " + in_cage, 2, "POSE is required");
  f.refused("bench modes " + in_cage + " none.obj", 1, "none.obj");
  f.refused("bench modes " + in_cage + " " + quoted(dragon), 1,
            "dragon.ply");  // the model has more vertices than the cage
  f.refused("bench modes " + in_cage + " " + quoted(alert_pose) + " --json " + quoted(alert_pose), 1,
            "is an input file");
}

TEST_CASE("a_program_without_benchmarks_explains_how_to_install_them") {
  const TemporaryFolder scratch;
  fs::copy_file(build_dir() / "viete", scratch / "viete");
  const auto outcome = run_of(scratch.path(), "bench exp");
  CHECK(outcome.code == 1);
  CHECK(mentions(outcome, "viete: " + (scratch / "viete-bench").string() + ": No such file"));
  CHECK(mentions(outcome, "setup.sh bench"));
}

TEST_CASE("a_build_folder_without_benchmarks_builds_them_on_first_use") {
  const TemporaryFolder scratch;
  fs::copy_file(build_dir() / "viete", scratch / "viete");
  put_file(scratch / "CMakeCache.txt", "");
  fs::create_directory(scratch / "bin");
  put_file(scratch / "bin" / "cmake",
           "#!/bin/sh\n[ \"$1 $3 $4\" = '--build --target viete-bench' ] || exit 1\n"
           "printf '#!/bin/sh\\necho ran \"$@\"' >\"$2/viete-bench\"\n"
           "chmod +x \"$2/viete-bench\"\necho compiled\n");
  fs::permissions(scratch / "bin" / "cmake", fs::perms::owner_all);
  const std::string path = "PATH=" + (scratch / "bin").string() + ":\"$PATH\"";
  const auto first = run_of(scratch.path(), "bench exp --count 7", path);
  CHECK_MESSAGE(first.text ==
                    "viete: building the benchmarks before their first use\ncompiled\n"
                    "ran exp --count 7\n",
                first.text);
  CHECK(run_of(scratch.path(), "report -o x", path).text == "ran report -o x\n");
}

TEST_CASE("the_accuracy_tables_show_where_the_paper_fails_and_fast_does_not") {
  const TemporaryFolder scratch;
  for (const char* precision : {"", " --float"}) {
    const fs::path json = scratch.path() / "accuracy.json";
    const auto outcome = run("bench accuracy --count 64 --json " + quoted(json) + precision);
    REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
    for (const char* part :
         {"\n  zero ", "\n  gap ", "\n  spread ", "\n  scale ", "NaN 100\u00a0%", "Pade", "Direct"})
      CHECK(mentions(outcome, part));
    const auto tables = nlohmann::json::parse(file_bytes(json))["tables"];
    REQUIRE(tables.size() == 5);
    const double u = *precision ? 0x1p-24 : 0x1p-53;
    for (const auto& table : tables)
      for (const auto& row : table["rows"]) {
        const auto& fast = row["methods"]["Fast"];
        const double spread =
            table["by"] == "spread" ? double(row["value"]) : 35;  // other rows have a spread of at most 35
        CHECK(fast["nan"] == 0);
        CHECK(fast["worst"] <= (8 + 2.5 * spread) * u);
      }
    CHECK(tables[0]["rows"][6]["methods"]["ISD unguarded"]["nan"] == 1);
    CHECK(tables[2]["rows"][4]["methods"]["SD"]["worst"] > 1e4 * u);
  }
}
