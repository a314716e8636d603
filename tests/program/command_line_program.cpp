// The program as a shell sees it: subcommands, outputs, errors, exit codes.
#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "mesh/read.h"
#include "mesh/write.h"
#include "render/image.h"
#include "support/data.h"

namespace fs = std::filesystem;
using namespace viete;

namespace {

struct Outcome {
  int code = -1;
  std::string text;  ///< stdout and stderr
};

Outcome run(const std::string& arguments, const std::string& environment = "") {
  const std::string command =
      environment + " '" + test::build_dir().string() + "/viete' " + arguments + " 2>&1 </dev/null";
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return outcome;
}

std::string quoted(const fs::path& path) {
  return "'" + path.string() + "'";
}

struct Scratch {
  fs::path folder = fs::temp_directory_path() / ("viete-test-command-line-" + std::to_string(getpid()));
  Scratch() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~Scratch() { fs::remove_all(folder); }
};

const fs::path dragon = test::assets_dir() / "dragon" / "dragon.ply",
               cage = test::assets_dir() / "dragon" / "cage.obj";
const fs::path pose = test::assets_dir() / "dragon" / "pose_alert.obj";

bool mentions(const Outcome& outcome, const std::string& text) {
  return outcome.text.find(text) != std::string::npos;
}

}  // namespace

TEST_CASE("help_is_there_for_the_program_and_every_subcommand") {
  const auto top = run("--help");
  CHECK(top.code == 0);
  for (const char* command : {"view", "render", "deform", "bind", "info", "bench"}) {
    CHECK_MESSAGE(mentions(top, command), command);
    const auto help = run(std::string(command) + " --help");
    CHECK(help.code == 0);
    CHECK(help.text.size() > 100);
  }
  CHECK(mentions(top, "Exit codes"));
  CHECK(run("--version").code == 0);
}

TEST_CASE("a_wrong_command_line_exits_with_2_and_says_what_is_wrong") {
  CHECK(run("render").code == 2);
  CHECK(run("deform a b").code == 2);
  CHECK(run("render a b -o x.png --size 12").code == 2);
  CHECK(run("render a b -o x.png --method best").code == 2);
  CHECK(run("bench nothing").code == 2);
  CHECK(mentions(run("deform a b"), "viete: --"));
  const Outcome lost = run("bench exp --json /no/such/folder/exp.json");  // before the work, not after it
  CHECK(lost.code == 2);
  CHECK(mentions(lost, "/no/such/folder/exp.json: "));
}

TEST_CASE("deform_writes_the_deformed_mesh_in_the_order_of_the_model") {
  const Scratch scratch;
  const fs::path out = scratch.folder / "out.obj";
  const auto outcome =
      run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose) + " -o " + quoted(out));
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  const auto rest = mesh::read(dragon).surface, deformed = mesh::read(out).surface;
  REQUIRE(deformed.positions.size() == rest.positions.size());
  CHECK(deformed.triangles == rest.triangles);
  CHECK(deformed.positions != rest.positions);
}

TEST_CASE("deform_with_the_rest_cage_as_pose_gives_the_model") {
  const Scratch scratch;
  const fs::path out = scratch.folder / "out.ply";
  for (const char* coordinates : {"face", "mvc"}) {
    const auto outcome = run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(cage) +
                             " -o " + quoted(out) + " --coordinates " + coordinates);
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    const auto rest = mesh::read(dragon).surface, same = mesh::read(out).surface;
    const double diagonal = mesh::bounds(rest.positions).diagonal();
    double largest = 0;
    for (std::size_t i = 0; i < rest.positions.size(); ++i) {
      for (int k = 0; k < 3; ++k)
        largest = std::max(largest, std::abs(rest.positions[i][k] - same.positions[i][k]));
    }
    CHECK(largest < 1e-12 * diagonal);
  }
}

TEST_CASE("render_writes_a_picture_of_the_asked_size") {
  const Scratch scratch;
  const fs::path out = scratch.folder / "out.png";
  const auto outcome = run("render " + quoted(dragon) + " " + quoted(cage) + " -o " + quoted(out) +
                           " --size 320x200 --scale 2");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  const auto image = render::read_png(out);
  CHECK(image.width == 640);
  CHECK(image.height == 400);
  CHECK(image.pixel(5, 5) != image.pixel(320, 200));
}

