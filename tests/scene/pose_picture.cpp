#include "scene/pictures/pose_picture.h"

#include <doctest/doctest.h>

#include <algorithm>

#include "scene/cube.h"

using namespace viete;
using namespace viete::scene;

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
