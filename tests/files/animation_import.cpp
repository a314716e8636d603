#include "files/animation_import.h"

#include "files/animation_export.h"
#include "formats/morph_keys.h"
#include "pose/pose_file.h"
#include "support/animated_cube.h"
#include "support/gltf.h"
#include "support/text.h"

using namespace viete;
using namespace viete::document;
using namespace viete::files;
using namespace viete::workspace;
namespace fs = std::filesystem;

namespace {

// Files with the motion of the cage.
struct CageMotion : test::AnimatedCube {
  void write(const fs::path& file) const {
    std::vector<std::vector<mesh::Point>> frames;
    for (int frame = 1; frame <= 17; ++frame) frames.push_back(pose(frame).cage.positions);
    if (formats::point_cache_format(file)) return test::write_cache(file, frames, 24);
    test::MorphAnimation animation;
    for (std::size_t i = 0; i < frames.size(); ++i)
      animation.keys.push_back({static_cast<double>(i) / 24, "frame " + std::to_string(i + 1), frames[i]});
    const mesh::Surface& cage = document.cage()->surface;
    test::write_morphs(file, {cage, cage.positions, {}}, nullptr, animation);
  }
  void write_poses() const {
    for (const int frame : {1, 9, 17})
      pose::write_pose(*this / ("p_" + std::to_string(frame) + ".obj"), *document.cage(), pose(frame).cage);
  }
  std::vector<PoseKey> keys(const fs::path& file) const {
    return read_keys(file, *document.cage(), {document.timeline().first, document.timeline().rate}).keys;
  }
  std::string problem(const fs::path& file) const {
    return test::problem_of([&] { keys(file); });
  }
};

double farthest(const pose::Pose& a, const pose::Pose& b) {
  return test::largest_distance(a.positions, b.positions);
}

}  // namespace

TEST_CASE("numbered_posed_cages_are_keys_at_their_numbers") {
  const CageMotion m;
  m.write_poses();
  for (const char* name : {"p_#.obj", "p_9.obj"}) {
    const auto keys = m.keys(m / name);
    REQUIRE(keys.size() == 3);
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK(keys[i].frame == 1 + 8 * int(i));
      CHECK(keys[i].easing == Easing::smooth);
      CHECK(keys[i].pose->cage.positions == m.pose(keys[i].frame).cage.positions);
    }
  }
  CHECK(test::mentions(m.problem(m / "q_#.obj"), "no file matches this name"));
  CHECK(test::mentions(m.problem(m.cage), "the file name has no frame number"));
}

TEST_CASE("point_caches_of_the_cage_are_keys_at_every_frame") {
  const CageMotion m;
  for (const char* name : {"c.pc2", "c.mdd"}) {
    CAPTURE(name);
    m.write(m / name);
    const auto keys = m.keys(m / name);
    REQUIRE(keys.size() == 17);
    for (const PoseKey& key : keys) {
      CHECK(key.easing == Easing::constant_speed);
      CHECK(farthest(key.pose->cage, m.pose(key.frame).cage) < 1e-5);
    }
    CHECK(keys.back().frame == 17);
  }
  write_animation(animation_export_of(m.document, m / "model.pc2"));
  CHECK(test::mentions(m.problem(m / "model.pc2"), "20 points, and the cage has 8 vertices"));
  CHECK(m.problem(m / "none.pc2") != "");
}

TEST_CASE("morph_targets_of_a_cage_are_poses_and_their_animation_keys") {
  const CageMotion m;
  m.write(m / "c.glb");
  const auto keys = m.keys(m / "c.glb");
  REQUIRE(keys.size() == 17);
  for (const PoseKey& key : keys) CHECK(farthest(key.pose->cage, m.pose(key.frame).cage) < 1e-5);
  const fs::path file = m / "c.glb";
  const auto poses = read_poses(std::span(&file, 1), *m.document.cage());
  CHECK(poses.warnings.empty());
  CHECK(read_keys(file, *m.document.cage(), {}).warnings.empty());
  REQUIRE(poses.poses.size() >= 16);  // the rest pose has no target
  CHECK(poses.poses.back().name == "frame 17");
  CHECK(farthest(poses.poses.back().pose->cage, m.pose(17).cage) < 1e-5);
  write_animation(animation_export_of(m.document, m / "model.glb"));
  CHECK(test::mentions(m.problem(m / "model.glb"), "20 points, and the cage has 8 vertices"));
}

