#include "files/animation_export.h"

#include <set>

#include "files/animated_model.h"
#include "support/animated_cube.h"
#include "support/ball.h"
#include "support/far.h"
#include "support/gltf.h"
#include "support/text.h"

using namespace viete;
using namespace viete::document;
using namespace viete::files;
using test::largest_distance;
namespace fs = std::filesystem;

namespace {

// Exports the model with the pose of this frame, and returns the positions in the file.
std::vector<mesh::Point> exact_frame(const test::AnimatedCube& cube, double frame) {
  Export one = export_of(cube.document, cube / "one.ply");
  one.pose = cube.pose(frame).cage;
  write_deformed(one);
  const auto positions = formats::read(cube / "one.ply").surface.positions;
  fs::remove(cube / "one.ply");
  return positions;
}

// For each vertex of the model, returns the index in the glTF file. The vertex order in the file can differ.
std::vector<std::size_t> file_vertices(const mesh::Surface& read, const mesh::Surface& model) {
  std::vector<std::size_t> own;
  for (const mesh::Point& p : model.positions) {
    const auto at =
        std::ranges::find_if(read.positions, [&](const mesh::Point& q) { return mesh::norm(p - q) < 1e-6; });
    REQUIRE(at != read.positions.end());
    own.push_back(static_cast<std::size_t>(at - read.positions.begin()));
  }
  return own;
}

// Returns the error in diagonals of the cage that a summary states, or 0.
double stated_error(const std::string& summary) {
  constexpr std::string_view words = "error up to ";
  const auto at = summary.find(words);
  return at == summary.npos ? 0 : std::stod(summary.substr(at + words.size()));
}

std::vector<mesh::Point> exact_positions(const AnimationExport& what, double frame) {
  base::WorkerPool pool(1);
  return AnimatedModel(what.model, what.timeline, AnimatedModel::Precision::exact, 0, {}, pool)
      .positions(frame);
}

std::set<std::string> names_in(const fs::path& folder) {
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.insert(entry.path().filename().string());
  return names;
}

// Cancels an export when the progress reaches `share`. Returns true if the export stopped.
bool cancelled_at(double share, const AnimationExport& what) {
  base::Progress progress;
  std::jthread watcher([&](const std::stop_token& stop) {
    while (!stop.stop_requested() && progress.done() < share) std::this_thread::yield();
    progress.cancel();
  });
  try {
    write_animation(what, &progress);
    return false;
  } catch (const base::Cancelled&) {
    return true;
  }
}

std::string problem_of(const AnimationExport& what) {
  return test::problem_of([&] { write_animation(what); });
}

}  // namespace

TEST_CASE("numbered_frames_are_the_model_as_each_pose_deforms_it_to_the_bit") {
  const test::AnimatedCube cube;
  for (const char* extension : {"ply", "obj", "off"}) {
    CAPTURE(extension);
    AnimationExport what = animation_export_of(cube.document, cube / (std::string("f_##.") + extension));
    what.first = 3;
    what.last = 11;
    what.step = 4;
    what.model.digits.kind = formats::Digits::Kind::all;
    const AnimationReport report = write_animation(what);
    CHECK(report.frames == 3);
    for (const int frame : {3, 7, 11})
      CHECK(formats::read(base::NumberedName(what.model.file).file(frame)).surface.positions ==
            exact_frame(cube, frame));
  }
  CHECK(fs::exists(cube / "f_03.obj"));
  CHECK_FALSE(fs::exists(cube / "f_04.obj"));
}

TEST_CASE("point_caches_agree_with_double_to_the_precision_of_floats") {
  test::AnimatedCube cube;
  for (const char* name : {"a.pc2", "a.mdd"}) {
    for (const auto method : {sym3::Method::fast, sym3::Method::diag}) {  // exported in float, then in double
      CAPTURE(name);
      cube.document.put_method(method);
      const AnimationExport what = animation_export_of(cube.document, cube / name);
      const AnimationReport report = write_animation(what);
      CHECK(test::mentions(report.summary, method == sym3::Method::fast ? "in float" : "in double"));
      const formats::PointCache cache(cube / name);
      CHECK(cache.head().frames == 17);
      CHECK(cache.head().points == cube.document.model().surface->positions.size());
      for (std::size_t i = 0; i < 17; ++i)
        CHECK(largest_distance(cache.frame(i), exact_frame(cube, 1 + double(i))) < 2e-6);
    }
  }
  CHECK(formats::PointCache(cube / "a.pc2").head().start == 1);
  CHECK(formats::PointCache(cube / "a.mdd").head().seconds[12] == 0.5f);
}

