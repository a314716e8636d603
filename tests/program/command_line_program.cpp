// The command line: subcommands, outputs, errors and exit codes.
#include <cmath>
#include <cstring>
#include <fstream>
#include <vector>

#include "formats/read.h"
#include "formats/write.h"
#include "mesh/summary.h"
#include "program/command_line.h"
#include "support/ball.h"
#include "support/cube.h"
#include "support/far.h"
#include "support/pictures.h"
#include "support/posed_cube.h"

using namespace viete;
using namespace viete::test;

TEST_CASE("deform_writes_the_deformed_mesh_in_the_order_of_the_model_and_rest_as_it_was") {
  const WorkFolder f;
  f.done(posed + " -o out.obj");
  const auto rest = formats::read(dragon).surface, deformed = formats::read(f / "out.obj").surface;
  CHECK(deformed.triangles == rest.triangles);
  CHECK(deformed.positions.size() == rest.positions.size());
  CHECK(deformed.positions != rest.positions);
  for (const std::string deformer : {"paper", "mean-value"}) {
    f.done("deform " + in_cage + " --pose " + quoted(cage) + " --force -o out.ply --deformer " + deformer);
    CHECK(distance(formats::read(f / "out.ply").surface.positions, rest.positions) <
          1e-13 * mesh::bounds(rest.positions).diagonal());
  }
}

namespace {

// Runs `viete deform --stream`. The input is the file `poses`, and the output is the file `frames`.
Outcome streamed(const TemporaryFolder& scratch, const std::string& out = "frames",
                 const std::string& in = "< poses") {
  return outcome_of("cd " + quoted(scratch.path()) + " && " + quoted(build_dir() / "viete") + " deform " +
                    in_cage + " --stream " + in + " 2>&1 > " + out);
}

}  // namespace

TEST_CASE("poses_that_are_streamed_give_the_frames_that_deform_writes") {
  const WorkFolder f;
  const auto rest = formats::read(cage).surface.positions,
             alert = formats::read(alert_pose).surface.positions;
  {
    std::ofstream poses(f / "poses", std::ios::binary);
    for (const auto* all : {&alert, &rest, &alert})
      poses.write(reinterpret_cast<const char*>(all->data()),
                  std::streamsize(all->size() * sizeof(mesh::Point)));
  }
  const auto outcome = streamed(f);
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  f.done(posed + " -o out.ply");
  const auto exact = formats::read(f / "out.ply").surface.positions,
             model = formats::read(dragon).surface.positions;
  const std::string bytes = file_bytes(f / "frames");
  REQUIRE(bytes.size() == 3 * 12 * model.size());
  std::vector<float> floats(bytes.size() / 4);
  std::memcpy(floats.data(), bytes.data(), bytes.size());
  std::size_t next = 0;
  for (const auto* expected : {&exact, &model, &exact})
    for (const auto& p : *expected)
      for (const double x : p) CHECK(std::abs(floats[next++] - x) < 1e-4 * mesh::bounds(rest).diagonal());
}

