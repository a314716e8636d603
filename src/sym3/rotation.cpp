#include "sym3/rotation.h"

#include <cmath>

#include "sym3/call_kernel.h"
#include "sym3/rotation_tables.h"

namespace viete::sym3 {

namespace {

/// 0, or NaN if an entry is NaN or infinite. (Three-argument std::hypot loses a NaN.)
template <class Entries>
auto zero_if_finite(const Entries& entries) {
  typename Entries::value_type sum = 0;
  for (const auto x : entries) sum += x * 0;
  return sum;
}

/// Scalar part first.
template <class T>
struct Quaternion {
  T w, x, y, z;
};

template <class T>
void any_half_angle(const T* w, T* cosine_and_sine) {
  const T angle = std::hypot(w[0], w[1], w[2]) + zero_if_finite(Vec3<T>{w[0], w[1], w[2]});
  cosine_and_sine[0] = std::cos(angle / 2);
  cosine_and_sine[1] = std::sin(angle / 2) / angle;
}

/// Four times the products of w, x, y, z with the one of them that is largest (Shepperd 1978), so that
/// nothing cancels: a quaternion of length between 2 and 4.
template <class T>
Quaternion<T> to_quaternion(const Mat3<T>& r) {
  const T xx = r[0], yy = r[4], zz = r[8], trace = xx + yy + zz;
  const T dx = r[7] - r[5], dy = r[2] - r[6], dz = r[3] - r[1];
  const T sx = r[7] + r[5], sy = r[2] + r[6], sz = r[3] + r[1];
  if (trace >= xx && trace >= yy && trace >= zz) return {1 + trace, dx, dy, dz};
  if (xx >= yy && xx >= zz) return {dx, 1 + xx - yy - zz, sz, sy};
  if (yy >= zz) return {dy, sz, 1 + yy - xx - zz, sx};
  return {dz, sy, sx, 1 + zz - xx - yy};
}

/// Of q and -q the one with angle <= pi; at pi the one whose axis starts with a positive number.
template <class T>
bool is_wrong_half(const Quaternion<T>& q) {
  if (q.w != 0) return q.w < 0;
  if (q.x != 0) return q.x < 0;
  if (q.y != 0) return q.y < 0;
  return q.z < 0;
}

}  // namespace

void half_angle(const double* w, double* cosine_and_sine) {
  any_half_angle(w, cosine_and_sine);
}

void half_angle(const float* w, float* cosine_and_sine) {
  any_half_angle(w, cosine_and_sine);
}

template <class T>
Mat3<T> exp_rotation(const Vec3<T>& w) {
  Mat3<T> r;
  call_one(&KernelTable::exp_rotation, w.data(), r.data());
  return r;
}

void exp_rotation(const VecView<const double>& in, const MatView<double>& out, std::size_t count, const Batch& batch) {
  call_many(&KernelTable::exp_rotation, in, out, count, batch);
}

void exp_rotation(const VecView<const float>& in, const MatView<float>& out, std::size_t count, const Batch& batch) {
  call_many(&KernelTable::exp_rotation, in, out, count, batch);
}

template <class T>
Vec3<T> log_rotation(const Mat3<T>& r) {
  Quaternion<T> q = to_quaternion(r);
  if (is_wrong_half(q)) q = {-q.w, -q.x, -q.y, -q.z};
  const T sine = std::hypot(q.x, q.y, q.z) + zero_if_finite(r);
  const T factor = sine != 0 ? 2 * std::atan2(sine, q.w) / sine : T(0);
  return {q.x * factor, q.y * factor, q.z * factor};
}

template Mat3<float> exp_rotation(const Vec3<float>&);
template Mat3<double> exp_rotation(const Vec3<double>&);
template Vec3<float> log_rotation(const Mat3<float>&);
template Vec3<double> log_rotation(const Mat3<double>&);

}  // namespace viete::sym3
