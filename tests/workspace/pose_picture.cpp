#include "workspace/pose_picture.h"

#include "support/cube.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;
using workspace::PictureView;

namespace {

glm::vec2 extent(const std::vector<PictureShape>& shapes) {
  glm::vec2 low(1e9f), high(-1e9f);
  for (const auto& shape : shapes)
    for (const auto& p : shape.points) {
      low = glm::min(low, p);
      high = glm::max(high, p);
    }
  return high - low;
}

pose::Pose scaled(const pose::Cage& cage, double factor) {
  pose::Pose pose = pose::rest_pose(cage);
  for (auto& p : pose.positions)
    for (double& x : p) x *= factor;
  return pose;
}

PictureView view_of(const mesh::Surface& surface, workspace::PictureAngles angles = {}) {
  return {angles, {surface.positions, {200, 100}, 10}};
}

// Returns a positive area for points in clockwise order on screen, because y points down.
float signed_area(const std::vector<glm::vec2>& points) {
  float sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::vec2 a = points[i], b = points[(i + 1) % points.size()];
    sum += 0.5f * (a.x * b.y - a.y * b.x);
  }
  return sum;
}

}  // namespace

TEST_CASE("a_picture_fits_its_frame_and_a_smaller_pose_is_smaller") {
  const auto document = test::cube_document();
  const auto size = [&](double factor) {
    return extent(
        pose_picture(document.cage()->surface, scaled(*document.cage(), factor).positions, UpAxis::y));
  };
  CHECK(size(0.5).y == doctest::Approx(0.5 * size(1).y));
  CHECK(size(4).y == doctest::Approx(size(1).y));
  for (const auto& shape : pose_picture(document.cage()->surface, document.pose().positions, UpAxis::y))
    for (const auto& p : shape.points) CHECK(glm::clamp(p, glm::vec2(0), pose_picture_size) == p);
}

TEST_CASE("a_picture_is_kept_while_its_pose_is_in_use") {
  const auto document = test::cube_document();
  PosePictures pictures;
  auto pose = std::make_shared<const WholePose>(WholePose{document.pose(), {}});
  const auto* first = &pictures.of(document, pose, UpAxis::y);
  pictures.tidy();
  CHECK(&pictures.of(document, pose, UpAxis::y) == first);
  pose.reset();
  pictures.tidy();
  const auto other = std::make_shared<const WholePose>(WholePose{scaled(*document.cage(), 0.5), {}});
  CHECK(extent(pictures.of(document, other, UpAxis::y)).y < 0.6f * pose_picture_size.y);
}

TEST_CASE("without_a_cage_a_pose_without_a_shape_shows_the_model_at_rest") {
  const Document document(test::cube_document().model());
  PosePictures pictures;
  CHECK_FALSE(pictures.of(document, std::make_shared<const WholePose>(), UpAxis::y).empty());
}

TEST_CASE("a_view_fills_its_frame_and_keeps_lengths") {
  const mesh::Surface cube = test::cube();
  CHECK(view_of(cube).at({0, 0, 0}) == glm::vec2(100, 50));
  CHECK(view_of(cube).at({1, 1, 0}) == glm::vec2(140, 10));  // the cube fills the height
  const PictureView view = view_of(cube, {-30, 25});
  for (const mesh::Vec3& p : {mesh::Vec3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.3, -0.2, 0.7}})
    CHECK(mesh::norm(view.seen(p)) == doctest::Approx(mesh::norm(p)));
  CHECK(view.seen({0, 1, 0})[2] > 0);
  CHECK(view.seen({0, 1, 0})[0] == doctest::Approx(0));
}

TEST_CASE("areas_are_clockwise_and_lit_by_where_they_face") {
  const mesh::Surface cube = test::cube();
  const auto shapes = workspace::lit_model(view_of(cube, {-30, 25}), cube, cube.positions);
  REQUIRE(shapes.size() == 3);
  for (const auto& s : shapes) {
    CHECK(signed_area(s.points) > 0);
    CHECK(s.tone > 0.3f);
    CHECK(s.tone <= 1);
  }
  CHECK(shapes[0].tone != shapes[1].tone);
}
