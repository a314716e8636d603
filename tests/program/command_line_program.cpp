// The program in a shell: subcommands, outputs, errors, exit codes.
#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <limits>
#include <vector>

#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "program/command_line.h"
#include "render/image.h"
#include "scene/cube.h"
#include "support/gltf.h"
#include "support/pictures.h"

using namespace viete;
using namespace viete::test;

TEST_CASE("deform_writes_the_deformed_mesh_in_the_order_of_the_model") {
  const TemporaryFolder scratch;
  const fs::path out = scratch.path() / "out.obj";
  const auto outcome =
      run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose) + " -o " + quoted(out));
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  const auto rest = mesh::read(dragon).surface, deformed = mesh::read(out).surface;
  REQUIRE(deformed.positions.size() == rest.positions.size());
  CHECK(deformed.triangles == rest.triangles);
  CHECK(deformed.positions != rest.positions);
}

namespace {

// Streams the folder's `poses` to its `frames`.
Outcome streamed(const TemporaryFolder& scratch, const std::string& out = "frames",
                 const std::string& in = "< poses") {
  return outcome_of("cd " + quoted(scratch.path()) + " && " + quoted(build_dir() / "viete") + " deform " +
                    quoted(dragon) + " " + quoted(cage) + " --stream " + in + " 2>&1 > " + out);
}

}  // namespace

TEST_CASE("poses_that_are_streamed_give_the_frames_that_deform_writes") {
  const TemporaryFolder scratch;
  const auto in_folder = "cd " + quoted(scratch.path()) + " &&";
  const auto rest = mesh::read(cage).surface.positions, posed = mesh::read(pose).surface.positions;
  {
    std::ofstream poses(scratch / "poses", std::ios::binary);
    for (const auto* all : {&posed, &rest, &posed})
      poses.write(reinterpret_cast<const char*>(all->data()),
                  std::streamsize(all->size() * sizeof(mesh::Point)));
  }
  const auto outcome = streamed(scratch);
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose) + " -o out.ply",
            in_folder)
            .code == 0);
  const auto exact = mesh::read(scratch / "out.ply").surface.positions,
             model = mesh::read(dragon).surface.positions;
  const std::string bytes = file_bytes(scratch / "frames");
  REQUIRE(bytes.size() == 3 * 12 * model.size());
  std::vector<float> floats(bytes.size() / 4);
  std::memcpy(floats.data(), bytes.data(), bytes.size());
  const double diagonal = mesh::bounds(rest).diagonal();
  const auto off = [&](std::size_t frame, const std::vector<mesh::Point>& expected) {
    double most = 0;
    for (std::size_t i = 0; i < 3 * expected.size(); ++i)
      most = std::max(most, std::abs(floats[frame * 3 * expected.size() + i] - expected[i / 3][i % 3]));
    return most / diagonal;
  };
  CHECK(off(0, exact) < 1e-4);
  CHECK(off(1, model) < 1e-4);
  CHECK(off(2, exact) < 1e-4);
}

TEST_CASE("an_invalid_stream_names_the_pose") {
  const TemporaryFolder scratch;
  const auto rest = mesh::read(cage).surface.positions;
  std::string poses(reinterpret_cast<const char*>(rest.data()), rest.size() * sizeof(mesh::Point));
  put_file(scratch / "poses", "");
  CHECK(streamed(scratch).code == 0);
  CHECK(file_bytes(scratch / "frames").empty());
  put_file(scratch / "poses", poses + poses.substr(0, 100));
  const auto cut = streamed(scratch);
  CHECK(cut.code == 1);
  CHECK(mentions(cut, "pose 2: it ends after 100 of "));
  CHECK(file_bytes(scratch / "frames").size() == 12 * mesh::read(dragon).surface.positions.size());
  put_file(scratch / "poses", poses);
  if (fs::exists("/dev/full"))
    CHECK(mentions(streamed(scratch, "/dev/full"), "standard output: it cannot be written"));
  const double nan = std::numeric_limits<double>::quiet_NaN();
  std::memcpy(poses.data() + 5 * sizeof(mesh::Point), &nan, sizeof nan);
  put_file(scratch / "poses", poses);
  CHECK(mentions(streamed(scratch), "pose 1: vertex 5 has no finite position"));
  const double far = 1e50;
  std::memcpy(poses.data() + 5 * sizeof(mesh::Point), &far, sizeof far);
  put_file(scratch / "poses", poses);
  CHECK(mentions(streamed(scratch), "pose 1: a position is out of the range of float32"));
  CHECK(file_bytes(scratch / "frames").empty());
  CHECK(mentions(run("deform a b --stream -o a.ply"), "--stream"));
  CHECK(run("deform a b --stream -o a.ply").code == 2);
}