TEST_CASE("no_vertex_of_any_frame_is_farther_off_than_is_stated_for_any_deformer") {
  test::AnimatedCube cube;
  formats::write(cube / "fine.obj", test::ball(1));  // the error is measured only at some of these vertices
  cube.document.put_model(open_document(cube / "fine.obj", cube.cage).model());
  const pose::Cage& cage = *cube.document.cage();
  const auto rest = test::whole(pose::rest_pose(cage)),
             bent = test::whole(test::turned_cage(cage, 90, 20, 2));
  // The export tests the error of float only at the first, middle and last frame. There, the cage rests.
  cube.document.changed_timeline().keys = {{1, rest}, {5, bent}, {9, rest}, {13, bent}, {17, rest}};
  base::WorkerPool pool(2);
  std::size_t in_float = 0;
  for (const auto preset : base::all_values<pose::Preset>()) {
    CAPTURE(base::entry_of(preset).word);
    cube.document.put_deformer(pose::deformer_of(preset));
    const AnimationExport what = animation_export_of(cube.document, cube / "a.pc2");
    const std::string summary = write_animation(what).summary;
    const double stated = stated_error(summary) * cage.diagonal;
    if (stated == 0) continue;
    ++in_float;
    AnimatedModel exact(what.model, what.timeline, AnimatedModel::Precision::exact, 0, {}, pool);
    const formats::PointCache cache(cube / "a.pc2");
    for (std::size_t i = 0; i < 17; i += 2)
      CHECK(largest_distance(cache.frame(i), exact.positions(1 + double(i))) <= stated);
  }
  CHECK(in_float >= 4);
}

TEST_CASE("morph_targets_keep_lines_as_near_to_every_frame_as_they_are_told") {
  const test::AnimatedCube cube;
  const double diagonal = 2 * std::sqrt(3.0);
  std::size_t before = 3;  // number of keys on the timeline
  for (const double tolerance : {5e-2, 1e-3}) {
    CAPTURE(tolerance);
    AnimationExport what = animation_export_of(cube.document, cube / "a.glb");
    what.tolerance = tolerance;
    const AnimationReport report = write_animation(what);
    CHECK(report.frames > before);
    CHECK(report.frames <= 17);
    before = report.frames;
    const auto read = formats::read(cube / "a.glb");
    const auto clip = read.original->morphs();
    REQUIRE(clip);
    const auto& seconds = clip->seconds();
    CHECK(seconds.size() == report.frames);
    CHECK(clip->targets().size() == report.frames - 1);  // the key at rest has no target
    CHECK(std::ranges::count_if(seconds, [](double s) { return std::abs(s - 8 / 24.0) < 1e-6; }) == 1);
    CHECK(seconds.back() == doctest::Approx(16 / 24.0));
    const auto own = file_vertices(read.surface, *cube.document.model().surface);
    double worst = 0;
    std::size_t key = 0;
    for (int frame = 1; frame <= 17; ++frame) {
      const double at = (frame - 1) / 24.0;
      while (key + 2 < seconds.size() && seconds[key + 1] < at) ++key;
      const auto a = mesh::picked<mesh::Point>(clip->at_key(key), own),
                 b = mesh::picked<mesh::Point>(clip->at_key(key + 1), own);
      const double t = (at - seconds[key]) / (seconds[key + 1] - seconds[key]);
      std::vector<mesh::Point> line(a.size());
      for (std::size_t v = 0; v < a.size(); ++v) line[v] = a[v] + t * (b[v] - a[v]);
      worst = std::max(worst, largest_distance(line, exact_frame(cube, frame)));
    }
    CHECK(worst < tolerance * diagonal);
  }
  CHECK(before == 17);
}

