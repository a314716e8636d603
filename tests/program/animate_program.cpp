// viete animate: exported frames are complete whenever the program ends, and can be continued.
#include <tiny_gltf.h>

#include <cmath>
#include <cstring>
#include <set>

#include "base/numbered_files.h"
#include "base/process.h"
#include "mesh/formats/point_cache.h"
#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "program/command_line.h"
#include "scene/animated_cube.h"
#include "scene/files/open.h"
#include "scene/files/session.h"
#include "support/pictures.h"

using namespace viete;
using namespace viete::test;

namespace {

// A cube in its cage, with posed cages p_01, p_09 and p_17 as keys.
struct AnimatedFiles : AnimatedCube {
  AnimatedFiles() {
    for (const int frame : {1, 9, 17}) {
      mesh::Surface posed = *document.cage_file.surface;
      posed.positions = AnimatedCube::pose(frame).cage.positions;
      mesh::write(*this / (frame < 10 ? "p_0" + std::to_string(frame) + ".obj" : "p_17.obj"), posed);
    }
  }
  Outcome animate(const std::string& rest, const std::string& before = "") const {
    return run("animate model.obj cage.obj --keys p_##.obj " + rest,
               "cd " + quoted(path()) + " && " + before);
  }
};

std::set<std::string> names_of(const fs::path& folder, const std::string& end) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().filename().string().ends_with(end)) names.insert(entry.path().filename().string());
  return names;
}

// The dragon with two keys, slow enough to be interrupted within a frame.
struct AnimatedDragon : TemporaryFolder {
  AnimatedDragon() {
    fs::copy(cage, *this / "k_01.obj");
    fs::copy(pose, *this / "k_41.obj");
  }
  std::string line(const std::string& rest) const {
    return "animate " + quoted(dragon) + " " + quoted(cage) + " --keys k_##.obj " + rest;
  }
  Outcome animate(const std::string& rest) const { return run(line(rest), "cd " + quoted(path()) + " &&"); }
};

}  // namespace

TEST_CASE("pictures_and_turntables_show_no_tool_and_the_cage_only_if_it_is_asked_for") {
  const AnimatedFiles files;
  scene::Session session;
  session.model = files / "model.obj", session.cage = files / "cage.obj";
  session.view.panels = false;
  const auto drawn = [&](const std::string& command) {
    put_file(files / "s.viete", scene::session_text(session, files / "s.viete"));
    const Outcome outcome = run(command + " --size 200x150 --force", "cd " + quoted(files.path()) + " &&");
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    return read_png(files / (command.starts_with("render") ? "p.png" : "t_02.png"));
  };
  const std::string commands[] = {"render s.viete -o p.png", "render s.viete --show-cage -o p.png",
                                  "animate s.viete --turntable --frames 1-2 -o t_##.png"};
  std::vector<render::Image> plain;
  for (const std::string& command : commands) plain.push_back(drawn(command));
  CHECK(difference(plain[0], plain[1], 12) > 0.005);
  const auto shows_no_tool = [&] {
    for (std::size_t i = 0; i < plain.size(); ++i) {
      CAPTURE(commands[i]);
      CHECK(difference(drawn(commands[i]), plain[i], 12) == 0);
    }
  };
  session.handling.soft.on = true;
  session.handling.pivot = scene::Pivot::point;
  session.handling.point = mesh::Point{0, 0, 0};
  session.handling.mirror = scene::MirrorPlane::x;
  session.selection = {0, 1};
  for (const auto kind : {scene::ElementKind::vertex, scene::ElementKind::edge, scene::ElementKind::face}) {
    CAPTURE(static_cast<int>(kind));
    session.selecting = kind;
    shows_no_tool();
  }
  session.probes.all.emplace_back();
  session.selecting = scene::ElementKind::probe;
  session.selection = {0};
  shows_no_tool();
}

TEST_CASE("animate_writes_models_caches_morph_targets_and_pictures") {
  const AnimatedFiles files;
  Outcome outcome = files.animate("-o f_##.ply --step 4");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "f_##.ply: 5 frames, deformed in double"));
  CHECK(names_of(files.path(), ".ply") ==
        std::set<std::string>{"f_01.ply", "f_05.ply", "f_09.ply", "f_13.ply", "f_17.ply"});
  for (const char* name : {"a.pc2", "a.mdd"}) {
    outcome = files.animate(std::string("-o ") + name + " --frames 3-12");
    CHECK_MESSAGE(outcome.code == 0, outcome.text);
    CHECK(mesh::PointCache(files / name).head().frames == 10);
  }
  outcome = files.animate("-o a.glb --tolerance 0.001");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(mentions(outcome, "morph targets with linear interpolation, error up to "));
  outcome = files.animate("-o s_%02d.png --frames 4-5 --size 64x48 --no-grid");
  CHECK_MESSAGE(outcome.code == 0, outcome.text);
  CHECK(names_of(files.path(), ".png") == std::set<std::string>{"s_04.png", "s_05.png"});
  CHECK(file_bytes(files / "s_04.png") != file_bytes(files / "s_05.png"));
  CHECK(mentions(files.animate("-o s_##.png --frames 4-5 --size 64x48 --no-grid --turntable --force"),
                 "s_%02d.png' -vf "));
  CHECK(files.animate("-o g_##.obj --straight").code == 0);
  CHECK(files.animate("-o h_##.obj").code == 0);
  CHECK(file_bytes(files / "g_09.obj") == file_bytes(files / "h_09.obj"));
  CHECK(file_bytes(files / "g_05.obj") != file_bytes(files / "h_05.obj"));
}