TEST_CASE("input_that_cannot_be_read_is_not_the_end_of_a_stream") {
  const TemporaryFolder scratch;
  for (const std::string in : {"< .", "<&-", "0> write_only"}) {
    CAPTURE(in);
    const auto outcome = streamed(scratch, "frames", in);
    CHECK(outcome.code == 1);
    CHECK(mentions(outcome, "standard input: cannot be read: "));
  }
}

TEST_CASE("commands_work_with_the_threads_that_a_limit_on_processes_leaves") {
  const TemporaryFolder scratch;
  fs::permissions(scratch.path(), fs::perms::all);  // root ignores the permission
  const std::string user = geteuid() == 0 ? "setpriv --reuid=64321 --clear-groups " : "",
                    files = quoted(dragon) + " " + quoted(cage);
  const auto limited = [&](const std::string& arguments, int processes) {
    return run(arguments, "cd " + quoted(scratch.path()) +
                              " && env -u XDG_STATE_HOME -u XDG_CACHE_HOME HOME=$PWD " + user +
                              "prlimit --nproc=" + std::to_string(processes));
  };
  if (limited("--version", 1).code != 0) {
    MESSAGE("another user cannot run the program here");
    return;
  }
  const std::pair<std::string, std::string> lines[] = {
      {"deform " + files + " --pose " + quoted(pose) + " -o ", ".ply"},
      {"cage " + quoted(cage) + " --triangles 60 -o ", ".obj"},
      {"render " + files + " --size 64x48 -o ", ".png"}};
  for (const auto& [line, extension] : lines) {
    CAPTURE(line);
    REQUIRE(run(line + "all" + extension, "cd " + quoted(scratch.path()) + " &&").code == 0);
    for (const int processes : {1, 2, 3}) {
      const Outcome outcome = limited(line + "few" + extension + " --force", processes);
      CHECK_MESSAGE(outcome.code == 0, outcome.text);
      CHECK(file_bytes(scratch / ("few" + extension)) == file_bytes(scratch / ("all" + extension)));
    }
  }
}

TEST_CASE("an_output_does_not_overwrite_its_mask") {
  const TemporaryFolder scratch;
  put_file(scratch / "mask.obj", "1 1 1\n");
  CHECK(mentions(run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose) +
                         " --mask mask.obj -o mask.obj",
                     "cd " + quoted(scratch.path()) + " &&"),
                 "the mask"));
  CHECK(file_bytes(scratch / "mask.obj") == "1 1 1\n");
}