TEST_CASE("bind_saves_what_render_then_takes_instead_of_binding") {
  const Scratch scratch;
  const fs::path file = scratch.folder / "dragon.binding", out = scratch.folder / "out.png",
                 same = scratch.folder / "same.png";
  const std::string scene = quoted(dragon) + " " + quoted(cage),
                    view = " --pose " + quoted(pose) + " --size 320x200 -o ";
  const auto bound = run("bind " + scene + " -o " + quoted(file));
  CHECK_MESSAGE(bound.code == 0, bound.text);
  CHECK(mentions(bound, "bound 50,000 vertices to 148 cage triangles in "));
  CHECK(mentions(bound, "compressed to 3e-05 from "));
  REQUIRE(run("render " + scene + view + quoted(out)).code == 0);
  const auto rendered = run("render " + scene + view + quoted(same) + " --binding " + quoted(file));
  CHECK_MESSAGE(rendered.code == 0, rendered.text);
  CHECK(rendered.text == "");
  CHECK(render::read_png(out).rgba == render::read_png(same).rgba);
  CHECK(run("bind " + scene + " -o " + quoted(file) + " --tolerance 0 --coordinates mvc").code == 0);
  CHECK(run("render " + scene + view + quoted(same) + " --coordinates mvc --binding " + quoted(file)).code ==
        0);
}

TEST_CASE("a_binding_that_is_stale_or_none_stops_render_and_writes_no_picture") {
  const Scratch scratch;
  const fs::path file = scratch.folder / "dragon.binding", out = scratch.folder / "out.png";
  const std::string scene = quoted(dragon) + " " + quoted(cage);
  REQUIRE(run("bind " + scene + " -o " + quoted(file)).code == 0);
  for (const auto& [arguments, reason] :
       {std::pair{quoted(dragon) + " " + quoted(pose),
                  "is stale: the cage is not the one that it was made for"},
        {scene + " --coordinates mvc", "is stale: it is not for coordinates mvc"}}) {
    const auto outcome = run("render " + arguments + " -o " + quoted(out) + " --binding " + quoted(file));
    CHECK(outcome.code == 1);
    CHECK_MESSAGE(mentions(outcome, "dragon.binding: " + std::string(reason)), outcome.text);
    CHECK(mentions(outcome, "viete bind"));
  }
  const auto none = run("render " + scene + " -o " + quoted(out) + " --binding " + quoted(dragon));
  CHECK(none.code == 1);
  CHECK(mentions(none, "dragon.ply: this is no saved binding"));
  CHECK(!fs::exists(out));
}

TEST_CASE("a_reach_leaves_far_vertices_where_they_are_and_bad_ones_are_refused") {
  const Scratch scratch;
  const std::string scene = quoted(dragon) + " " + quoted(cage);
  auto dragged = mesh::read(cage).surface;
  dragged.positions[0][1] += 0.1 * mesh::bounds(dragged.positions).diagonal();
  const fs::path pulled = scratch.folder / "pulled.obj";
  mesh::write(pulled, dragged);
  const auto rest = mesh::read(dragon).surface.positions;
  const double rounding = 1e-9 * mesh::bounds(rest).diagonal();
  std::size_t last = rest.size() + 1;
  for (const char* reach : {"all", "6", "2"}) {  // the shorter, the fewer move
    const fs::path out = scratch.folder / "out.ply";
    const auto outcome =
        run("deform " + scene + " --pose " + quoted(pulled) + " -o " + quoted(out) + " --reach " + reach);
    REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
    const auto moved = mesh::read(out).surface.positions;
    std::size_t count = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) {
      double largest = 0;
      for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(rest[i][k] - moved[i][k]));
      count += largest > rounding;
    }
    CHECK(count > 0);
    CHECK(count < last);
    last = count;
  }
  CHECK(2 * last < rest.size());
  for (const char* bad : {"1.4", "0", "-2", "nan", "inf", "far", "2x", "''"}) {
    const auto outcome = run("deform " + scene + " --pose " + quoted(pulled) + " -o x.ply --reach " + bad);
    CHECK(outcome.code == 2);
    CHECK_MESSAGE(mentions(outcome, "--reach"), outcome.text);
  }
  const auto none = run("render " + scene + " -o x.png --coordinates mvc --reach 3");
  CHECK(none.code == 1);
  CHECK_MESSAGE(mentions(none, "mean value coordinates have no reach"), none.text);
}

