// Small vectors and rotations for the dragon, built on + - * / and sqrt only, so that every machine gets the
// same bits.
#pragma once

#include <algorithm>
#include <cmath>

namespace viete::dragon {

struct Vec3 {
  double x = 0, y = 0, z = 0;
};

constexpr Vec3 operator+(Vec3 a, Vec3 b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
constexpr Vec3 operator-(Vec3 a, Vec3 b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
constexpr Vec3 operator*(Vec3 a, double s) {
  return {a.x * s, a.y * s, a.z * s};
}
constexpr Vec3 operator*(double s, Vec3 a) {
  return a * s;
}
constexpr double dot(Vec3 a, Vec3 b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
constexpr Vec3 cross(Vec3 a, Vec3 b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double length(Vec3 a) {
  return std::sqrt(dot(a, a));
}
inline Vec3 normalized(Vec3 a) {
  return a * (1 / length(a));
}
constexpr Vec3 mirrored(Vec3 a) {
  return {a.x, a.y, -a.z};
}
constexpr Vec3 lerp(Vec3 a, Vec3 b, double t) {
  return a + (b - a) * t;
}
constexpr double lerp(double a, double b, double t) {
  return a + (b - a) * t;
}

/// 0 below edge0, 1 above edge1, a cubic between.
constexpr double smooth_step(double edge0, double edge1, double x) {
  const double t = std::clamp((x - edge0) / (edge1 - edge0), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

struct Turn {
  double cosine, sine;
};

/// Sine and cosine of an angle in degrees by their Taylor series (|degrees| <= 360, error below 1e-12): the C
/// library's differ in the last bit from machine to machine, and the model must not.
constexpr Turn turn(double degrees) {
  const double angle = degrees * (3.14159265358979323846 / 180) / 4;
  const double square = angle * angle;
  double cosine = 1, sine = 1;
  for (int n = 16; n >= 2; n -= 2) {
    cosine = 1 - cosine * square / ((n - 1) * n);
    sine = 1 - sine * square / (n * (n + 1));
  }
  sine *= angle;
  for (int doubling = 0; doubling < 2; ++doubling) {
    const double doubled = 2 * sine * cosine;
    cosine = cosine * cosine - sine * sine;
    sine = doubled;
  }
  return {cosine, sine};
}

/// v turned about a unit axis (Rodrigues' formula).
constexpr Vec3 rotated(Vec3 v, Vec3 axis, double degrees) {
  const Turn t = turn(degrees);
  return v * t.cosine + cross(axis, v) * t.sine + axis * (dot(axis, v) * (1 - t.cosine));
}

/// An axis-parallel box.
struct Box {
  Vec3 low{1e9, 1e9, 1e9}, high{-1e9, -1e9, -1e9};

  void add(Vec3 p, double radius) {
    low = {std::min(low.x, p.x - radius), std::min(low.y, p.y - radius), std::min(low.z, p.z - radius)};
    high = {std::max(high.x, p.x + radius), std::max(high.y, p.y + radius), std::max(high.z, p.z + radius)};
  }

  bool contains(Vec3 p, double margin) const {
    return p.x > low.x - margin && p.x < high.x + margin && p.y > low.y - margin && p.y < high.y + margin &&
           p.z > low.z - margin && p.z < high.z + margin;
  }
};

}  // namespace viete::dragon