TEST_CASE("far_animations_keep_their_positions_or_state_the_rounding") {
  const test::TemporaryFolder folder;
  formats::write(folder / "model.obj", test::far_away(test::cube(1)));
  formats::write(folder / "cage.obj", test::far_away(test::cube(2)));
  Document document = open_document(folder / "model.obj", folder / "cage.obj");
  pose::Pose bent = pose::rest_pose(*document.cage());
  for (const int v : {1, 2, 3}) bent.positions[v] = bent.positions[v] + mesh::Point{0.3, 0.7, 1};
  document.changed_timeline().keys = {{1, test::whole(pose::rest_pose(*document.cage()))},
                                      {9, test::whole(bent)}};
  document.changed_timeline().last = 9;
  for (const char* name : {"a.pc2", "a.mdd"}) {
    const AnimationExport what = animation_export_of(document, folder / name);
    const AnimationReport report = write_animation(what);
    CHECK(test::mentions(report.notes.at(0), "rounds coordinates by up to 0.2"));
    const double error =
        largest_distance(formats::PointCache(what.model.file).frame(8), exact_positions(what, 9));
    CHECK(error > 0.1);
    CHECK(error < stated_error(report.summary) * document.cage()->diagonal);
  }
  const AnimationExport what = animation_export_of(document, folder / "a.glb");
  CHECK(test::mentions(write_animation(what).summary, "error up to 0.0001"));
  const auto read = formats::read(folder / "a.glb");
  const auto own = file_vertices(read.surface, *document.model().surface);
  const auto clip = read.original->morphs();
  for (const std::size_t key : {std::size_t{0}, clip->seconds().size() - 1})
    CHECK(largest_distance(mesh::picked<mesh::Point>(clip->at_key(key), own),
                           exact_positions(what, 1 + 24 * clip->seconds()[key])) < 4e-6);
}

TEST_CASE("targets_without_normals_take_less") {
  const test::AnimatedCube cube;
  AnimationExport what = animation_export_of(cube.document, cube / "a.glb");
  write_animation(what);
  what.normals = false;
  const auto with = fs::file_size(cube / "a.glb");
  write_animation(what);
  CHECK(fs::file_size(cube / "a.glb") < with);
}

TEST_CASE("more_targets_than_are_allowed_are_refused_with_numbers_before_anything_is_written") {
  const test::AnimatedCube cube;
  AnimationExport small = animation_export_of(cube.document, cube / "a.glb");
  small.most_bytes = 200;
  CHECK(test::mentions(problem_of(small), "the motion needs at least"));
  CHECK(test::mentions(problem_of(small), "; the limit is "));
  CHECK_FALSE(fs::exists(cube / "a.glb"));
}

TEST_CASE("keys_that_hold_jump_and_targets_come_at_every_so_many_frames") {
  test::AnimatedCube cube;
  for (auto& key : cube.document.changed_timeline().keys) key.easing = Easing::hold;
  AnimationExport what = animation_export_of(cube.document, cube / "a.glb");
  CHECK(write_animation(what).frames == 5);  // three keys and the frames just before two of the keys
  cube.document.changed_timeline().keys[0].easing = cube.document.changed_timeline().keys[1].easing =
      Easing::constant_speed;
  what = animation_export_of(cube.document, cube / "a.glb");
  what.step = 2;
  CHECK(write_animation(what).frames == 9);
}

TEST_CASE("probes_without_a_cage_move_the_model_in_time") {
  const test::AnimatedCube cube;
  Document document = open_document(cube.model, "");
  pose::Probe probe;
  probe.place = {1, 1, 1};
  probe.move = {Falloff::smooth, 1.5};
  pose::Probe locked = probe;
  locked.place = {-1, -1, -1};
  locked.locked = true;
  locked.pose.move = {0, 0, 0.25};
  document.changed_probes().all = {probe, locked};
  WholePose moved;
  moved.probes.resize(2);
  moved.probes[0].move = {1, 0, 0};
  document.changed_timeline().keys = {{1, std::make_shared<const WholePose>()},
                                      {5, std::make_shared<const WholePose>(moved)}};
  document.changed_timeline().last = 5;
  write_animation(animation_export_of(document, cube / "p.pc2"));
  write_animation(animation_export_of(document, cube / "p_#.ply"));
  const formats::PointCache cache(cube / "p.pc2");
  for (const int frame : {1, 3, 5}) {
    const auto positions = cache.frame(static_cast<std::size_t>(frame - 1));
    CHECK(positions[7][0] == doctest::Approx(1 + 0.25 * (frame - 1)));
    CHECK(positions[0][2] == doctest::Approx(-0.75));
    const auto exact = formats::read(base::NumberedName(cube / "p_#.ply").file(frame)).surface.positions;
    CHECK(largest_distance(positions, exact) < 1e-6);
  }
}

