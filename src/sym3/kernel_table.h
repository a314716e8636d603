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

/// The polar decomposition. `one` writes nine numbers of the rotation, then six numbers of the stretch.
template <class T>
struct PolarFunction {
  void (*one)(const T* in, T* out);
  void (*many)(const View<const T, 9>& in, const View<T, 9>& rotations, const View<T, 6>& stretches,
               const Range& range);
};

/// Eigenvectors. `one` writes three eigenvalues, then nine numbers of the eigenvectors.
template <class T>
struct EighFunction {
  void (*one)(const T* in, T* out);
  void (*many)(const View<const T, 6>& in, const View<T, 3>& values, const View<T, 9>& vectors,
               const Range& range);
};

/// Singular value decompositions. `one` writes nine numbers of U, three singular values, then nine numbers of
/// V.
template <class T>
struct SvdFunction {
  void (*one)(const T* in, T* out);
  void (*many)(const View<const T, 9>& in, const View<T, 9>& u, const View<T, 3>& values, const View<T, 9>& v,
               const Range& range);
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
  const PolarFunction<T>* polar;
  const EighFunction<T>* eigh;
  const SvdFunction<T>* svd;
  const DerivativeFunction<T>* derivative;
  const Function<T, 6, 36, Of, double>* tangent;
};

struct KernelTable {
  KernelFunctions<double> in_double;
  KernelFunctions<float> in_float;
};

}  // namespace viete::sym3
