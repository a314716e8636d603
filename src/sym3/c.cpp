#include "sym3/c.h"

#include <algorithm>
#include <string>

#include "sym3/derivative.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/log.h"
#include "sym3/polar.h"

namespace viete::sym3 {

namespace {

constexpr std::size_t block = 256;  // matrices per copied block

template <int N, class T>
bool is_sound(const T* data, viete_layout layout) {
  return data && layout.matrix_stride > 0 && (layout.entry_stride > 0 || N == 6);
}

// Symmetric matrices with all nine entries.
bool is_full(viete_layout layout) {
  return layout.entry_stride == 0;
}

// True if a view supports the layout without copying.
template <int N>
bool is_viewed(viete_layout layout) {
  if (is_full(layout)) return layout.matrix_stride == 9;
  return layout.matrix_stride == 1 || (layout.entry_stride == 1 && layout.matrix_stride == N);
}

template <class T, int N>
View<T, N> view_of(T* data, viete_layout layout) {
  if (is_full(layout)) return {Layout::full, data};
  if (layout.matrix_stride == 1) return {data, layout.entry_stride};
  return {Layout::packed, data};
}

// A part of a batch: in place, or copied to a buffer and finally back.
template <class T, int N>
class Part {
public:
  Part(T* data, viete_layout layout, std::size_t begin, std::size_t count)
      : data_(data + begin * layout.matrix_stride), layout_(layout), count_(count) {}

  View<const std::remove_const_t<T>, N> read() {
    if (is_viewed<N>(layout_)) return view_of<const std::remove_const_t<T>, N>(data_, layout_);
    for (std::size_t i = 0; i < count_; ++i)
      for (std::size_t k = 0; k < N; ++k) buffer_[N * i + k] = data_[i * layout_.matrix_stride + place(k)];
    return {Layout::packed, buffer_};
  }
  View<T, N> write() {
    if (is_viewed<N>(layout_)) return view_of<T, N>(data_, layout_);
    return {Layout::packed, buffer_};
  }
  void finish() {
    if (is_viewed<N>(layout_)) return;
    for (std::size_t i = 0; i < count_; ++i) {
      T* to = data_ + i * layout_.matrix_stride;
      for (std::size_t k = 0; k < N; ++k) to[place(k)] = buffer_[N * i + k];
      if (is_full(layout_)) to[3] = to[1], to[6] = to[2], to[7] = to[5];
    }
  }

private:
  // Offset of an entry within its matrix.
  std::size_t place(std::size_t k) const {
    constexpr std::size_t upper[9] = {0, 1, 2, 4, 5, 8};
    return is_full(layout_) ? upper[k] : k * layout_.entry_stride;
  }

  T* data_;
  viete_layout layout_;
  std::size_t count_;
  std::remove_const_t<T> buffer_[block * N];
};

// Calls act(begin, count) once for all, or block by block.
template <class Act>
void for_parts(bool at_once, std::size_t count, const Act& act) {
  const std::size_t step = at_once ? std::max<std::size_t>(count, 1) : block;
  for (std::size_t begin = 0; begin < count; begin += step) act(begin, std::min(step, count - begin));
}

template <class T, class F>
int apply(const T* in, viete_layout from, T* out, viete_layout to, std::size_t count, const F& f) {
  if (!is_sound<6>(in, from) || !is_sound<6>(out, to)) return -1;
  for_parts(is_viewed<6>(from) && is_viewed<6>(to), count, [&](std::size_t begin, std::size_t n) {
    Part<const T, 6> source(in, from, begin, n);
    Part<T, 6> target(out, to, begin, n);
    f(source.read(), target.write(), n);
    target.finish();
  });
  return 0;
}

template <class F>
int derive(const double* in, viete_layout from, const double* direction, viete_layout along, double* out,
           viete_layout to, std::size_t count, const F& f) {
  if (!is_sound<6>(in, from) || !is_sound<6>(direction, along) || !is_sound<6>(out, to)) return -1;
  const bool at_once = is_viewed<6>(from) && is_viewed<6>(along) && is_viewed<6>(to);
  for_parts(at_once, count, [&](std::size_t begin, std::size_t n) {
    Part<const double, 6> source(in, from, begin, n), way(direction, along, begin, n);
    Part<double, 6> target(out, to, begin, n);
    const SymView<const double> ways[] = {way.read()};
    const SymView<double> targets[] = {target.write()};
    f(source.read(), Directions<double>(ways), Derivatives<double>(targets), n);
    target.finish();
  });
  return 0;
}

template <class T>
int polar_of(const T* in, viete_layout from, T* rotations, viete_layout to, T* stretches,
             viete_layout stretch, std::size_t count) {
  if (!is_sound<9>(in, from) || !is_sound<9>(rotations, to) || !is_sound<6>(stretches, stretch)) return -1;
  const bool at_once = is_viewed<9>(from) && is_viewed<9>(to) && is_viewed<6>(stretch);
  for_parts(at_once, count, [&](std::size_t begin, std::size_t n) {
    Part<const T, 9> source(in, from, begin, n);
    Part<T, 9> rotation(rotations, to, begin, n);
    Part<T, 6> target(stretches, stretch, begin, n);
    polar(source.read(), rotation.write(), target.write(), n);
    rotation.finish(), target.finish();
  });
  return 0;
}

}  // namespace

}  // namespace viete::sym3