TEST_CASE("stepped_weights_become_held_keys_and_cubic_weights_a_key_at_every_frame") {
  const CageMotion m;
  const mesh::Surface& cage = m.document.cage()->surface;
  test::GltfParts parts;
  std::vector<float> positions, up(3 * cage.positions.size(), 0);
  std::vector<std::uint16_t> corners;
  for (const mesh::Point& p : cage.positions) positions.insert(positions.end(), p.begin(), p.end());
  for (const auto& t : cage.triangles) corners.insert(corners.end(), t.begin(), t.end());
  for (std::size_t i = 1; i < up.size(); i += 3) up[i] = 1;
  parts.accessor(positions, 5126, "VEC3", 3);
  parts.accessor(corners, 5123, "SCALAR", 1);
  parts.accessor(up, 5126, "VEC3", 3);
  parts.accessor(std::vector<float>{0, 0.5F}, 5126, "SCALAR", 1);
  parts.accessor(std::vector<float>{0, 1}, 5126, "SCALAR", 1);
  parts.accessor(std::vector<float>{0, 0, 0, 0, 1, 0}, 5126, "SCALAR", 1);  // eases in and out
  parts.json["asset"] = {{"version", "2.0"}};
  parts.json["meshes"] = {
      {{"primitives",
        {{{"attributes", {{"POSITION", 0}}}, {"indices", 1}, {"targets", {{{"POSITION", 2}}}}}}}}};
  parts.json["nodes"] = {{{"mesh", 0}}};
  const auto keys = [&](const char* interpolation) {
    parts.json["animations"] = {
        {{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
         {"samplers",
          {{{"input", 3}, {"output", *interpolation == 'S' ? 4 : 5}, {"interpolation", interpolation}}}}}};
    test::put_file(m / "c.glb", parts.glb());
    return read_keys(m / "c.glb", *m.document.cage(), {1, 24}).keys;
  };
  const auto stepped = keys("STEP");
  REQUIRE(stepped.size() == 2);
  CHECK(stepped[0].easing == Easing::hold);
  CHECK(stepped[1].frame == 13);
  const auto cubic = keys("CUBICSPLINE");
  REQUIRE(cubic.size() == 13);
  for (const PoseKey& key : cubic) {
    const double u = (key.frame - 1) / 12.0;
    CHECK(key.easing == Easing::constant_speed);
    CHECK(key.pose->cage.positions[0][1] - cage.positions[0][1] ==
          doctest::Approx(u * u * (3 - 2 * u)).epsilon(1e-6));
  }
}

TEST_CASE("several_keys_on_one_frame_give_a_warning") {
  const CageMotion m;
  m.write(m / "c.mdd");
  const ImportedKeys keys = read_keys(m / "c.mdd", *m.document.cage(), {1, 12});
  CHECK(keys.keys.size() == 9);
  REQUIRE(keys.warnings.size() == 1);
  CHECK(test::mentions(keys.warnings[0], "skipped 8 keys because another key has the same frame at 12"));
}

TEST_CASE("a_folder_of_posed_cages_is_poses_in_the_order_of_their_numbers") {
  const CageMotion m;
  fs::create_directory(m / "poses");
  for (const int n : {10, 2, 1})
    pose::write_pose(m / "poses" / ("p_" + std::to_string(n) + ".obj"), *m.document.cage(),
                     test::turned_cage(*m.document.cage(), 10 * n));
  fs::copy(m.model, m / "poses" / "no_pose.obj");
  test::put_file(m / "poses" / "notes.txt", "x");
  fs::path folder = m / "poses";
  ImportedPoses read = read_poses(std::span(&folder, 1), *m.document.cage());
  REQUIRE(read.poses.size() == 3);
  CHECK(read.poses[0].name == "p_1");
  CHECK(read.poses[1].name == "p_2");
  CHECK(read.poses[2].name == "p_10");
  CHECK(read.warnings.size() == 1);
  CHECK(test::mentions(read.warnings.back(), "skipped"));
  fs::create_directory(m / "empty");
  folder = m / "empty";
  CHECK_THROWS_AS(read_poses(std::span(&folder, 1), *m.document.cage()), base::Error);
  folder = m.model;
  CHECK_THROWS_AS(read_poses(std::span(&folder, 1), *m.document.cage()), base::Error);
}

TEST_CASE("poses_and_animations_are_opened_as_edits") {
  const CageMotion m;
  m.write_poses();
  Workspace w;
  using What = OpenRequest::What;
  REQUIRE(test::open_now(w, {What::model, {m.model, m.cage}}));
  REQUIRE(test::open_now(w, {What::poses, {m / "p_9.obj", m / "p_17.obj"}}));
  CHECK(w.document.library().poses.size() == 2);
  REQUIRE(test::open_now(w, {What::animation, {m / "p_9.obj"}}));
  CHECK(w.document.timeline().keys.size() == 3);
  CHECK(w.document.timeline().first == 1);
  CHECK(w.document.timeline().last == 17);
  CHECK_FALSE(test::open_now(w, {What::animation, {m.cage}}));
  CHECK(w.document.timeline().keys.size() == 3);
  m.write(m / "dropped.pc2");
  REQUIRE(test::open_now(w, {What::dropped, {m / "dropped.pc2"}}));
  CHECK(w.document.timeline().keys.size() == 17);
  undo(w.document);
  CHECK(w.document.timeline().keys.size() == 3);
  undo(w.document);
  CHECK(w.document.timeline().keys.empty());
  undo(w.document);
  CHECK(w.document.library().poses.empty());
  redo(w.document);
}
