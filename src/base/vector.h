// Vectors of three numbers, and arithmetic with them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <type_traits>
#include <vector>

#include "base/drawn_vertex.h"

namespace viete::base {

/// A vector. The type is in this namespace, so that argument-dependent lookup finds the operators below. A
/// Vector can be used as a std::array.
template <class T>
struct Vector : std::array<T, 3> {
  Vector() = default;
  constexpr Vector(T x, T y, T z) : std::array<T, 3>{x, y, z} {}
  /// This is a template, so that three numbers in braces always call the constructor above.
  template <std::same_as<std::array<T, 3>> Array>
  constexpr Vector(const Array& a) : std::array<T, 3>(a) {}
};

using Vec3 = Vector<double>;
using Vec3f = Vector<float>;

// The default T = double is for arguments that are lists in braces.
template <class T = double>
Vector<T> operator+(const Vector<T>& a, const Vector<T>& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
template <class T = double>
Vector<T> operator-(const Vector<T>& a, const Vector<T>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
template <class T = double>
Vector<T> operator*(std::type_identity_t<T> s, const Vector<T>& a) {
  return {s * a[0], s * a[1], s * a[2]};
}
template <class T = double>
T dot(const Vector<T>& a, const Vector<T>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// The result is exactly the same as -cross(b, a).
template <class T = double>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T = double>
T squared_norm(const Vector<T>& a) {
  return dot(a, a);
}

/// Returns the length. The square of the length must be in the range of T. The length must be from 1e-150 to
/// 1e150 for double, and from 1e-18 to 1e18 for float.
template <class T = double>
T norm(const Vector<T>& a) {
  return std::sqrt(squared_norm(a));
}

/// Returns the length of any vector. Several times slower than norm().
inline double stable_norm(const Vec3& a) {
  return std::hypot(a[0], a[1], a[2]);
}

inline double largest_abs(const Vec3& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

/// Returns the cosine of the angle between two vectors. If a vector is zero, returns -1.
inline double cosine(const Vec3& a, const Vec3& b) {
  const double lengths = std::sqrt(squared_norm(a) * squared_norm(b));
  return lengths > 0 ? dot(a, b) / lengths : -1;
}

/// Returns the direction of n as octahedral coordinates, accurate to 4e-5. n must not be 0. Source: Meyer et
/// al. 2010, On Floating-Point Normal Vectors.
inline PackedNormal pack_normal(const Vec3& n) {
  const double scale = 32767 / (std::abs(n[0]) + std::abs(n[1]) + std::abs(n[2]));
  const double fold = std::max(-n[2], 0.0);
  const auto packed = [&](double x) {
    return static_cast<std::int16_t>(std::lround(scale * (x + std::copysign(fold, x))));
  };
  return {packed(n[0]), packed(n[1])};
}

inline Vec3 unpack_normal(const PackedNormal& packed) {
  Vec3 n{packed[0] / 32767.0, packed[1] / 32767.0, 0};
  n[2] = 1 - std::abs(n[0]) - std::abs(n[1]);
  const double fold = std::max(-n[2], 0.0);
  n = n - Vec3{std::copysign(fold, n[0]), std::copysign(fold, n[1]), 0};
  return (1 / norm(n)) * n;
}

inline std::vector<Vec3> relative_to(const Vec3& origin, std::vector<Vec3> points) {
  for (Vec3& p : points) p = p - origin;
  return points;
}

}  // namespace viete::base
