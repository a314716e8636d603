// Runs one named kernel, whatever this machine would choose.
#pragma once

#include <vector>

#include "sym3/kernel.h"
#include "sym3/sym3.h"

namespace viete::test {

inline void run(const sym3::Kernel& kernel, const double* in, double* out, std::size_t count) {
  kernel.exp_double(in, out, count);
}

inline void run(const sym3::Kernel& kernel, const float* in, float* out, std::size_t count) {
  kernel.exp_float(in, out, count);
}

template <class T>
sym3::Sym3<T> exp_with(const sym3::Kernel& kernel, const sym3::Sym3<T>& s) {
  const T in[6] = {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
  T out[6];
  run(kernel, in, out, 1);
  return {out[0], out[1], out[2], out[3], out[4], out[5]};
}

inline bool is_fused(const sym3::Kernel& kernel) {
  return kernel.name == "fma";
}

}  // namespace viete::test
