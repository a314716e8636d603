#include "scene/hand/transform.h"
#include "scene/document/space.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

namespace viete::scene {

namespace {

struct Turn {
  double cosine, sine;
};

Turn turn_of(double degrees) {
  const double within = std::remainder(degrees, 360.0);
  const double quarter = std::round(within / 90);
  const double rest = (within - 90 * quarter) * 0.017453292519943295;
  const double c = std::cos(rest), s = std::sin(rest);
  switch (static_cast<int>(quarter) & 3) {
    case 0: return {c, s};
    case 1: return {-s, c};
    case 2: return {-c, -s};
    default: return {s, -c};
  }
}

// O. Rodrigues' formula: cos I + sin [axis] + (1 - cos) axis axis^T.
glm::dmat3 rotation(const glm::dvec3& a, double degrees) {
  const Turn t = turn_of(degrees);
  const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
  return t.cosine * glm::dmat3(1) + t.sine * cross + (1 - t.cosine) * glm::outerProduct(a, a);
}

}  // namespace

glm::dmat3 Transform::linear() const {
  glm::dmat3 scale(1);
  for (int i = 0; i < 3; ++i) scale[i][i] = factors[i];
  if (axes != glm::dmat3(1) && factors != glm::dvec3(1)) scale = axes * scale * glm::transpose(axes);
  return rotation(axis, degrees) * scale;
}

PointMotion::PointMotion(const Transform& transform)
    : linear_(transform.linear()), shift_(transform.shift), turns_(linear_ != glm::dmat3(1)) {}

mesh::Point PointMotion::operator()(const mesh::Point& p, const glm::dvec3& pivot) const {
  const glm::dvec3 from = vector_of(p);
  const glm::dvec3 turned = turns_ ? pivot + linear_ * (from - pivot) : from;
  return point_of(turned + shift_);
}

}  // namespace viete::scene
