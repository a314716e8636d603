#include "interact/transform.h"
#include "document/space.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace viete::interact {

namespace {

constexpr double radians = 0.017453292519943295;

struct Turn {
  double cosine, sine;
};

Turn turn_of(double degrees) {
  const double within = std::remainder(degrees, 360.0);
  const double quarter = std::round(within / 90);
  const double rest = (within - 90 * quarter) * radians;
  const double c = std::cos(rest), s = std::sin(rest);
  switch (static_cast<int>(quarter) & 3) {
    case 0: return {c, s};
    case 1: return {-s, c};
    case 2: return {-c, -s};
    default: return {s, -c};
  }
}

// Rodrigues' formula: cos * I + sin * [axis]_x + (1 - cos) * axis * axis^T.
glm::dmat3 rotation(const glm::dvec3& a, double degrees) {
  const Turn t = turn_of(degrees);
  const glm::dmat3 cross(0, a.z, -a.y, -a.z, 0, a.x, a.y, -a.x, 0);
  return t.cosine * glm::dmat3(1) + t.sine * cross + (1 - t.cosine) * glm::outerProduct(a, a);
}

glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
}

// Returns sin(k * s) / k and (1 - cos(k * s)) / k. Accurate for small k too.
std::array<double, 2> arc(double k, double s) {
  const double angle = k * s;
  if (std::abs(angle) < 1e-4) return {s * (1 - angle * angle / 6), s * angle / 2};
  return {std::sin(angle) / k, (1 - std::cos(angle)) / k};
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
  const glm::dvec3 from = document::vector_of(p);
  const glm::dvec3 turned = turns_ ? pivot + linear_ * (from - pivot) : from;
  return document::point_of(turned + shift_);
}

std::string_view name(Shape shape) {
  static constexpr std::string_view names[] = {"", "bend", "twist", "taper", "smooth", "relax"};
  return names[static_cast<std::size_t>(shape)];
}

mesh::Point shaped(const Shaping& shaping, double amount, const mesh::Point& p) {
  const glm::dvec3 way = shaping.to - shaping.from;
  const double length = glm::length(way);
  const glm::dvec3 a = way / length, d = document::vector_of(p) - shaping.from;
  const double s = glm::dot(d, a), within = std::clamp(s, 0.0, length), t = within / length;
  const glm::dvec3 beside = d - s * a;
  if (within <= 0 && shaping.shape != Shape::taper) return p;
  if (shaping.shape == Shape::twist)
    return document::point_of(shaping.from + s * a + turned(beside, a, amount * t * radians));
  if (shaping.shape == Shape::taper)
    return document::point_of(shaping.from + s * a + (1 + (amount - 1) * t) * beside);
  const double angle = amount * t * radians, k = amount * radians / length;
  const auto [along, aside] = arc(k, within);
  const glm::dvec3 center = shaping.from + along * a + aside * glm::cross(shaping.hinge, a);
  return document::point_of(center + turned(beside + (s - within) * a, shaping.hinge, angle));
}

}  // namespace viete::interact
