// The functions that every instruction set compiles. Internal; no inline functions here (exp_by_jacobi.h).
#pragma once

#include <cstddef>

namespace viete::sym3 {

template <class T, int N>
struct View;

/// Items [begin, end) of a batch; begin is a multiple of 64.
struct Range {
  std::size_t begin, end;
  bool stream;  ///< with non-temporal stores
};

/// From N numbers to M.
template <class T, int N, int M>
struct Function {
  void (*one)(const T* in, T* out);
  void (*many)(const View<const T, N>& in, const View<T, M>& out, const Range& range);
};

/// In both precisions.
template <int N, int M>
struct Functions {
  const Function<double, N, M>* in_double;
  const Function<float, N, M>* in_float;
};

/// S^exponent.
struct PowFunctions {
  void (*in_double)(const View<const double, 6>& in, const View<double, 6>& out, const Range& range,
                    double exponent);
  void (*in_float)(const View<const float, 6>& in, const View<float, 6>& out, const Range& range,
                   double exponent);
};

/// Rotations and stretches. `one` writes nine numbers and six behind them.
template <class T>
struct PolarFunction {
  void (*one)(const T* in, T* out);
  void (*many)(const View<const T, 9>& in, const View<T, 9>& rotations, const View<T, 6>& stretches,
               const Range& range);
};

struct PolarFunctions {
  PolarFunction<double> in_double;
  PolarFunction<float> in_float;
};

struct KernelTable {
  Functions<6, 6> exp, log, sqrt, inv_sqrt;
  Functions<6, 3> eigenvalues;
  Functions<3, 9> exp_rotation;
  Functions<9, 3> log_rotation;
  Functions<9, 9> rotation_of;
  const PowFunctions* pow;
  const PolarFunctions* polar;
};

}  // namespace viete::sym3
