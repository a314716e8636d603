#include "sym3/c.h"

#include <algorithm>
#include <string>
#include <type_traits>

#include "sym3/decomposition.h"
#include "sym3/derivative.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/log.h"
#include "sym3/polar.h"

namespace viete::sym3 {

namespace {

constexpr std::size_t block = 256;  // number of matrices that are copied at once

// An array of matrices. Functions read or write N entries of each matrix.
template <class T, int N>
struct Argument {
  T* data;
  viete_layout layout;

  bool is_full() const { return layout.entry_stride == 0; }
  bool is_sound() const { return data && layout.matrix_stride > 0 && (!is_full() || N == 6); }
  bool is_viewed() const {
    if (is_full()) return layout.matrix_stride == 9;
    return layout.matrix_stride == 1 || (layout.entry_stride == 1 && layout.matrix_stride == N);
  }
  View<T, N> view(std::size_t begin) const {
    T* const first = data + begin * layout.matrix_stride;
    if (is_full()) return {Layout::full, first};
    if (layout.matrix_stride == 1) return {first, layout.entry_stride};
    return {Layout::packed, first};
  }
  std::size_t place(std::size_t k) const {
    constexpr std::size_t upper[9] = {0, 1, 2, 4, 5, 8};
    return is_full() ? upper[k] : k * layout.entry_stride;
  }
};

// A part of an array: a view of the array or, if the layout needs it, a copy. finish() copies output back.
template <class T, int N>
class Part {
public:
  Part(const Argument<T, N>& all, std::size_t begin, std::size_t count)
      : all_(all), begin_(begin), count_(count) {
    if constexpr (std::is_const_v<T>) {
      if (!all_.is_viewed()) for_entries([](T& entry, auto& copy) { copy = entry; });
    }
  }
  View<T, N> view() { return all_.is_viewed() ? all_.view(begin_) : View<T, N>(Layout::packed, buffer_); }
  void finish() {
    if constexpr (!std::is_const_v<T>) {
      if (all_.is_viewed()) return;
      for_entries([](T& entry, auto& copy) { entry = copy; });
      for (std::size_t i = 0; i < count_ && all_.is_full(); ++i) {
        T* to = all_.data + (begin_ + i) * all_.layout.matrix_stride;
        to[3] = to[1];
        to[6] = to[2];
        to[7] = to[5];
      }
    }
  }

private:
  template <class Act>
  void for_entries(const Act& act) {
    for (std::size_t i = 0; i < count_; ++i) {
      T* const matrix = all_.data + (begin_ + i) * all_.layout.matrix_stride;
      for (std::size_t k = 0; k < N; ++k) act(matrix[all_.place(k)], buffer_[N * i + k]);
    }
  }

  Argument<T, N> all_;
  std::size_t begin_, count_;
  std::remove_const_t<T> buffer_[block * N];
};

// Calls f(views..., count) once, or once for each block if a layout needs copies. Invalid arguments give -1.
template <class F, class... T, int... N>
int apply(std::size_t count, const F& f, const Argument<T, N>&... all) {
  if (!(all.is_sound() && ...)) return -1;
  const std::size_t step = (all.is_viewed() && ...) ? std::max<std::size_t>(count, 1) : block;
  for (std::size_t begin = 0; begin < count; begin += step) {
    const std::size_t n = std::min(step, count - begin);
    const auto act = [&](Part<T, N>... parts) {
      f(parts.view()..., n);
      (parts.finish(), ...);
    };
    act(Part<T, N>(all, begin, n)...);
  }
  return 0;
}

template <class T, class F>
int map(const T* in, viete_layout from, T* out, viete_layout to, std::size_t count, const F& f) {
  return apply(count, f, Argument<const T, 6>{in, from}, Argument<T, 6>{out, to});
}

template <class F>
int derive(const double* in, viete_layout from, const double* direction, viete_layout along, double* out,
           viete_layout to, std::size_t count, const F& f) {
  const auto one = [&](const auto& s, const SymView<const double>& direction, const SymView<double>& target,
                       std::size_t n) {
    f(s, Directions<double>(&direction, 1), Derivatives<double>(&target, 1), n);
  };
  return apply(count, one, Argument<const double, 6>{in, from}, Argument<const double, 6>{direction, along},
               Argument<double, 6>{out, to});
}

template <class T>
int polar_of(const T* in, viete_layout from, T* rotations, viete_layout to, T* stretches,
             viete_layout stretch, std::size_t count) {
  return apply(
      count, [](const auto& m, const auto& r, const auto& u, std::size_t n) { polar(m, r, u, n); },
      Argument<const T, 9>{in, from}, Argument<T, 9>{rotations, to}, Argument<T, 6>{stretches, stretch});
}

template <class T>
int eigh_of(const T* in, viete_layout from, T* values, viete_layout value, T* vectors, viete_layout vector,
            std::size_t count) {
  return apply(
      count, [](const auto& s, const auto& w, const auto& v, std::size_t n) { eigh(s, w, v, n); },
      Argument<const T, 6>{in, from}, Argument<T, 3>{values, value}, Argument<T, 9>{vectors, vector});
}

template <class T>
int svd_of(const T* in, viete_layout from, T* u, viete_layout to_u, T* values, viete_layout value, T* v,
           viete_layout to_v, std::size_t count) {
  return apply(
      count,
      [](const auto& m, const auto& u, const auto& s, const auto& v, std::size_t n) { svd(m, u, s, v, n); },
      Argument<const T, 9>{in, from}, Argument<T, 9>{u, to_u}, Argument<T, 3>{values, value},
      Argument<T, 9>{v, to_v});
}

}  // namespace

}  // namespace viete::sym3