TEST_CASE("a_mask_holds_vertices_and_is_checked") {
  const TemporaryFolder scratch;
  const auto in_folder = "cd " + quoted(scratch.path()) + " &&";
  const auto model = mesh::read(dragon).surface.positions;
  const auto deform = [&](const std::string& mask) {
    put_file(scratch / "mask.txt", mask);
    return run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose) +
                   " --mask mask.txt -o a.ply --force",
               in_folder);
  };
  std::string zeros;
  for (std::size_t v = 0; v < model.size(); ++v) zeros += v % 2 ? "0\n" : "0.0 ";
  CHECK(deform(zeros).code == 0);
  CHECK(mesh::read(scratch / "a.ply").surface.positions == model);
  CHECK(mentions(deform("1 1 1"), "mask.txt: it has 3 shares for 3,000 vertices"));
  CHECK(mentions(deform("1 0.5 2"), "mask.txt: number 3 is not between 0 and 1"));
  CHECK(mentions(deform("1 nan"), "mask.txt: number 2 is not between 0 and 1"));
  fs::remove(scratch / "mask.txt");
  CHECK(mentions(run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose) +
                         " --mask none.txt -o a.ply --force",
                     in_folder),
                 "none.txt: there is no such file"));
}

TEST_CASE("deform_with_the_rest_cage_as_pose_gives_the_model") {
  const TemporaryFolder scratch;
  const fs::path out = scratch.path() / "out.ply";
  for (const char* way : {"paper", "mean-value"}) {
    const auto outcome = run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(cage) +
                             " -o " + quoted(out) + " --deformer " + way);
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

TEST_CASE("a_size_near_the_end_of_the_range_deforms_to_the_same_bits_and_one_beyond_is_refused") {
  const TemporaryFolder scratch;
  const auto posed = [&](double scale, const std::string& command) {
    auto pulled = cube(1.5 * scale);
    pulled.positions[3] = {scale, 2 * scale, 4 * scale};
    mesh::write(scratch / "model.obj", cube(scale));
    mesh::write(scratch / "cage.obj", cube(1.5 * scale));
    mesh::write(scratch / "pose.obj", pulled);
    return run(command, "cd " + quoted(scratch.path()) + " &&");
  };
  const std::string deform = "deform model.obj cage.obj --pose pose.obj -o out.obj --digits all";
  REQUIRE(posed(1, deform).code == 0);
  const auto at_one = mesh::read(scratch / "out.obj").surface.positions;
  for (const double scale : {0x1p-198, 0x1p-100, 0x1p100, 0x1p196}) {
    const Outcome outcome = posed(scale, deform);
    REQUIRE_MESSAGE(outcome.code == 0, outcome.text);
    auto scaled = at_one;
    for (auto& p : scaled) p = {p[0] * scale, p[1] * scale, p[2] * scale};
    CHECK(mesh::read(scratch / "out.obj").surface.positions == scaled);
  }
  fs::remove(scratch / "out.obj");
  for (const double scale : {1e-90, 1e-61, 1e61, 1e90}) {
    const Outcome outcome = posed(scale, deform);
    CHECK(outcome.code == 1);
    CHECK_MESSAGE(mentions(outcome, "cannot be deformed; scale it to something between 1e-60 and 1e+60"),
                  outcome.text);
    CHECK_FALSE(fs::exists(scratch / "out.obj"));
    CHECK(mentions(posed(scale, "info model.obj"), "cannot be deformed"));
  }
  for (const double scale : {1e-40, 1e40}) {
    CHECK(mentions(posed(scale, "render model.obj -o a.png"), "cannot be drawn"));
    const Outcome view = run("model.obj", without_display(scratch.path()));
    CHECK(mentions(view, "cannot be drawn"));
  }
}

TEST_CASE("deform_says_what_a_method_loses_and_only_where_it_does") {
  const TemporaryFolder scratch;
  auto stretched = mesh::read(cage).surface;
  for (auto& p : stretched.positions) p = {2 * p[0], (2 - 1e-5) * p[1], (2 + 1e-5) * p[2]};
  const fs::path close = scratch / "close.obj";
  mesh::write(close, stretched);
  const auto deform = [&](const fs::path& posed, const std::string& method) {
    return run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(posed) + " -o " +
               quoted(scratch / "out.ply") + " --method " + method);
  };
  const auto lost = deform(close, "sd");
  CHECK_MESSAGE(lost.code == 0, lost.text);
  for (const char* part : {"viete: note: ", "method sd have errors up to ", "fast"})
    CHECK_MESSAGE(mentions(lost, part), lost.text);
  for (const char* method : {"diag", "fast"}) CHECK_FALSE(mentions(deform(close, method), "method"));
  CHECK_FALSE(mentions(deform(pose, "sd"), "method"));
}

