#include "sym3/rotation.h"

#include <cmath>
#include <numbers>

#include "sym3/call_kernel.h"
#include "sym3/fallback.h"
#include "sym3/products.h"

namespace viete::sym3 {

namespace {

template <class T>
void any_half_angle(const T* w, T* cosine_and_sine) {
  const T zero_if_finite = w[0] * 0 + w[1] * 0 + w[2] * 0;  // three-argument std::hypot loses a NaN
  const T angle = std::hypot(w[0], w[1], w[2]) + zero_if_finite;
  if (std::isinf(angle)) {  // half of it is a number
    const T half = std::hypot(w[0] / 2, w[1] / 2, w[2] / 2);
    cosine_and_sine[0] = std::cos(half);
    cosine_and_sine[1] = std::sin(half) / half / 2;
    return;
  }
  cosine_and_sine[0] = std::cos(angle / 2);
  cosine_and_sine[1] = std::sin(angle / 2) / angle;
}

}  // namespace

template <class T>
Mat3<T> exp_rotation(const Vec3<T>& w) {
  Mat3<T> r;
  call_one(&KernelFunctions<T>::exp_rotation, w.data(), r.data());
  return r;
}

template <class T>
Vec3<T> log_rotation(const Mat3<T>& r) {
  Vec3<T> w;
  call_one(&KernelFunctions<T>::log_rotation, r.data(), w.data());
  return w;
}

#define VIETE_FOR(T)                                                                      \
  template Mat3<T> exp_rotation(const Vec3<T>&);                                          \
  template Vec3<T> log_rotation(const Mat3<T>&);                                          \
  void half_angle(const T* w, T* cosine_and_sine) {                                       \
    any_half_angle(w, cosine_and_sine);                                                   \
  }                                                                                       \
  void exp_rotation(const VecView<const T>& in, const MatView<T>& out, std::size_t count, \
                    const Batch& batch) {                                                 \
    call_many(&KernelFunctions<T>::exp_rotation, in, out, count, batch);                  \
  }                                                                                       \
  void log_rotation(const MatView<const T>& in, const VecView<T>& out, std::size_t count, \
                    const Batch& batch) {                                                 \
    call_many(&KernelFunctions<T>::log_rotation, in, out, count, batch);                  \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

// |(angle + 2 pi k) n - reference|^2 with v = angle n is a parabola in k with its least value at
// k = (n . reference - angle) / 2 pi: the nearest whole number is the branch. Near a whole turn v is nearly 0
// and its direction rounding, so that a long reference gives the axis.
Vec3<double> nearest_branch(const Vec3<double>& v, const Vec3<double>& reference) {
  constexpr double turn = 2 * std::numbers::pi;
  // What v may have across a reference, in radians, by rounding alone: about a hundred units in the last
  // place of a whole turn.
  constexpr double along_reference = 1e-13;
  const double angle = norm(v);
  if (dot(reference, reference) > turn * turn / 4) {
    const double length = norm(reference);
    const Vec3<double> axis = times(1 / length, reference);
    const double along = dot(v, axis);
    if (norm(plus(v, -1, times(along, axis))) <= along_reference) {
      return times(along + turn * std::round((length - along) / turn), axis);
    }
  }
  if (angle == 0) return v;
  const double gap = dot(reference, v) / angle - angle;
  if (std::abs(gap) < turn / 2) return v;
  return times((angle + turn * std::round(gap / turn)) / angle, v);
}

}  // namespace viete::sym3