TEST_CASE("an_invalid_stream_names_the_pose") {
  const TemporaryFolder scratch;
  const auto rest = formats::read(cage).surface.positions;
  std::string poses(reinterpret_cast<const char*>(rest.data()), rest.size() * sizeof(mesh::Point));
  put_file(scratch / "poses", "");
  CHECK(streamed(scratch).code == 0);
  CHECK(file_bytes(scratch / "frames").empty());
  put_file(scratch / "poses", poses + poses.substr(0, 100));
  const auto cut = streamed(scratch);
  CHECK(cut.code == 1);
  CHECK(mentions(cut, "pose 2: it ends after 100 of "));
  CHECK(file_bytes(scratch / "frames").size() == 12 * formats::read(dragon).surface.positions.size());
  if (fs::exists("/dev/full"))
    CHECK(mentions(streamed(scratch, "/dev/full"), "standard output: it cannot be written"));
  for (const auto& [number, said] : {std::pair{std::nan(""), "pose 1: vertex 5 is not finite or too large"},
                                     {1e50, "pose 1: a deformed position is too large for float32"}}) {
    std::memcpy(poses.data() + 5 * sizeof(mesh::Point), &number, sizeof number);
    put_file(scratch / "poses", poses);
    CHECK(mentions(streamed(scratch), said));
    CHECK(file_bytes(scratch / "frames").empty());
  }
  const auto with_output = run("deform a b --stream -o a.ply");
  CHECK(mentions(with_output, "--stream"));
  CHECK(with_output.code == 2);
  for (const std::string in :
       {"< .", "<&-", "0> write_only"}) {  // input that cannot be read is not the end of input
    CAPTURE(in);
    const auto outcome = streamed(scratch, "frames", in);
    CHECK(outcome.code == 1);
    CHECK(mentions(outcome, "standard input: cannot be read: "));
  }
}

TEST_CASE("a_mask_holds_vertices_and_is_checked") {
  const WorkFolder f;
  const auto model = formats::read(dragon).surface.positions;
  std::string zeros;
  for (std::size_t v = 0; v < model.size(); ++v) zeros += v % 2 ? "0\n" : "0.0 ";
  const std::string deform = posed + " -o a.ply --force --mask ";
  put_file(f / "zeros.txt", zeros);
  f.done(deform + "zeros.txt");
  CHECK(formats::read(f / "a.ply").surface.positions == model);
  f.refused(deform + "none.txt", 1, "none.txt: there is no such file");
  for (const auto& [mask, said] : {std::pair{"1 1 1", "mask.txt: it has 3 numbers for 3,000 vertices"},
                                   {"1 0.5 2", "mask.txt: number 3 is not between 0 and 1"},
                                   {"1 nan", "mask.txt: number 2 is not between 0 and 1"}}) {
    put_file(f / "mask.txt", mask);
    f.refused(deform + "mask.txt", 1, said);
  }
  put_file(f / "mask.obj", "1 1 1\n");
  f.refused(posed + " --mask mask.obj -o mask.obj", 1, "the mask");
  CHECK(file_bytes(f / "mask.obj") == "1 1 1\n");
}

TEST_CASE("a_size_near_the_end_of_the_range_deforms_to_the_same_bits_and_one_beyond_is_refused") {
  const WorkFolder f;
  const auto scale_to = [&](double scale) {
    auto pulled = cube(1.5 * scale);
    pulled.positions[3] = {scale, 2 * scale, 4 * scale};
    formats::write(f / "model.obj", cube(scale));
    formats::write(f / "cage.obj", cube(1.5 * scale));
    formats::write(f / "pose.obj", pulled);
  };
  const std::string deform = "deform model.obj cage.obj --pose pose.obj -o out.obj --digits all";
  scale_to(1);
  f.done(deform);
  const auto at_one = formats::read(f / "out.obj").surface.positions;
  for (const double scale : {0x1p-198, 0x1p-100, 0x1p100, 0x1p196}) {
    scale_to(scale);
    f.done(deform);
    auto scaled = at_one;
    for (auto& p : scaled) p = {p[0] * scale, p[1] * scale, p[2] * scale};
    CHECK(formats::read(f / "out.obj").surface.positions == scaled);
  }
  fs::remove(f / "out.obj");
  for (const double scale : {1e-61, 1e61}) {
    scale_to(scale);
    f.refused(deform, 1, "cannot be deformed; scale it to a size between 1e-60 and 1e+60");
    CHECK_FALSE(fs::exists(f / "out.obj"));
    CHECK(mentions(f.viete("info model.obj"), "cannot be deformed"));
  }
}

