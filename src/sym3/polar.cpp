#include "sym3/polar.h"

#include <type_traits>

#include "sym3/call_kernel.h"

namespace viete::sym3 {

// The kernels write a Polar as fifteen contiguous numbers.
static_assert(sizeof(Polar<double>) == 15 * sizeof(double) && sizeof(Polar<float>) == 15 * sizeof(float));
static_assert(std::is_standard_layout_v<Polar<double>> && std::is_standard_layout_v<Polar<float>>);

template <class T>
Polar<T> polar(const Mat3<T>& m) {
  return call_one<Polar<T>>(&KernelFunctions<T>::polar, m.data());
}

#define VIETE_FOR(T)                                                                               \
  template Polar<T> polar(const Mat3<T>&);                                                         \
  void polar(const MatView<const T>& in, const MatView<T>& rotations, std::size_t count,           \
             const Batch& batch) {                                                                 \
    call_many(&KernelFunctions<T>::rotation_of, in, rotations, count, batch);                      \
  }                                                                                                \
  void polar(const MatView<const T>& in, const MatView<T>& rotations, const SymView<T>& stretches, \
             std::size_t count, const Batch& batch) {                                              \
    call_many(&KernelFunctions<T>::polar, in, rotations, count, batch, stretches);                 \
  }
VIETE_FOR(float)
VIETE_FOR(double)
#undef VIETE_FOR

}  // namespace viete::sym3
