#include "deform/bound.h"
#include "formats/read.h"
#include "pose/pose_file.h"
#include "support/data.h"

using namespace viete;
using namespace viete::test;
namespace fs = std::filesystem;

namespace {

constexpr const char* models[] = {"arm",       "armadillo-man", "bar",  "bunny",      "cactus",
                                  "dragon",    "fire-hydrant",  "hand", "horse",      "man-head",
                                  "nefertiti", "octopus",       "spot", "wire-sphere"};

// Returns every `step`th vertex, to reduce the time for weights.
mesh::Surface thinned(const mesh::Surface& surface, std::size_t step) {
  mesh::Surface result;
  for (std::size_t i = 0; i < surface.positions.size(); i += step)
    result.positions.push_back(surface.positions[i]);
  return result;
}

mesh::Surface read(const fs::path& path) {
  return formats::read(path).surface;
}

}  // namespace

TEST_CASE("real_models_follow_similarities_and_affine_poses_and_no_pose_stretches_edges_far_beyond_the_cage" *
          doctest::test_suite(if_present)) {
  const fs::path data = shared_data();
  if (data.empty()) return;
  for (const std::string name : models) {
    CAPTURE(name);
    const auto model = thinned(read(data / name / "mesh.obj"), 17);
    const auto cage = read(data / name / "cage.obj");
    Bound face(model, cage), mvc(model, cage, mean_values);
    const double diagonal = face.cage->diagonal;
    CHECK(largest_distance(face.deform(rest_pose(*face.cage)), model.positions) < 1e-14 * diagonal);
    CHECK(largest_distance(mvc.deform(rest_pose(*mvc.cage)), model.positions) < 1e-14 * diagonal);
    for (const double angle : {37.0, 180.0, 200.0})
      for (const double scale : {1e-3, 1.25, 1e3}) {
        const auto map =
            similarity({1, 2, 3}, angle * degree, scale, (scale * diagonal) * Vec3{0.3, -0.2, 0.1});
        CHECK(face.error(map) < 1e-12);
        CHECK(mvc.error(map) < 1e-12);
      }
    CHECK(mvc.error(shear()) < 1e-12);
    Bound whole(read(data / name / "mesh.obj"), cage);
    for (const auto& entry : fs::directory_iterator(data / name)) {
      if (!entry.path().filename().string().starts_with("pose_")) continue;
      CAPTURE(entry.path());
      std::vector<std::string> warnings;
      const Pose pose = read_pose(entry.path(), *whole.cage, warnings);
      const auto positions = whole.deform(pose);
      CHECK(all_finite(positions));
      CHECK(whole.report().collapsed.empty());
      CHECK(largest_edge_stretch(whole.model, positions) < 6 * largest_edge_stretch(cage, pose.positions));
    }
  }
}

TEST_CASE("twists_of_200_degrees_of_real_models_do_not_tear" * doctest::test_suite(if_present)) {
  const fs::path data = shared_data();
  if (data.empty()) return;
  for (const auto& [name, axis] :
       {std::pair<std::string, int>{"arm", 1}, {"horse", 2}, {"armadillo-man", 1}, {"cactus", 1}}) {
    CAPTURE(name);
    Bound b(read(data / name / "mesh.obj"), read(data / name / "cage.obj"));
    std::vector<std::string> warnings;
    const Pose pose = read_pose(data / name / "pose_twist200.obj", *b.cage, warnings);
    CHECK(warnings.empty());
    // As in the data set, the angle grows linearly along the cage, about an axis through the cage's middle.
    const auto ends = mesh::bounds(b.cage->surface.positions);
    const Twist twist{axis, ends.center(), ends.low[axis], ends.high[axis], -100 * degree, 100 * degree};
    const auto positions = b.deform(pose);
    CHECK(b.report().torn.empty());
    // With correct logs, the stretch ratio is at most 1.6. With a wrong branch, the cactus has 4.2.
    CHECK(largest_edge_stretch(b.model, positions) <
          1.8 * largest_edge_stretch(b.cage->surface, pose.positions));
    CHECK(largest_distance(positions, mapped(b.model.positions, twist)) < 0.08 * b.cage->diagonal);
  }
}

TEST_CASE("odd_cages_and_poses_give_an_error_or_finite_positions" * doctest::test_suite(if_present)) {
  const fs::path data = shared_data("bad");
  if (data.empty()) return;
  const auto model = read(data / "ok_mesh.obj");
  int bound = 0;
  for (const auto& entry : fs::directory_iterator(data)) {
    const std::string file = entry.path().filename().string();
    if (file.rfind("cage_", 0) != 0 || file.rfind("cage_pose", 0) == 0) continue;
    CAPTURE(file);
    for (const auto& c : {faces, mean_values}) {
      try {
        Bound b(model, read(entry.path()), c);
        ++bound;
        CHECK(largest_distance(b.deform(rest_pose(*b.cage)), model.positions) <
              1e-14 * std::max(b.cage->diagonal, mesh::bounds(b.cage->surface.positions).diagonal()) +
                  1e-15 * std::max(1.0, largest_abs(b.cage->surface.positions[0])) * 1e2);
        CHECK(all_finite(b.deform(b.pose(shear()))));
      } catch (const base::Error& error) {
        CHECK(std::string(error.what()).size() > 20);
      }
    }
  }
  CHECK(bound > 20);
}