TEST_CASE("render_writes_a_picture_of_the_asked_size") {
  const TemporaryFolder scratch;
  const fs::path out = scratch.path() / "out.png";
  const auto outcome = run("render " + quoted(dragon) + " " + quoted(cage) + " -o " + quoted(out) +
                           " --size 320x200 --scale 2");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  const auto image = test::read_png(out);
  CHECK(image.width == 640);
  CHECK(image.height == 400);
  CHECK(image.pixel(5, 5) != image.pixel(320, 200));
}

TEST_CASE("pictures_compare_ways_show_maps_and_have_no_background_where_that_is_asked_for") {
  const TemporaryFolder scratch;
  const auto picture = [&](const std::string& options) {
    const fs::path out = scratch / "out.png";
    const auto outcome = run("render " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose) +
                             " --size 640x320 --no-grid --force -o " + quoted(out) + ' ' + options);
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    return read_png(out);
  };
  const auto plain = picture("");
  CHECK(difference(plain, picture("--map turn"), 12) > 0.02);
  CHECK(difference(plain, picture("--compare smooth,rigid"), 12) > 0.05);
  CHECK(difference(picture("--compare diag,fast"), picture("--compare diag,sd,fast"), 12) > 0.05);
  // Transparent in the corner, opaque in the middle, and blended edges between them.
  const auto clear = picture("--transparent");
  CHECK(clear.rgba[3] == 0);
  std::size_t whole = 0, partly = 0;
  for (std::size_t i = 3; i < clear.rgba.size(); i += 4) {
    whole += clear.rgba[i] == 255;
    partly += clear.rgba[i] > 0 && clear.rgba[i] < 255;
  }
  CHECK(whole > 5000);
  CHECK(partly > 200);
  // An unavailable map is reported.
  const auto without =
      run("render " + quoted(dragon) + " --size 200x100 --map volume -o " + quoted(scratch / "without.png"));
  CHECK(without.code == 0);
  CHECK_MESSAGE(mentions(without.text, "no map of volume here"), without.text);
  for (const auto& [wrong, said] : {std::pair{"--compare smooth", "--compare"},
                                    {"--compare smooth,none", "--compare"},
                                    {"--compare smooth,rigid,arap,local,paper", "--compare"},
                                    {"--map blue", "--map"},
                                    {"--camera none.viete", "none.viete"}}) {
    const auto outcome = run("render " + quoted(dragon) + " -o " + quoted(scratch / "no.png") + ' ' + wrong);
    CHECK_MESSAGE(outcome.code != 0, wrong);
    CHECK_MESSAGE(mentions(outcome.text, said), outcome.text);
    CHECK_FALSE(fs::exists(scratch / "no.png"));
  }
}

