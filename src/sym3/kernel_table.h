// The functions that are compiled for each instruction set. This header must not have inline functions, see
// fallback.h. Internal.
#pragma once

#include <cstddef>

#include "sym3/fallback.h"

namespace viete::sym3 {

template <class T, int N>
struct View;

/// Items [begin, end) of a batch; begin is a multiple of 64.
struct Range {
  std::size_t begin, end;
  bool stream;  ///< true for non-temporal stores
};

/// A function from N numbers to M numbers. `More` are types of further parameters, such as an exponent.
template <class T, int N, int M, class... More>
struct Function {
  void (*one)(const T* in, T* out, More... more);
  void (*many)(const View<const T, N>& in, const View<T, M>& out, More... more, const Range& range);
};

/// A decomposition of N numbers, with M numbers in each part. `one` writes the parts one after the other.
template <class T, int N, int... M>
struct Decomposition {
  void (*one)(const T* in, T* out);
  void (*many)(const View<const T, N>& in, const View<T, M>&... parts, const Range& range);
};

/// A derivative at S in one direction or in n directions. p is the exponent of pow.
template <class T>
struct DerivativeFunction {
  void (*one)(const T* s, const T* direction, T* out, Of f, double p);
  void (*many)(const View<const T, 6>& s, const View<const T, 6>* directions, const View<T, 6>* out,
               std::size_t n, Of f, double p, const Range& range);
};

template <class T>
struct KernelFunctions {
  const Function<T, 6, 6>*exp, *log, *sqrt, *inv_sqrt;
  const Function<T, 6, 6, double>* pow;
  const Function<T, 6, 3>* eigenvalues;
  const Function<T, 3, 9>* exp_rotation;
  const Function<T, 9, 3>* log_rotation;
  const Function<T, 9, 9>* rotation_of;
  const Decomposition<T, 9, 9, 6>* polar;   ///< rotation and stretch
  const Decomposition<T, 6, 3, 9>* eigh;    ///< eigenvalues and eigenvectors
  const Decomposition<T, 9, 9, 3, 9>* svd;  ///< U, singular values and V
  const DerivativeFunction<T>* derivative;
  const Function<T, 6, 36, Of, double>* tangent;
};

struct KernelTable {
  KernelFunctions<double> in_double;
  KernelFunctions<float> in_float;
};

}  // namespace viete::sym3
