#include "sym3/derivative.h"

#include <cassert>
#include <type_traits>

#include "sym3/call_kernel.h"

namespace viete::sym3 {

namespace {

// The kernels write a Tangent as 36 contiguous numbers.
static_assert(sizeof(Tangent<double>) == 36 * sizeof(double) && sizeof(Tangent<float>) == 36 * sizeof(float));
static_assert(std::is_standard_layout_v<Tangent<double>> && std::is_standard_layout_v<Tangent<float>>);

template <class T>
Sym3<T> one_derivative(Of f, double p, const Sym3<T>& s, const Sym3<T>& direction) {
  Sym3<T> out;
  functions<T>(kernel()).derivative->one(&s.xx, &direction.xx, &out.xx, f, p);
  return out;
}

template <class T>
void many_derivatives(Of f, double p, const SymView<const T>& s, Directions<T> directions, Derivatives<T> out,
                      std::size_t count, const Batch& batch) {
  assert(directions.size() == out.size());
  const auto many = functions<T>(kernel_of(batch)).derivative->many;
  const auto call = [&](const Range& range) {
    many(s, directions.data(), out.data(), out.size(), f, p, range);
  };
  run_batch(task_of(call), count, 0, true, batch);
}

}  // namespace

// `p` is the exponent, or 0. For functions with an exponent, the last argument declares this parameter.
#define VIETE_FOR(T, name, p, ...)                                                                       \
  template Sym3<T> name##_derivative(const Sym3<T>& __VA_OPT__(, ) __VA_ARGS__, const Sym3<T>&);         \
  template Tangent<T> name##_tangent(const Sym3<T>& __VA_OPT__(, ) __VA_ARGS__);                         \
  void name##_derivative(const SymView<const T>& s __VA_OPT__(, ) __VA_ARGS__, Directions<T> directions, \
                         Derivatives<T> out, std::size_t count, const Batch& batch) {                    \
    many_derivatives(Of::name, p, s, directions, out, count, batch);                                     \
  }                                                                                                      \
  void name##_tangent(const SymView<const T>& s __VA_OPT__(, ) __VA_ARGS__, const TangentView<T>& out,   \
                      std::size_t count, const Batch& batch) {                                           \
    call_many(&KernelFunctions<T>::tangent, s, out, count, batch, Of::name, double(p));                  \
  }
#define VIETE_DERIVATIVE(name, p, ...)                                                               \
  template <class T>                                                                                 \
  Sym3<T> name##_derivative(const Sym3<T>& s __VA_OPT__(, ) __VA_ARGS__, const Sym3<T>& direction) { \
    return one_derivative(Of::name, p, s, direction);                                                \
  }                                                                                                  \
  template <class T>                                                                                 \
  Tangent<T> name##_tangent(const Sym3<T>& s __VA_OPT__(, ) __VA_ARGS__) {                           \
    return call_one<Tangent<T>>(&KernelFunctions<T>::tangent, &s.xx, Of::name, double(p));           \
  }                                                                                                  \
  VIETE_FOR(float, name, p __VA_OPT__(, ) __VA_ARGS__)                                               \
  VIETE_FOR(double, name, p __VA_OPT__(, ) __VA_ARGS__)
VIETE_DERIVATIVE(exp, 0)
VIETE_DERIVATIVE(log, 0)
VIETE_DERIVATIVE(sqrt, 0)
VIETE_DERIVATIVE(pow, p, double p)
#undef VIETE_DERIVATIVE
#undef VIETE_FOR

}  // namespace viete::sym3