TEST_CASE("a_radius_leaves_far_vertices_where_they_are_and_bad_ones_are_refused") {
  const TemporaryFolder scratch;
  const std::string scene = quoted(dragon) + " " + quoted(cage);
  auto dragged = mesh::read(cage).surface;
  dragged.positions[0][1] += 0.1 * mesh::bounds(dragged.positions).diagonal();
  const fs::path pulled = scratch.path() / "pulled.obj";
  mesh::write(pulled, dragged);
  const auto rest = mesh::read(dragon).surface.positions;
  const double rounding = 1e-9 * mesh::bounds(rest).diagonal();
  std::size_t last = rest.size() + 1;
  for (const char* radius : {"1000", "40", "10"}) {  // the shorter the radius, the fewer vertices move
    const fs::path out = scratch.path() / "out.ply";
    const auto outcome =
        run("deform " + scene + " --pose " + quoted(pulled) + " -o " + quoted(out) + " --radius " + radius);
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
  const auto none = run("render " + scene + " -o x.png --deformer mean-value --radius 3");
  CHECK(none.code == 1);
  CHECK_MESSAGE(mentions(none, "these weights have no radius"), none.text);
}

TEST_CASE("weights_and_blend_are_chosen_apart_or_by_one_word") {
  const TemporaryFolder scratch;
  const auto deformed = [&](const std::string& choice) {
    const fs::path out = scratch.path() / "out.ply";
    const auto outcome = run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose) +
                             " -o " + quoted(out) + " --force" + choice);
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    return file_bytes(out);
  };
  const auto usual = deformed("");
  CHECK(deformed(" --weights biharmonic --blend srl") == usual);
  const auto published = deformed(" --deformer paper");
  CHECK(published != usual);
  CHECK(deformed(" --weights inverse --blend srl") == published);
  CHECK(deformed(" --radius 25") == deformed(" --deformer local"));  // a setting that only these weights have
  const auto mean_values = deformed(" --deformer mean-value");
  CHECK(mean_values != usual);
  CHECK(deformed(" --weights mean-value") == mean_values);
  CHECK(deformed(" --weights mean-value --blend linear") == mean_values);
  const auto linear = deformed(" --blend linear");
  CHECK(linear != usual);
  CHECK(linear != mean_values);
  CHECK(deformed(" --blend linear --method diag") == linear);  // linear blending uses no exponential

  const auto stitched = deformed(" --stitched");
  CHECK(stitched != usual);
  CHECK(deformed(" --stitched --iterations 1") == stitched);
  CHECK(deformed(" --stitched --iterations 2") != stitched);
  CHECK(deformed(" --stitched --pins 0 --hold 0") == stitched);
  CHECK(deformed(" --stitched --pins 10") != stitched);
  CHECK(deformed(" --stitched --hold 100") != stitched);

  const std::string scene = "deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(pose) +
                            " -o " + quoted(scratch.path() / "x.ply");
  const auto apart = run(scene + " --blend srl --weights mean-value");
  CHECK(apart.code == 1);
  CHECK_MESSAGE(mentions(apart, "cannot be combined"), apart.text);
  CHECK_MESSAGE(mentions(apart, "mean value coordinates move points"), apart.text);
  CHECK(run(scene + " --deformer mean-value --blend srl").code == 2);
  CHECK(run(scene + " --blend magic").code == 2);
  CHECK_FALSE(fs::exists(scratch.path() / "x.ply"));
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
  CHECK(mentions(outcome, "vertices    3000"));
  CHECK(mentions(outcome, "topology    genus 0, no holes"));
}

TEST_CASE("info_names_edges_with_more_than_two_faces_and_says_that_a_cage_has_a_fin") {
  const TemporaryFolder scratch;
  mesh::write(scratch / "model.obj", cube(1));
  mesh::write(scratch / "cage.obj", cube(2));
  put_file(scratch / "fin.obj", file_bytes(scratch / "cage.obj") + "v 0 5 5\nf 7 8 9\n");
  const std::string model = quoted(scratch / "model.obj"), fin = quoted(scratch / "fin.obj");
  const auto alone = run("info " + fin), around = run("info " + model + " --cage " + fin);
  CHECK(mentions(alone, "1 edge with more than two faces\n"));
  CHECK(mentions(alone, "edge 6-7\n"));
  CHECK(mentions(around, "finding     the cage has a fin: an odd number of triangles meet at edge 6-7"));
  CHECK(mentions(around, "cage: 1 edge with more than two faces"));
  CHECK_FALSE(mentions(run("info " + model + " --cage " + quoted(scratch / "cage.obj")), "has a fin"));
}

