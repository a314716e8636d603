#include "scene/hand/shape.h"
#include "scene/document/space.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace viete::scene {

namespace {

constexpr double radians = 0.017453292519943295;

glm::dvec3 turned(const glm::dvec3& v, const glm::dvec3& axis, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  return c * v + s * glm::cross(axis, v) + (1 - c) * glm::dot(axis, v) * axis;
}

// sin(k s) / k and (1 - cos(k s)) / k, accurate for small k.
std::array<double, 2> arc(double k, double s) {
  const double angle = k * s;
  if (std::abs(angle) < 1e-4) return {s * (1 - angle * angle / 6), s * angle / 2};
  return {std::sin(angle) / k, (1 - std::cos(angle)) / k};
}

}  // namespace

std::string_view name(Shape shape) {
  static constexpr std::string_view names[] = {"",     "bend",   "twist", "taper",
                                               "push", "smooth", "relax", "flatten"};
  return names[static_cast<std::size_t>(shape)];
}

mesh::Point shaped(const Shaping& shaping, double amount, const mesh::Point& p) {
  const glm::dvec3 way = shaping.to - shaping.from;
  const double length = glm::length(way);
  const glm::dvec3 a = way / length, d = vector_of(p) - shaping.from;
  const double s = glm::dot(d, a), within = std::clamp(s, 0.0, length), t = within / length;
  const glm::dvec3 beside = d - s * a;
  if (within <= 0 && shaping.shape != Shape::taper) return p;
  if (shaping.shape == Shape::twist)
    return point_of(shaping.from + s * a + turned(beside, a, amount * t * radians));
  if (shaping.shape == Shape::taper) return point_of(shaping.from + s * a + (1 + (amount - 1) * t) * beside);
  const double angle = amount * t * radians, k = amount * radians / length;
  const auto [along, aside] = arc(k, within);
  const glm::dvec3 center = shaping.from + along * a + aside * glm::cross(shaping.hinge, a);
  return point_of(center + turned(beside + (s - within) * a, shaping.hinge, angle));
}

}  // namespace viete::scene
