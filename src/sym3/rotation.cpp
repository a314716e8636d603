#include "sym3/rotation.h"

#include <cmath>

#include "sym3/call_kernel.h"
#include "sym3/fallback.h"

namespace viete::sym3 {

namespace {

template <class T>
void any_half_angle(const T* w, T* cosine_and_sine) {
  const T zero_if_finite = w[0] * 0 + w[1] * 0 + w[2] * 0;  // because std::hypot(inf, nan, 0) is inf
  const T angle = std::hypot(w[0], w[1], w[2]) + zero_if_finite;
  if (std::isinf(angle)) {  // the length overflows, but half the length does not
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
  return call_one<Mat3<T>>(&KernelFunctions<T>::exp_rotation, w.data());
}

template <class T>
Vec3<T> log_rotation(const Mat3<T>& r) {
  return call_one<Vec3<T>>(&KernelFunctions<T>::log_rotation, r.data());
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

}  // namespace viete::sym3
