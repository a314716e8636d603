// Small vector arithmetic on plain arrays, shared by the links of the chain.
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "deform/cage.h"

namespace viete::deform {

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Vec3 operator*(double s, const Vec3& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Vec3& a, const Vec3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline double squared_norm(const Vec3& a) {
  return dot(a, a);
}
inline double norm(const Vec3& a) {
  return std::sqrt(dot(a, a));
}

/// cross(a, b) == -cross(b, a) to the last bit.
inline Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline double largest_abs(const Vec3& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

inline std::vector<Vec3> relative_to(const Vec3& origin, std::vector<Vec3> points) {
  for (Vec3& p : points) p = p - origin;
  return points;
}

}  // namespace viete::deform