using namespace viete;  // NOLINT(google-build-using-namespace): these have no namespace

#define VIETE_C_FUNCTION(name, T, f)                                                           \
  int name(const T* in, viete_layout from, T* out, viete_layout to, size_t count) {            \
    return sym3::apply(in, from, out, to, count,                                               \
                       [](const auto& a, const auto& b, std::size_t n) { sym3::f(a, b, n); }); \
  }
#define VIETE_C_DERIVATIVE(name, f)                                                               \
  int name(const double* in, viete_layout from, const double* e, viete_layout along, double* out, \
           viete_layout to, size_t count) {                                                       \
    return sym3::derive(                                                                          \
        in, from, e, along, out, to, count,                                                       \
        [](const auto& a, const auto& b, const auto& c, std::size_t n) { sym3::f(a, b, c, n); }); \
  }

VIETE_C_FUNCTION(viete_exp, double, exp)
VIETE_C_FUNCTION(viete_log, double, log)
VIETE_C_FUNCTION(viete_sqrt, double, sqrt)
VIETE_C_FUNCTION(viete_inv_sqrt, double, inv_sqrt)
VIETE_C_FUNCTION(viete_exp_f, float, exp)
VIETE_C_FUNCTION(viete_log_f, float, log)
VIETE_C_FUNCTION(viete_sqrt_f, float, sqrt)
VIETE_C_FUNCTION(viete_inv_sqrt_f, float, inv_sqrt)
VIETE_C_DERIVATIVE(viete_exp_derivative, exp_derivative)
VIETE_C_DERIVATIVE(viete_log_derivative, log_derivative)
VIETE_C_DERIVATIVE(viete_sqrt_derivative, sqrt_derivative)

int viete_pow(const double* in, viete_layout from, double p, double* out, viete_layout to, size_t count) {
  return sym3::apply(in, from, out, to, count,
                     [p](const auto& a, const auto& b, std::size_t n) { sym3::pow(a, p, b, n); });
}
int viete_pow_f(const float* in, viete_layout from, double p, float* out, viete_layout to, size_t count) {
  return sym3::apply(in, from, out, to, count,
                     [p](const auto& a, const auto& b, std::size_t n) { sym3::pow(a, p, b, n); });
}
int viete_polar(const double* in, viete_layout from, double* rotations, viete_layout to, double* stretches,
                viete_layout stretch, size_t count) {
  return sym3::polar_of(in, from, rotations, to, stretches, stretch, count);
}
int viete_polar_f(const float* in, viete_layout from, float* rotations, viete_layout to, float* stretches,
                  viete_layout stretch, size_t count) {
  return sym3::polar_of(in, from, rotations, to, stretches, stretch, count);
}

const char* viete_kernel(void) {
  static const std::string name(sym3::kernel_name());
  return name.c_str();
}

#undef VIETE_C_FUNCTION
#undef VIETE_C_DERIVATIVE
