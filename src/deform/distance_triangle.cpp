#include "deform/distance_triangle.h"

#include <algorithm>
#include <iterator>
#include <limits>

namespace viete::deform {

namespace {

constexpr double least_near =
    1.0 / 512;  // the cage's diagonal being 1: floats of coordinates are a leaf's size

// v without its part along the unit vector, as a unit vector, at a right angle to it to the last bits; 0 if
// rounding is all that is left.
Vec3 unit_across(const Vec3& v, const Vec3& unit) {
  const Vec3 across = v - dot(v, unit) * unit;
  if (!(largest_abs(across) > 1e-14 * largest_abs(v))) return {0, 0, 0};
  const Vec3 once = (1 / largest_abs(across)) * across;
  const Vec3 twice = once - dot(once, unit) * unit;
  return (1 / norm(twice)) * twice;
}

Vec3 any_across(const Vec3& unit) {
  const int least = std::abs(unit[0]) <= std::abs(unit[1]) ? (std::abs(unit[0]) <= std::abs(unit[2]) ? 0 : 2)
                                                           : (std::abs(unit[1]) <= std::abs(unit[2]) ? 1 : 2);
  Vec3 axis{0, 0, 0};
  axis[least] = 1;
  return unit_across(axis, unit);
}

// Of an edge from (x, y) on in the triangle's coordinates: the affine functions along it and to its left, and
// its length.
void set_edge(double x, double y, double dx, double dy, double* along, double* inward, double& length) {
  const double size = std::max(std::abs(dx), std::abs(dy));
  length = size > 0 ? size * std::hypot(dx / size, dy / size) : 0;
  const double ux = length > 0 ? dx / length : 1, uy = length > 0 ? dy / length : 0;
  const double to_along[] = {ux, uy, -(ux * x + uy * y)}, to_inward[] = {-uy, ux, uy * x - ux * y};
  std::copy_n(to_along, 3, along);
  std::copy_n(to_inward, 3, inward);
}

// x along the longest edge, which is from a to b, and z across the triangle.
DistanceTriangle<double> in_own_axes(const Vec3& a, const Vec3& b, const Vec3& c) {
  DistanceTriangle<double> t{};
  const double size = largest_abs(b - a);
  const Vec3 direction = size > 0 ? (1 / size) * (b - a) : Vec3{1, 0, 0};
  const Vec3 x = (1 / norm(direction)) * direction;
  Vec3 y = unit_across(c - a, x);
  const bool has_area = largest_abs(y) > 0;
  if (!has_area) y = any_across(x);
  const Vec3 z = cross(x, y);
  const Vec3 axes[] = {x, y, z};
  for (int i = 0; i < 3; ++i) std::copy(axes[i].begin(), axes[i].end(), t.axes[i]);
  const double bx = dot(b - a, x), cx = dot(c - a, x), cy = has_area ? dot(c - a, y) : 0;
  t.length[0] = bx;
  set_edge(bx, 0, cx - bx, cy, t.along[0], t.inward[0], t.length[1]);
  set_edge(cx, cy, -cx, -cy, t.along[1], t.inward[1], t.length[2]);
  t.outside = has_area ? 0 : std::numeric_limits<double>::infinity();
  const double near = std::max(bx / 16, least_near);
  t.near = near * near;
  return t;
}

// The corner where the longest edge begins: the origin.
int first_corner(const std::array<Vec3, 3>& p) {
  const double ab = norm(p[1] - p[0]), bc = norm(p[2] - p[1]), ca = norm(p[0] - p[2]);
  return ab >= bc ? (ab >= ca ? 0 : 2) : (bc >= ca ? 1 : 2);
}

}  // namespace

DistanceTriangle<double> distance_triangle(const std::array<Vec3, 3>& corners, Vec3& origin) {
  const int first = first_corner(corners);
  origin = corners[first];
  return in_own_axes(corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]);
}

DistanceTriangle<float> in_float(const DistanceTriangle<double>& t) {
  DistanceTriangle<float> f{};
  const auto convert = [](const auto& from, auto& to) {
    std::transform(std::begin(from), std::end(from), std::begin(to),
                   [](double v) { return static_cast<float>(v); });
  };
  for (int i = 0; i < 3; ++i) convert(t.axes[i], f.axes[i]);
  for (int i = 0; i < 2; ++i) convert(t.along[i], f.along[i]), convert(t.inward[i], f.inward[i]);
  convert(t.length, f.length);
  f.outside = static_cast<float>(t.outside);
  f.near = static_cast<float>(t.near);
  f.degenerate = t.degenerate;
  return f;
}

Vec3 shift_of(const DistanceTriangle<double>& triangle, const Vec3& origin) {
  const auto along = [&](const double* axis) {
    return axis[0] * origin[0] + axis[1] * origin[1] + axis[2] * origin[2];
  };
  return {along(triangle.axes[0]), along(triangle.axes[1]), along(triangle.axes[2])};
}

}  // namespace viete::deform