TEST_CASE("a_binding_of_another_reach_is_stale") {
  const Scratch scratch;
  const fs::path file = scratch.folder / "dragon.binding", out = scratch.folder / "out.png";
  const std::string scene = quoted(dragon) + " " + quoted(cage);
  REQUIRE(run("bind " + scene + " -o " + quoted(file) + " --reach 3").code == 0);
  const std::string render =
      "render " + scene + " --size 320x200 -o " + quoted(out) + " --binding " + quoted(file);
  CHECK(run(render + " --reach 3").text == "");
  const auto stale = run(render);
  CHECK(stale.code == 1);
  CHECK_MESSAGE(mentions(stale, "is stale: it is for reach 3, not all"), stale.text);
}

TEST_CASE("bind_needs_a_cage_and_a_tolerance_that_makes_sense") {
  CHECK(run("bind " + quoted(dragon) + " -o x").code == 2);
  CHECK(run("bind " + quoted(dragon) + " " + quoted(cage)).code == 2);
  CHECK(run("bind " + quoted(dragon) + " " + quoted(cage) + " -o x --tolerance -1").code == 2);
  const auto outcome = run("bind " + quoted(dragon) + " " + quoted(cage) + " -o /nowhere/x");
  CHECK(outcome.code == 1);
  CHECK(mentions(outcome, "/nowhere/x: cannot be written"));
}

TEST_CASE("without_a_display_the_viewer_says_so_in_one_line_and_renders_a_picture") {
  const Scratch scratch;
  const auto outcome = run(quoted(dragon) + " " + quoted(cage),
                           "cd " + quoted(scratch.folder) + " && env -u DISPLAY -u WAYLAND_DISPLAY");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(std::count(outcome.text.begin(), outcome.text.end(), '\n') == 1);
  CHECK(mentions(outcome, "no window"));
  CHECK(render::read_png(scratch.folder / "viete.png").width == 1440);
}

TEST_CASE("the_viewer_starts_with_the_settings_of_its_command_line") {
  const Scratch scratch;
  const std::string here = "cd " + quoted(scratch.folder) + " && env -u DISPLAY -u WAYLAND_DISPLAY";
  const std::string scene = "view " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose);
  std::vector<std::vector<std::uint8_t>> pictures;
  for (const char* settings : {"", " --reach 2", " --coordinates mvc"}) {
    const auto outcome = run(scene + settings, here);
    REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
    pictures.push_back(render::read_png(scratch.folder / "viete.png").rgba);
  }
  CHECK(pictures[0] != pictures[1]);
  CHECK(pictures[0] != pictures[2]);
  CHECK(pictures[1] != pictures[2]);
  const auto both = run("view --coordinates mvc --reach 3", here);
  CHECK(both.code == 1);
  CHECK(mentions(both, "mean value coordinates have no reach"));
  const auto session = run("view a.viete --reach 3", here);
  CHECK(session.code == 2);
  CHECK(mentions(session, "--reach: the session a.viete has its own"));
}

TEST_CASE("the_bundled_model_is_found_from_any_working_directory") {
  const Scratch scratch;
  const auto outcome = run("", "cd " + quoted(scratch.folder) + " && env -u DISPLAY -u WAYLAND_DISPLAY");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(fs::exists(scratch.folder / "viete.png"));
}

TEST_CASE("info_of_no_file_is_of_the_bundled_model_and_its_cage") {
  const auto outcome = run("info");
  CHECK(outcome.code == 0);
  CHECK(mentions(outcome, "dragon/dragon.ply"));
  CHECK(mentions(outcome, "dragon/cage.obj"));
}

TEST_CASE("info_names_counts_and_goes_on_after_a_file_that_cannot_be_read") {
  const auto outcome = run("info /nowhere/missing.obj " + quoted(dragon));
  CHECK(outcome.code == 1);
  CHECK(mentions(outcome, "/nowhere/missing.obj"));
  CHECK(mentions(outcome, "vertices    50000"));
}