TEST_CASE("deform_says_what_a_method_loses_and_only_where_it_does") {
  const WorkFolder f;
  auto stretched = formats::read(cage).surface;
  for (auto& p : stretched.positions) p = {2 * p[0], (2 - 1e-5) * p[1], (2 + 1e-5) * p[2]};
  formats::write(f / "close.obj", stretched);
  const auto deform = [&](const fs::path& file, const std::string& method) {
    return f.done("deform " + in_cage + " --pose " + quoted(file) + " --force -o out.ply --method " + method);
  };
  const auto lost = deform("close.obj", "sd");
  for (const char* part : {"viete: note: ", "method sd has relative errors up to ", "fast"})
    CHECK_MESSAGE(mentions(lost, part), lost.text);
  for (const char* method : {"diag", "fast"}) CHECK_FALSE(mentions(deform("close.obj", method), "method"));
  CHECK_FALSE(mentions(deform(alert_pose, "sd"), "method"));
}

TEST_CASE("pictures_compare_deformers_show_maps_and_have_no_background_where_that_is_asked_for") {
  const WorkFolder f;
  const auto picture = [&](const std::string& options) {
    f.done("render " + in_cage + " --pose " + quoted(alert_pose) +
           " --size 640x320 --no-grid --force -o out.png " + options);
    return read_png(f / "out.png");
  };
  const auto plain = picture(""), large = picture("--scale 2");
  CHECK(large.width == 1280);
  CHECK(large.height == 640);
  CHECK(large.pixel(5, 5) != large.pixel(640, 320));
  CHECK(difference(plain, picture("--map rotation"), 12) > 0.02);
  CHECK(difference(plain, picture("--compare smooth,rigid"), 12) > 0.05);
  CHECK(difference(picture("--compare diag,fast"), picture("--compare diag,sd,fast"), 12) > 0.05);
  // The corner is transparent, the middle is opaque, and edges are between transparent and opaque.
  const auto clear = picture("--transparent");
  CHECK(clear.rgba[3] == 0);
  std::size_t whole = 0, partly = 0;
  for (std::size_t i = 3; i < clear.rgba.size(); i += 4) {
    whole += clear.rgba[i] == 255;
    partly += clear.rgba[i] > 0 && clear.rgba[i] < 255;
  }
  CHECK(whole > 5000);
  CHECK(partly > 200);
  CHECK(mentions(f.done("render " + quoted(dragon) + " --size 200x100 --map volume -o without.png"),
                 "the map volume is not available"));
  f.refused("render " + quoted(dragon) + " -o no.png --camera none.viete", 1, "none.viete");
  for (const std::string wrong : {"--compare smooth,none", "--map blue"})
    f.refused("render " + quoted(dragon) + " -o no.png " + wrong, 2, wrong.substr(0, wrong.find(' ')));
  CHECK_FALSE(fs::exists(f / "no.png"));
}

TEST_CASE("a_radius_leaves_far_vertices_where_they_are_and_bad_ones_are_refused") {
  const WorkFolder f;
  auto dragged = formats::read(cage).surface;
  dragged.positions[0][1] += 0.1 * mesh::bounds(dragged.positions).diagonal();
  formats::write(f / "pulled.obj", dragged);
  const auto rest = formats::read(dragon).surface.positions;
  const double rounding = 1e-9 * mesh::bounds(rest).diagonal();
  std::ptrdiff_t last = std::ssize(rest) + 1;
  for (const std::string radius : {"1000", "40", "10"}) {  // with a smaller radius, fewer vertices move
    f.done("deform " + in_cage + " --pose pulled.obj --force -o out.ply --radius " + radius);
    const auto moved = formats::read(f / "out.ply").surface.positions;
    std::ptrdiff_t count = 0;
    for (std::size_t i = 0; i < rest.size(); ++i) count += mesh::norm(rest[i] - moved[i]) > rounding;
    CHECK(count > 0);
    CHECK(count < last);
    last = count;
  }
  CHECK(2 * last < std::ssize(rest));
  f.refused("render " + in_cage + " -o x.png --deformer mean-value --radius 3", 1,
            "radius: these weights have no radius; omit it, or choose the weights cutoff");
}