TEST_CASE("morph_targets_are_what_another_reader_of_gltf_sees_too") {
  const AnimatedFiles files;
  REQUIRE(files.animate("-o a.glb").code == 0);
  REQUIRE(files.animate("-o f_##.ply").code == 0);
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string problem, warning;
  REQUIRE_MESSAGE(loader.LoadBinaryFromFile(&model, &problem, &warning, (files / "a.glb").string()), problem);
  CHECK(warning == "");
  const auto copy = [&](int view, std::size_t offset, void* to, std::size_t bytes) {
    const auto& v = model.bufferViews.at(static_cast<std::size_t>(view));
    REQUIRE(offset + bytes <= v.byteLength);
    std::memcpy(to, model.buffers.at(0).data.data() + v.byteOffset + offset, bytes);
  };
  const auto floats = [&](int number) {
    const auto& a = model.accessors.at(static_cast<std::size_t>(number));
    const auto parts = std::size_t(tinygltf::GetNumComponentsInType(std::uint32_t(a.type)));
    std::vector<float> all(a.count * parts);
    if (a.bufferView >= 0) copy(a.bufferView, a.byteOffset, all.data(), 4 * all.size());
    if (!a.sparse.isSparse) return all;
    const auto count = static_cast<std::size_t>(a.sparse.count);
    REQUIRE(a.sparse.indices.componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT);
    std::vector<std::uint16_t> where(count);
    std::vector<float> values(count * parts);
    copy(a.sparse.indices.bufferView, 0, where.data(), 2 * count);
    copy(a.sparse.values.bufferView, 0, values.data(), 4 * values.size());
    for (std::size_t k = 0; k < values.size(); ++k) all.at(where[k / parts] * parts + k % parts) = values[k];
    return all;
  };
  const auto& sampler = model.animations.at(0).samplers.at(0);
  CHECK(model.animations.at(0).channels.at(0).target_path == "weights");
  CHECK(sampler.interpolation == "LINEAR");
  const auto times = floats(sampler.input), weights = floats(sampler.output);
  const auto& primitive = model.meshes.at(0).primitives.at(0);
  const std::size_t targets = primitive.targets.size();
  REQUIRE(weights.size() == times.size() * targets);
  CHECK(times.front() == 0);
  CHECK(times.back() == doctest::Approx(16 / 24.0));
  auto shown = floats(primitive.attributes.at("POSITION"));
  const auto rest = shown;
  for (std::size_t t = 0; t < targets; ++t) {
    const auto delta = floats(primitive.targets[t].at("POSITION"));
    for (std::size_t i = 0; i < shown.size(); ++i)
      shown[i] += weights[weights.size() - targets + t] * delta[i];
  }
  const auto last = mesh::read(files / "f_17.ply").surface.positions;
  const auto& model_rest = files.document.model.surface->positions;
  for (std::size_t v = 0; 3 * v < rest.size(); ++v) {
    const auto near = [&](const mesh::Point& p, const std::vector<float>& all) {
      return std::hypot(p[0] - all[3 * v], p[1] - all[3 * v + 1], p[2] - all[3 * v + 2]) < 1e-5;
    };
    std::size_t own = 0;
    while (own < last.size() && !near(model_rest[own], rest)) ++own;
    REQUIRE(own < last.size());
    CHECK(near(last[own], shown));
  }
}

TEST_CASE("an_animation_that_was_killed_has_whole_frames") {
  const AnimatedDragon d;
  for (const char* signal : {"KILL", "INT"}) {
    CAPTURE(signal);
    const std::string out = std::string(signal) + "_##.ply";
    const Outcome ended = ended_by(signal, d.path(), d.line("-o '" + out + "'"),
                                   std::string(signal) + "_03.ply", std::string(signal) + "_*");
    if (std::string(signal) == "INT")
      CHECK_MESSAGE(mentions(ended, "stopped; files written so far are complete"), ended.text);
    const base::NumberedName name(d / out);
    const auto there = name.find();
    CHECK(there.size() >= 3);
    CHECK(there.size() < 41);
    for (const auto& file : there) CHECK(mesh::read(file.path).surface.positions.size() == 3000);
  }
}