TEST_CASE("errors_name_file_and_reason_and_exit_with_1") {
  const Scratch scratch;
  const fs::path broken = scratch.folder / "broken.obj";
  std::ofstream(broken) << "v 0 0 0\nf 1 2 3\n";
  const fs::path out = scratch.folder / "out.png";
  for (const std::string& line : {"render " + quoted(broken) + " " + quoted(cage) + " -o " + quoted(out),
                                  "render " + quoted(dragon) + " " + quoted(broken) + " -o " + quoted(out),
                                  "deform " + quoted(dragon) + " " + quoted(cage) + " --pose " +
                                      quoted(broken) + " -o " + quoted(out)}) {
    const auto outcome = run(line);
    CHECK(outcome.code == 1);
    CHECK(mentions(outcome, "broken.obj:2"));
    CHECK_FALSE(fs::exists(out));
  }
  const auto unwritable = run("render " + quoted(dragon) + " " + quoted(cage) + " -o /nowhere/out.png");
  CHECK(unwritable.code == 1);
  CHECK(mentions(unwritable, "/nowhere/out.png"));
}

TEST_CASE("a_pose_with_another_number_of_vertices_is_refused_with_both_counts") {
  const Scratch scratch;
  const fs::path other = scratch.folder / "other.obj";
  std::ofstream(other) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto outcome = run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(other) +
                           " -o " + quoted(scratch.folder / "o.obj"));
  CHECK(outcome.code == 1);
  CHECK(mentions(outcome, "other.obj"));
  CHECK(mentions(outcome, "3"));
}

TEST_CASE("small_benchmarks_run_and_write_json") {
  const Scratch scratch;
  for (const char* what : {"exp", "eigen", "frame", "sym3"}) {
    const fs::path json = scratch.folder / (std::string(what) + ".json");
    const auto outcome = run(std::string("bench ") + what + " --count 2000 --json " + quoted(json));
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    CHECK(mentions(outcome, what == std::string("frame") ? "floor" : "copy"));
    CHECK(fs::file_size(json) > 100);
  }
}

TEST_CASE("a_small_benchmark_of_binding_says_whether_its_bars_are_met") {
  const Scratch scratch;
  const fs::path json = scratch.folder / "bind.json";
  const auto outcome = run("bench bind --faces 8 --rounds 1 --json " + quoted(json));
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "50,000 vertices, 8 cage triangles"));
  CHECK(mentions(outcome, "plain loops"));
  CHECK(mentions(outcome, ">= 45"));
  CHECK(fs::file_size(json) > 100);
}

TEST_CASE("benchmarks_are_drawn_as_svg_with_every_method_and_layout") {
  const Scratch scratch;
  const struct {
    const char* command;
    std::vector<const char*> names;
  } cases[] = {{"bench exp --count 3000 --float",
                {"Diag", "Improved SD", "Fast, blocks", "copy, planes", "Fast, full", "3,000 matrices"}},
               {"bench eigen --count 2000", {"QR", "Viete", "Fast", "copy"}}};
  for (const auto& c : cases) {
    const fs::path svg = scratch.folder / "plot.svg";
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

TEST_CASE("the_accuracy_tables_show_where_the_paper_fails_and_fast_does_not") {
  const Scratch scratch;
  for (const char* precision : {"", " --float"}) {
    const fs::path json = scratch.folder / "accuracy.json";
    const auto outcome = run("bench accuracy --count 64 --json " + quoted(json) + precision);
    REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
    for (const char* part : {"| zero ", "| gap ", "| spread ", "| scale ", "NaN 100 %", "Pade", "Direct"})
      CHECK(mentions(outcome, part));
    std::ifstream in(json);
    const auto tables = nlohmann::json::parse(in);
    REQUIRE(tables.size() == 5);
    const double u = *precision ? 0x1p-24 : 0x1p-53;
    for (const auto& table : tables) {
      for (const auto& row : table["rows"]) {
        const auto& fast = row["methods"]["Fast"];
        const double spread =
            table["by"] == "spread" ? double(row["value"]) : 35;  // of the other rows, at most
        CHECK(fast["nan"] == 0);
        CHECK(fast["worst"] <= (8 + 2.5 * spread) * u);
      }
    }
    CHECK(tables[0]["rows"][6]["methods"]["ISD as printed"]["nan"] == 1);
    CHECK(tables[2]["rows"][4]["methods"]["SD"]["worst"] > 1e4 * u);
  }
}