TEST_CASE("errors_name_file_and_reason_and_exit_with_1") {
  const TemporaryFolder scratch;
  const fs::path broken = scratch.path() / "broken.obj";
  std::ofstream(broken) << "v 0 0 0\nf 1 2 3\n";
  const fs::path out = scratch.path() / "out.png";
  for (const std::string& line : {"render " + quoted(broken) + " " + quoted(cage) + " -o " + quoted(out),
                                  "render " + quoted(dragon) + " " + quoted(broken) + " -o " + quoted(out),
                                  "deform " + quoted(dragon) + " " + quoted(cage) + " --pose " +
                                      quoted(broken) + " -o " + quoted(scratch.path() / "out.ply")}) {
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
  const TemporaryFolder scratch;
  const fs::path other = scratch.path() / "other.obj";
  std::ofstream(other) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  const auto outcome = run("deform " + quoted(dragon) + " " + quoted(cage) + " --pose " + quoted(other) +
                           " -o " + quoted(scratch.path() / "o.obj"));
  CHECK(outcome.code == 1);
  CHECK(mentions(outcome, "other.obj"));
  CHECK(mentions(outcome, "3"));
}

namespace {

// The contents of a GLB according to an independent reader.
struct Judged {
  std::string image;
  std::vector<float> positions, texture;
};

std::vector<float> judged_floats(const tinygltf::Model& model, const char* attribute) {
  const int index = model.meshes.at(0).primitives.at(0).attributes.at(attribute);
  const auto& accessor = model.accessors.at(static_cast<std::size_t>(index));
  const auto& view = model.bufferViews.at(static_cast<std::size_t>(accessor.bufferView));
  const auto* from = model.buffers.at(0).data.data() + view.byteOffset + accessor.byteOffset;
  std::vector<float> values(view.byteLength / sizeof(float));
  std::memcpy(values.data(), from, view.byteLength);
  return values;
}

Judged judged(const fs::path& file) {
  Judged found;
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string problem, warning;
  loader.SetImageLoader(
      [](tinygltf::Image*, int, std::string*, std::string*, int, int, const unsigned char* bytes, int size,
         void* to) {
        static_cast<Judged*>(to)->image.assign(reinterpret_cast<const char*>(bytes),
                                               static_cast<std::size_t>(size));
        return true;
      },
      &found);
  REQUIRE_MESSAGE(loader.LoadBinaryFromFile(&model, &problem, &warning, file.string()), problem);
  const auto& material =
      model.materials.at(static_cast<std::size_t>(model.meshes.at(0).primitives.at(0).material));
  CHECK(material.pbrMetallicRoughness.baseColorTexture.index == 0);
  found.positions = judged_floats(model, "POSITION");
  found.texture = judged_floats(model, "TEXCOORD_0");
  return found;
}

}  // namespace

TEST_CASE("a_deformed_textured_glb_opens_in_another_reader_with_its_texture_in_place") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a.glb", test::patch().glb());
  std::string cage, pose;
  for (int i = 0; i < 8; ++i) {
    const int x = i & 1 ? 3 : -1, y = i & 2 ? 2 : -1, z = i & 4 ? 1 : -1;
    cage += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) + "\n";
    pose += "v " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z + x) + "\n";
  }
  const std::string faces = "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  test::put_file(folder / "cage.obj", cage + faces);
  test::put_file(folder / "pose.obj", pose + faces);
  const auto at = [&](const char* name) { return test::quoted(folder / name); };
  const auto deform = [&](const char* posed, const char* out) {
    return test::run("deform " + at("a.glb") + " " + at("cage.obj") + " --pose " + at(posed) + " -o " +
                     at(out));
  };
  REQUIRE(deform("pose.obj", "b.glb").code == 0);
  const Judged before = judged(folder / "a.glb"), after = judged(folder / "b.glb");
  CHECK(after.image == before.image);
  CHECK(after.image.substr(1, 3) == "PNG");
  CHECK(after.texture == before.texture);
  CHECK(after.positions != before.positions);
  REQUIRE(deform("cage.obj", "rest.glb").code == 0);
  CHECK(test::file_bytes(folder / "rest.glb") == test::patch().glb());
}
