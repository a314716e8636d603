#include "sym3/rotation.h"

#include <cmath>

#include "sym3/call_kernel.h"
#include "sym3/rotation_tables.h"

namespace viete::sym3 {

namespace {

template <class T>
void any_half_angle(const T* w, T* cosine_and_sine) {
  const T zero_if_finite = w[0] * 0 + w[1] * 0 + w[2] * 0;  // three-argument std::hypot loses a NaN
  const T angle = std::hypot(w[0], w[1], w[2]) + zero_if_finite;
  cosine_and_sine[0] = std::cos(angle / 2);
  cosine_and_sine[1] = std::sin(angle / 2) / angle;
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

void exp_rotation(const VecView<const double>& in, const MatView<double>& out, std::size_t count,
                  const Batch& batch) {
  call_many(&KernelTable::exp_rotation, in, out, count, batch);
}

void exp_rotation(const VecView<const float>& in, const MatView<float>& out, std::size_t count,
                  const Batch& batch) {
  call_many(&KernelTable::exp_rotation, in, out, count, batch);
}

template <class T>
Vec3<T> log_rotation(const Mat3<T>& r) {
  Vec3<T> w;
  call_one(&KernelTable::log_rotation, r.data(), w.data());
  return w;
}

void log_rotation(const MatView<const double>& in, const VecView<double>& out, std::size_t count,
                  const Batch& batch) {
  call_many(&KernelTable::log_rotation, in, out, count, batch);
}

void log_rotation(const MatView<const float>& in, const VecView<float>& out, std::size_t count,
                  const Batch& batch) {
  call_many(&KernelTable::log_rotation, in, out, count, batch);
}

template Mat3<float> exp_rotation(const Vec3<float>&);
template Mat3<double> exp_rotation(const Vec3<double>&);
template Vec3<float> log_rotation(const Mat3<float>&);
template Vec3<double> log_rotation(const Mat3<double>&);

}  // namespace viete::sym3