#ifndef _WIN32
TEST_CASE("a_full_disk_leaves_whole_files_and_says_so") {
  const test::AnimatedCube cube;
  for (const char* name : {"f_##.ply", "a.pc2", "a.glb"}) {
    CAPTURE(name);
    const AnimationExport what = animation_export_of(cube.document, cube / name);
    const auto before = names_in(cube.path());
    {
      const test::FullDisk full(200);
      CHECK(problem_of(what) != "");
    }
    for (const std::string& left : names_in(cube.path()))
      CHECK((before.count(left) == 1 || left.starts_with("f_")));
    for (const auto& file : base::NumberedName(cube / "f_##.ply").find()) fs::remove(file.path);
    CHECK(problem_of(what) == "");
  }
}
#endif

TEST_CASE("names_that_say_nothing_that_can_be_written_are_refused_with_what_to_do") {
  test::AnimatedCube cube;
  const auto problem = [&](const char* name) {
    return problem_of(animation_export_of(cube.document, cube / name));
  };
  CHECK(test::mentions(problem("a.obj"), "a_####.obj"));
  CHECK(test::mentions(problem("a_##.pc2"), "remove ####"));
  CHECK(test::mentions(problem("a.xyz"), "unknown extension .xyz"));
  CHECK(test::mentions(problem("none/a.pc2"), "none/a.pc2"));
  cube.document.changed_timeline().keys.clear();
  CHECK(test::mentions(problem("a.pc2"), "no keys"));
}

TEST_CASE("an_animation_that_floats_do_not_hold_leaves_nothing") {
  test::AnimatedCube cube;
  WholePose far = *cube.document.timeline().keys.back().pose;
  for (auto& p : far.cage.positions)
    for (double& x : p) x *= 1e39;  // beyond the range of float
  cube.document.changed_timeline().keys.push_back({18, test::whole(far.cage), Easing::hold});
  cube.document.changed_timeline().last = 18;
  cube.document.changed_timeline().keys[2].easing = Easing::hold;
  for (const char* name : {"a.pc2", "a.mdd", "a.glb"}) {
    CAPTURE(name);
    test::put_file(cube / name, "older");
    const auto before = names_in(cube.path());
    CHECK(problem_of(animation_export_of(cube.document, cube / name)) != "");
    CHECK(names_in(cube.path()) == before);
    CHECK(test::file_bytes(cube / name) == "older");
  }
}

TEST_CASE("an_existing_frame_is_never_overwritten_without_force") {
  const test::AnimatedCube cube;
  AnimationExport what = animation_export_of(cube.document, cube / "f_##.ply");
  test::put_file(cube / "f_05.ply", "of a user");
  const std::string problem = problem_of(what);
  CHECK(test::mentions(problem, "f_05.ply: this file already exists and would be replaced; choose"));
  CHECK_FALSE(test::mentions(problem, "--"));  // Force::none does not propose --force
  CHECK_FALSE(fs::exists(cube / "f_01.ply"));
  CHECK(test::file_bytes(cube / "f_05.ply") == "of a user");
  what.force = Force::given;
  CHECK(problem_of(what) == "");
  CHECK(formats::read(cube / "f_05.ply").surface.positions == exact_frame(cube, 5));
  what.force = Force::offered;
  CHECK(test::mentions(problem_of(what),
                       "f_01.ply: this file already exists and would be replaced, and 16 more files"));
}

TEST_CASE("a_cancelled_export_leaves_whole_files_or_none") {
  test::AnimatedCube cube;
  cube.document.changed_timeline().keys.back().frame = 400;
  cube.document.changed_timeline().last = 400;
  const auto before = names_in(cube.path());
  REQUIRE(cancelled_at(0.5, animation_export_of(cube.document, cube / "a.pc2")));
  CHECK(names_in(cube.path()) == before);
  const AnimationExport what = animation_export_of(cube.document, cube / "f_###.ply");
  REQUIRE(cancelled_at(0.3, what));
  const auto files = base::NumberedName(what.model.file).find();
  CHECK(files.size() > 50);
  CHECK(files.size() < 400);
  for (const auto& file : files)
    CHECK(formats::read(file.path).surface.positions.size() ==
          cube.document.model().surface->positions.size());
}