TEST_CASE("weights_and_blend_are_chosen_apart_or_by_one_word") {
  const WorkFolder f;
  const auto deformed = [&](const std::string& choice) {
    f.done(posed + " -o out.ply --force" + choice);
    return file_bytes(f / "out.ply");
  };
  const auto usual = deformed(""), published = deformed(" --deformer paper"),
             mean_values = deformed(" --deformer mean-value"), linear = deformed(" --blend linear"),
             stitched = deformed(" --arap");
  for (const auto* other : {&published, &mean_values, &linear, &stitched}) CHECK(*other != usual);
  CHECK(linear != mean_values);
  CHECK(deformed(" --weights biharmonic --blend srl") == usual);
  CHECK(deformed(" --weights inverse --blend srl") == published);
  CHECK(deformed(" --radius 25") == deformed(" --deformer local"));  // only weights of Local have a radius
  CHECK(deformed(" --weights mean-value") == mean_values);
  CHECK(deformed(" --weights mean-value --blend linear") == mean_values);
  CHECK(deformed(" --blend linear --method diag") == linear);  // linear blending uses no matrix method
  CHECK(deformed(" --arap --iterations 1 --attach 0 --hold 0") == stitched);
  for (const char* more : {" --iterations 2", " --attach 10", " --hold 100"})
    CHECK(deformed(std::string(" --arap") + more) != stitched);
  f.refused(posed + " -o x.ply --blend srl --weights mean-value", 1,
            "cannot be combined: mean value weights need the linear blend");
  f.refused(posed + " -o x.ply --deformer mean-value --blend srl", 2, "excludes");
  CHECK_FALSE(fs::exists(f / "x.ply"));
}

TEST_CASE("info_names_counts_and_goes_on_after_a_file_that_cannot_be_read") {
  const auto usual = run("info");
  CHECK(usual.code == 0);
  for (const char* part : {"dragon/dragon.ply", "dragon/cage.obj"}) CHECK(mentions(usual, part));
  const auto outcome = run("info /nowhere/missing.obj " + quoted(dragon));
  CHECK(outcome.code == 1);
  for (const char* part : {"/nowhere/missing.obj", "vertices    3000", "topology    genus 0, no holes"})
    CHECK(mentions(outcome, part));
}

TEST_CASE("info_describes_the_splats_of_a_capture") {
  const WorkFolder f;
  const auto outcome = f.viete("info " + quoted(source_dir() / "tests/fuzz/corpus/ply/capture_ascii.ply"));
  CHECK(outcome.code == 0);
  CHECK(mentions(outcome, "  splats      2, harmonics of degree 1\n"));
  CHECK(mentions(outcome, "  opacity     below 0.05 in 50 % of the splats\n"));
  CHECK(mentions(outcome, "  up          -y in most captures\n"));
  for (const char* of_faces : {"polygons", "surface", "topology", "area"})
    CHECK_FALSE(mentions(outcome, "  " + std::string(of_faces) + " "));
  CHECK_FALSE(mentions(outcome, "cannot be deformed"));
}

TEST_CASE("info_names_edges_with_more_than_two_faces_and_says_that_a_cage_has_a_fin") {
  const WorkFolder f;
  formats::write(f / "model.obj", cube(1));
  formats::write(f / "cage.obj", cube(2));
  put_file(f / "fin.obj", file_bytes(f / "cage.obj") + "v 0 5 5\nf 7 8 9\n");
  const auto alone = f.viete("info fin.obj"), around = f.viete("info model.obj --cage fin.obj");
  CHECK(mentions(alone, "1 edge with more than two faces\n"));
  CHECK(mentions(alone, "edge 6-7\n"));
  CHECK(mentions(around, "finding     the cage has a fin: an odd number of faces share edge 6-7"));
  CHECK(mentions(around, "cage: 1 edge with more than two faces"));
  CHECK_FALSE(mentions(f.viete("info model.obj --cage cage.obj"), "has a fin"));
}