TEST_CASE("frames_that_are_there_are_not_replaced_unasked") {
  const AnimatedFiles files;
  REQUIRE(files.animate("-o f_##.obj").code == 0);
  put_file(files / "f_07.obj", "mine");
  const Outcome refused = files.animate("-o f_##.obj --frames 5-9");
  CHECK(refused.code == 1);
  CHECK(mentions(refused, "f_05.obj: this file already exists and would be replaced, as 4 more would"));
  CHECK(mentions(refused, "--force"));
  setenv("VIETE_PROGRESS", "1", 1);  // as when run by the window
  CHECK_FALSE(mentions(files.animate("-o f_##.obj"), "--force"));
  unsetenv("VIETE_PROGRESS");
  CHECK(file_bytes(files / "f_07.obj") == "mine");
  CHECK(files.animate("-o f_##.obj --frames 7-7 --force").code == 0);
  REQUIRE(files.animate("-o fresh_##.obj").code == 0);
  CHECK(file_bytes(files / "f_07.obj") == file_bytes(files / "fresh_07.obj"));
}

TEST_CASE("files_of_an_earlier_run_outside_the_frames_are_noted") {
  const AnimatedFiles files;
  CHECK_FALSE(mentions(files.animate("-o f_##.ply --frames 1-6"), "existed"));
  CHECK(mentions(files.animate("-o f_##.ply --frames 1-5 --force"), "f_06.ply already existed"));
  CHECK(mentions(files.animate("-o f_##.ply --frames 2-6 --step 2 --force"),
                 "3 files from f_01.ply to f_05.ply already existed"));
  CHECK_FALSE(mentions(files.animate("-o s_##.png --frames 4-6 --size 64x48 --no-grid"), "existed"));
  CHECK(mentions(files.animate("-o s_##.png --frames 4-5 --size 64x48 --no-grid --force"),
                 "s_06.png already existed"));
}

TEST_CASE("several_programs_share_the_frames") {
  const AnimatedFiles files;
  put_file(files / "share.sh", "for r in 1-6 7-12 13-17; do '" + build_dir().string() +
                                   "/viete' animate model.obj cage.obj --keys 'p_##.obj' -o 'f_##.ply' "
                                   "--frames $r & done; wait");
  run("--version >/dev/null; cd " + quoted(files.path()) + " && sh share.sh");
  CHECK(base::NumberedName(files / "f_##.ply").find().size() == 17);
}

TEST_CASE("partial_files_of_a_killed_command_are_deleted_by_the_next_one") {
  const AnimatedFiles files;
  const char* gone[] = {"b.obj.999999999-1-0.part"};
  const char* stay[] = {"b.part", "b.obj.1-x-0.part"};
  for (const char* name : gone) put_file(files / name, "half");
  for (const char* name : stay) put_file(files / name, "half");
  const std::string running = "c.obj." + base::process_name() + "-0.part";
  put_file(files / running, "half");
  CHECK(files.animate("-o p_##.obj").code == 1);  // also if it is refused
  CHECK(files.animate("-o a.pc2 --keys none.pc2").code != 0);
  for (const char* name : gone) CHECK_MESSAGE(!fs::exists(files / name), std::string(name));
  for (const char* name : stay) CHECK_MESSAGE(fs::exists(files / name), std::string(name));
  CHECK(fs::exists(files / running));
}

TEST_CASE("animate_reports_invalid_requests_before_the_work") {
  const AnimatedFiles files;
  const auto says = [&](const std::string& rest, int code, const std::string& text) {
    const Outcome outcome = files.animate(rest);
    CHECK(outcome.code == code);
    CHECK_MESSAGE(mentions(outcome, text), outcome.text);
  };
  says("-o a.pc2 --frames 5-1", 2, "needs FIRST-LAST, such as 1-48, not 5-1");
  says("-o a.pc2 --frames x", 2, "needs FIRST-LAST");
  says("-o a.obj", 1, "write numbered files, a_####.obj");
  says("-o a.png", 1, "write numbered pictures");
  says("-o a.mp4", 1, "unknown extension .mp4");
  says("-o a.txt", 1, "unknown extension .txt");
  says("-o p_##.obj", 1, "p_01.obj: this is an input file (the keys)");
  const std::string folder = "cd " + quoted(files.path()) + " &&";
  CHECK(mentions(run("animate model.obj cage.obj -o a.pc2", folder), "--keys is required"));
  put_file(files / "s.viete",
           R"({"format": "viete session", "version": 1, "model": "model.obj", "cage": "cage.obj"})");
  CHECK(mentions(run("animate s.viete -o a.pc2", folder), "the timeline has no keys"));
  CHECK(mentions(run("animate s.viete -o cage.obj", folder), "this format stores a single frame"));
}
