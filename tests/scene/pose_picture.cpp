#include "scene/pictures/pose_picture.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "scene/cube.h"
#include "scene/pictures/choice_picture.h"
#include "scene/pictures/picture_view.h"

using namespace viete;
using namespace viete::scene;
using scene::Ink, scene::PictureView;

namespace {

glm::vec2 extent(const std::vector<PictureShape>& shapes) {
  glm::vec2 low(1e9f), high(-1e9f);
  for (const auto& shape : shapes)
    for (const auto& p : shape.points) low = glm::min(low, p), high = glm::max(high, p);
  return high - low;
}

deform::Pose scaled(const deform::Cage& cage, double factor) {
  deform::Pose pose = deform::rest_pose(cage);
  for (auto& p : pose.positions)
    for (double& x : p) x *= factor;
  return pose;
}

const mesh::Surface& unit_cube() {
  static const mesh::Surface cube = scene::lattice_surface({{-1, 1}, {-1, 1}, {-1, 1}});
  return cube;
}

PictureView view_of(const mesh::Surface& surface, scene::PictureAngles angles = {}) {
  return {angles, {surface.positions, {200, 100}, 10}};
}

// Above 0: clockwise on screen, where y points down.
float signed_area(const std::vector<glm::vec2>& points) {
  float sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec2 a = points[i], b = points[(i + 1) % points.size()];
    sum += 0.5f * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

}  // namespace

TEST_CASE("a_picture_shows_the_cage_of_the_pose_within_its_frame") {
  const auto document = test::cube_document();
  const auto rest = pose_picture(*document.cage, document.pose, UpAxis::y);
  REQUIRE_FALSE(rest.empty());
  for (const auto& shape : rest) {
    for (const auto& p : shape.points) {
      CHECK(p.x >= 0);
      CHECK(p.y >= 0);
      CHECK(p.x <= pose_picture_size.x);
      CHECK(p.y <= pose_picture_size.y);
    }
  }
}

TEST_CASE("a_smaller_pose_is_smaller_in_its_picture_and_a_larger_one_fits") {
  const auto document = test::cube_document();
  const auto size = [&](double factor) {
    return extent(pose_picture(*document.cage, scaled(*document.cage, factor), UpAxis::y));
  };
  CHECK(size(0.5).y == doctest::Approx(0.5 * size(1).y));
  CHECK(size(4).y == doctest::Approx(size(1).y));
}

TEST_CASE("a_picture_is_kept_while_its_pose_is_in_use") {
  const auto document = test::cube_document();
  PosePictures pictures;
  auto pose = std::make_shared<const WholePose>(WholePose{document.pose, {}});
  const auto* first = &pictures.of(document, pose, UpAxis::y);
  pictures.tidy();
  CHECK(&pictures.of(document, pose, UpAxis::y) == first);
  pose.reset();
  pictures.tidy();
  const auto other = std::make_shared<const WholePose>(WholePose{scaled(*document.cage, 0.5), {}});
  CHECK(extent(pictures.of(document, other, UpAxis::y)).y < 0.6f * pose_picture_size.y);
}

TEST_CASE("a_view_fills_its_frame_and_keeps_shapes") {
  const PictureView view = view_of(unit_cube());
  CHECK(view.at({0, 0, 0}) == glm::vec2(100, 50));
  CHECK(view.at({1, 1, 0}) == glm::vec2(140, 10));  // limited by the height
  CHECK(view.at({1, 1, -1}) == view.at({1, 1, 1}));
}

TEST_CASE("turning_a_view_keeps_lengths") {
  const PictureView view = view_of(unit_cube(), {-30, 25});
  for (const mesh::Vec3& p : {mesh::Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, -0.2, 0.7}})
    CHECK(mesh::norm(view.seen(p)) == doctest::Approx(mesh::norm(p)));
  CHECK(view.seen({0, 1, 0})[2] > 0);  // from above
  CHECK(view.seen({0, 1, 0})[0] == doctest::Approx(0));
}

TEST_CASE("only_what_faces_the_viewer_is_seen_the_farthest_first") {
  const mesh::Surface& cube = unit_cube();
  CHECK(scene::facing(view_of(cube), cube, cube.positions).size() == 1);
  CHECK(scene::facing(view_of(cube, {-30, 25}), cube, cube.positions).size() == 3);
  const mesh::Surface steps = scene::lattice_surface({{0, 1, 2}, {0, 1}, {0, 1, 2}},
                                                     [](int x, int, int z) { return x == 1 || z == 0; });
  const PictureView view = view_of(steps);
  const auto seen = scene::facing(view, steps, steps.positions);
  REQUIRE(seen.size() == 2);
  CHECK(view.seen(steps.positions[steps.corners[4 * seen[0]]])[2] == 1);
  CHECK(view.seen(steps.positions[steps.corners[4 * seen[1]]])[2] == 2);
}

TEST_CASE("areas_are_clockwise_and_lit_by_where_they_face") {
  const mesh::Surface& cube = unit_cube();
  const auto shapes = scene::lit_model(view_of(cube, {-30, 25}), cube, cube.positions);
  REQUIRE(shapes.size() == 3);
  for (const auto& s : shapes) {
    CHECK(signed_area(s.points) > 0);
    REQUIRE(s.tones.size() == 1);
    CHECK(s.tones[0] > 0.3f);
    CHECK(s.tones[0] <= 1);
  }
  CHECK(shapes[0].tones != shapes[1].tones);
}

TEST_CASE("edges_of_a_cage_are_before_or_behind") {
  const deform::Cage cage = deform::make_cage(unit_cube());
  const auto& at = cage.surface.positions;
  const PictureView view = view_of(cage.surface, {-30, 25});
  CHECK(scene::cage_lines(view, cage, at, Ink::cage).size() == 9);
  CHECK(scene::cage_lines(view, cage, at, Ink::behind).size() == 3);
}

TEST_CASE("an_outline_comes_back_to_where_it_began") {
  const mesh::Surface& cube = unit_cube();
  const PictureView view = view_of(cube);
  const auto seen = scene::facing(view, cube, cube.positions);
  const auto line = scene::outline(view, cube, seen[0], cube.positions);
  CHECK(line.ink == Ink::marked);
  CHECK(line.points.size() == 5);
  CHECK(line.points.front() == line.points.back());
}