TEST_CASE("defects_of_the_cage_are_noted_once_by_every_command_that_deforms") {
  const WorkFolder f;
  formats::write(f / "model.obj", cube(1));
  auto triangles = cube(2).triangles;
  triangles.back() = triangles.front();
  formats::write(f / "cage.obj", mesh::from_triangles(cube(2).positions, triangles));
  for (const char* name : {"k_1.obj", "k_2.obj"}) fs::copy(f / "cage.obj", f / name);
  for (const std::string words : {"deform model.obj cage.obj --pose cage.obj -o out.obj",
                                  "render model.obj cage.obj --size 64x64 -o out.png",
                                  "animate model.obj cage.obj --keys k_#.obj -o out.pc2"}) {
    const std::string text = f.done(words).text, repeats = "cage.obj: 1 cage face repeats another face";
    CHECK_MESSAGE(mentions(text, "cage.obj: 3 cage edges have only one face: the cage is open"), text);
    REQUIRE_MESSAGE(mentions(text, repeats), text);
    CHECK_FALSE(mentions(text.substr(text.find(repeats) + repeats.size()), "repeat"));
  }
  CHECK(mentions(f.done("info model.obj --cage cage.obj"), "cage: 1 repeated face\n"));
}

TEST_CASE("a_volume_of_rounding_errors_is_0") {
  const WorkFolder f;
  mesh::Surface s = ball(1.1, 1);
  const std::vector<mesh::Triangle> front = s.triangles;
  std::vector<mesh::Triangle> both = front;
  for (std::size_t t = front.size(); t-- > 0;) both.push_back({front[t][1], front[t][0], front[t][2]});
  formats::write(f / "both.obj", mesh::from_triangles(s.positions, both));
  REQUIRE(mesh::summarize(formats::read(f / "both.obj").surface).volume != 0);
  CHECK(mentions(f.done("info both.obj"), "volume      0\n"));
}

TEST_CASE("far_models_show_their_size_and_the_rounding_of_a_stream") {
  const TemporaryFolder f;
  formats::write(f / "model.obj", far_away(cube(1)));
  formats::write(f / "cage.obj", far_away(cube(2)));
  const auto rest = formats::read(f / "cage.obj").surface.positions;
  put_file(f / "poses", {reinterpret_cast<const char*>(rest.data()), rest.size() * sizeof(mesh::Point)});
  const std::string model = quoted(f / "model.obj");
  CHECK(mentions(run("info " + model),
                 "box         (431233.1, 5411986.2, 311.3) to (431235.1, 5411988.2, 313.3)"));
  const auto streamed =
      outcome_of(quoted(build_dir() / "viete") + " deform " + model + " " + quoted(f / "cage.obj") +
                 " --stream < " + quoted(f / "poses") + " 2>&1 > " + quoted(f / "frames"));
  CHECK(mentions(streamed, "note: the number type of the file rounds coordinates by up to 0.6"));
}

TEST_CASE("errors_name_file_and_reason_and_exit_with_1") {
  const WorkFolder f;
  put_file(f / "broken.obj", "v 0 0 0\nf 1 2 3\n");
  put_file(f / "other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const std::string deform = "deform " + in_cage + " -o out.ply --pose ";
  f.refused("render broken.obj " + quoted(cage) + " -o out.png", 1, "broken.obj:2");
  f.refused("render " + quoted(dragon) + " broken.obj -o out.png", 1, "broken.obj:2");
  f.refused(deform + "broken.obj", 1, "broken.obj:2");
  f.refused(deform + "other.obj", 1, "other.obj: the pose has 3 vertices, the cage has 76");
  f.refused("render " + in_cage + " -o /nowhere/out.png", 1, "/nowhere/out.png");
  for (const char* name : {"out.png", "out.ply"}) CHECK_FALSE(fs::exists(f / name));
}