using namespace viete;  // the functions have no namespace

#define VIETE_C_FUNCTION(name, T, f)                                                         \
  int name(const T* in, viete_layout from, T* out, viete_layout to, size_t count) {          \
    return sym3::map(in, from, out, to, count,                                               \
                     [](const auto& a, const auto& b, std::size_t n) { sym3::f(a, b, n); }); \
  }
#define VIETE_C_DERIVATIVE(name, f)                                                               \
  int name(const double* in, viete_layout from, const double* e, viete_layout along, double* out, \
           viete_layout to, size_t count) {                                                       \
    return sym3::derive(                                                                          \
        in, from, e, along, out, to, count,                                                       \
        [](const auto& a, const auto& b, const auto& c, std::size_t n) { sym3::f(a, b, c, n); }); \
  }

#define VIETE_C_PRECISION(T, suffix)                                                                       \
  VIETE_C_FUNCTION(viete_exp##suffix, T, exp)                                                              \
  VIETE_C_FUNCTION(viete_log##suffix, T, log)                                                              \
  VIETE_C_FUNCTION(viete_sqrt##suffix, T, sqrt)                                                            \
  VIETE_C_FUNCTION(viete_inv_sqrt##suffix, T, inv_sqrt)                                                    \
  int viete_pow##suffix(const T* in, viete_layout from, double p, T* out, viete_layout to, size_t count) { \
    return sym3::map(in, from, out, to, count,                                                             \
                     [p](const auto& a, const auto& b, std::size_t n) { sym3::pow(a, p, b, n); });         \
  }                                                                                                        \
  int viete_polar##suffix(const T* in, viete_layout from, T* rotations, viete_layout to, T* stretches,     \
                          viete_layout stretch, size_t count) {                                            \
    return sym3::polar_of(in, from, rotations, to, stretches, stretch, count);                             \
  }                                                                                                        \
  int viete_eigh##suffix(const T* in, viete_layout from, T* values, viete_layout value, T* vectors,        \
                         viete_layout vector, size_t count) {                                              \
    return sym3::eigh_of(in, from, values, value, vectors, vector, count);                                 \
  }                                                                                                        \
  int viete_svd##suffix(const T* in, viete_layout from, T* u, viete_layout to_u, T* values,                \
                        viete_layout value, T* v, viete_layout to_v, size_t count) {                       \
    return sym3::svd_of(in, from, u, to_u, values, value, v, to_v, count);                                 \
  }

VIETE_C_PRECISION(double, )
VIETE_C_PRECISION(float, _f)
VIETE_C_DERIVATIVE(viete_exp_derivative, exp_derivative)
VIETE_C_DERIVATIVE(viete_log_derivative, log_derivative)
VIETE_C_DERIVATIVE(viete_sqrt_derivative, sqrt_derivative)

const char* viete_kernel(void) {
  static const std::string name(sym3::kernel_name());
  return name.c_str();
}

#undef VIETE_C_PRECISION
#undef VIETE_C_FUNCTION
#undef VIETE_C_DERIVATIVE
