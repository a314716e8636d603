// Vectors of three numbers, from files to the frame, and their algebra.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <type_traits>
#include <vector>

namespace viete::base {

/// A type of its own, so that its operators are found wherever it goes; an array, so that whoever knows no
/// meshes takes and makes it.
template <class T>
struct Vector : std::array<T, 3> {
  Vector() = default;
  constexpr Vector(T x, T y, T z) : std::array<T, 3>{x, y, z} {}
  /// Not of braces, which are its own three numbers.
  template <std::same_as<std::array<T, 3>> Array>
  constexpr Vector(const Array& a) : std::array<T, 3>(a) {}
};

using Vec3 = Vector<double>;
using Vec3f = Vector<float>;

// In the numbers of the arguments; where these are only braces, in double.
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

/// cross(a, b) == -cross(b, a) to the last bit.
template <class T = double>
Vector<T> cross(const Vector<T>& a, const Vector<T>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

template <class T = double>
T squared_norm(const Vector<T>& a) {
  return dot(a, a);
}

/// For lengths whose squares are within the range of T: 1e-150 to 1e150 in double, 1e-18 to 1e18 in float.
template <class T = double>
T norm(const Vector<T>& a) {
  return std::sqrt(squared_norm(a));
}

/// For any length; several times as slow.
inline double stable_norm(const Vec3& a) {
  return std::hypot(a[0], a[1], a[2]);
}

inline double largest_abs(const Vec3& a) {
  return std::max({std::abs(a[0]), std::abs(a[1]), std::abs(a[2])});
}

/// Of the angle between them; -1 where one has no length.
inline double cosine(const Vec3& a, const Vec3& b) {
  const double lengths = std::sqrt(squared_norm(a) * squared_norm(b));
  return lengths > 0 ? dot(a, b) / lengths : -1;
}

inline std::vector<Vec3> relative_to(const Vec3& origin, std::vector<Vec3> points) {
  for (Vec3& p : points) p = p - origin;
  return points;
}

}  // namespace viete::base
