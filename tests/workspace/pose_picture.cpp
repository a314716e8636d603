#include "workspace/pose_picture.h"

#include <complex>

#include "support/cube.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;

namespace {

struct Box {
  glm::vec2 low{1e9f}, high{-1e9f};
};

Box box_of(const std::vector<PictureShape>& shapes) {
  Box box;
  for (const auto& shape : shapes)
    for (const auto& p : shape.points) {
      box.low = glm::min(box.low, p);
      box.high = glm::max(box.high, p);
    }
  return box;
}

float height_of(const std::vector<PictureShape>& shapes) {
  const Box box = box_of(shapes);
  return box.high.y - box.low.y;
}

pose::Pose scaled(const pose::Cage& cage, double factor) {
  pose::Pose pose = pose::rest_pose(cage);
  for (auto& p : pose.positions)
    for (double& x : p) x *= factor;
  return pose;
}

std::vector<PictureShape> cube_picture() {
  const mesh::Surface cube = test::cube();
  return pose_picture(cube, cube.positions, UpAxis::y);
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
    return height_of(
        pose_picture(document.cage()->surface, scaled(*document.cage(), factor).positions, UpAxis::y));
  };
  CHECK(size(0.5) == doctest::Approx(0.5 * size(1)));
  CHECK(size(4) == doctest::Approx(size(1)));
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
  CHECK(height_of(pictures.of(document, other, UpAxis::y)) < 0.6f * pose_picture_size.y);
}

TEST_CASE("without_a_cage_a_pose_without_a_shape_shows_the_model_at_rest") {
  const Document document(test::cube_document().model());
  PosePictures pictures;
  CHECK_FALSE(pictures.of(document, std::make_shared<const WholePose>(), UpAxis::y).empty());
}

TEST_CASE("a_view_fills_its_frame_keeps_lengths_and_looks_from_above") {
  const auto shapes = cube_picture();
  const Box box = box_of(shapes);
  CHECK(box.high.y - box.low.y == doctest::Approx(pose_picture_size.y - 6));  // the cube fills the height
  CHECK(glm::distance(0.5f * (box.low + box.high), 0.5f * pose_picture_size) < 1e-3f);
  // The edges of a cube, as complex numbers, have the sum of squares 0 if and only if lengths are kept.
  std::complex<float> squares = 0;
  float lengths = 0, sides = 0, top = 0;
  for (const auto& shape : shapes) {
    const std::size_t n = shape.points.size();
    int upright = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const glm::vec2 edge = shape.points[(i + 1) % n] - shape.points[i];
      squares += std::pow(std::complex<float>(edge.x, edge.y), 2);
      lengths += glm::dot(edge, edge);
      upright += std::abs(edge.x) < 1e-4f;
    }
    const glm::vec2 middle = 0.25f * (shape.points[0] + shape.points[1] + shape.points[2] + shape.points[3]);
    if (upright == 2)
      sides += 0.5f * middle.y;
    else
      top += middle.y;
  }
  CHECK(std::abs(squares) < 1e-4f * lengths);
  CHECK(top < sides);
}

TEST_CASE("areas_are_clockwise_and_lit_by_where_they_face") {
  const auto shapes = cube_picture();
  REQUIRE(shapes.size() == 3);
  for (const auto& s : shapes) {
    CHECK(signed_area(s.points) > 0);
    CHECK(s.tone > 0.3f);
    CHECK(s.tone <= 1);
  }
  CHECK(shapes[0].tone != shapes[1].tone);
}
