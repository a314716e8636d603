// Rotations that add up beyond half a turn and can be averaged.
#pragma once

#include "dragon/vec3.h"

namespace viete::dragon {

struct Quaternion {
  double w = 1;
  Vec3 v;
};

constexpr Quaternion operator+(Quaternion a, Quaternion b) {
  return {a.w + b.w, a.v + b.v};
}
constexpr Quaternion operator*(Quaternion a, double s) {
  return {a.w * s, a.v * s};
}
constexpr Quaternion operator*(Quaternion a, Quaternion b) {
  return {a.w * b.w - dot(a.v, b.v), b.v * a.w + a.v * b.w + cross(a.v, b.v)};
}

/// About a unit axis.
constexpr Quaternion about(Vec3 axis, double degrees) {
  const Turn half = turn(degrees / 2);
  return {half.cosine, axis * half.sine};
}

/// x turned by q, a sum of rotations, of any length but 0.
constexpr Vec3 turned(Vec3 x, Quaternion q) {
  const Vec3 half = cross(q.v, x);
  return x + (half * q.w + cross(q.v, half)) * (2 / (q.w * q.w + dot(q.v, q.v)));
}

}  // namespace viete::dragon
