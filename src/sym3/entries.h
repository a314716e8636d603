// Tests of the entries of one symmetric matrix, and its small algebra. Internal; not for the kernels, which
// share no inline code.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "sym3/sym3.h"

namespace viete::sym3 {

/// False if an entry is NaN or infinite.
template <class T>
bool is_finite(const Sym3<T>& s) {
  return s.xx * 0 + s.xy * 0 + s.xz * 0 + s.yy * 0 + s.yz * 0 + s.zz * 0 == 0;
}

template <class T>
T largest_entry(const Sym3<T>& s) {
  return std::max(
      {std::fabs(s.xx), std::fabs(s.xy), std::fabs(s.xz), std::fabs(s.yy), std::fabs(s.yz), std::fabs(s.zz)});
}

template <class T>
bool is_diagonal(const Sym3<T>& s) {
  return s.xy == 0 && s.xz == 0 && s.yz == 0;
}

template <class T>
Sym3<T> times(const Sym3<T>& s, T x) {
  return {s.xx * x, s.xy * x, s.xz * x, s.yy * x, s.yz * x, s.zz * x};
}

/// S S.
template <class T>
Sym3<T> square(const Sym3<T>& s) {
  return {s.xx * s.xx + s.xy * s.xy + s.xz * s.xz, s.xx * s.xy + s.xy * s.yy + s.xz * s.yz,
          s.xx * s.xz + s.xy * s.yz + s.xz * s.zz, s.xy * s.xy + s.yy * s.yy + s.yz * s.yz,
          s.xy * s.xz + s.yy * s.yz + s.yz * s.zz, s.xz * s.xz + s.yz * s.yz + s.zz * s.zz};
}

/// Where eigenvalues may be past the largest number: functions of S go by those of S / 256.
template <class T>
bool has_huge_eigenvalues(const Sym3<T>& s) {
  return !is_diagonal(s) && largest_entry(s) > std::numeric_limits<T>::max() / 4;
}

/// log(256 S) of log(S).
template <class T>
Sym3<T> log_of_256_times(Sym3<T> log) {
  constexpr T more = T(5.545177444479562475337856971665412545);
  log.xx += more, log.yy += more, log.zz += more;
  return log;
}

/// Six contiguous numbers, and back.
template <class T>
Sym3<double> from_six(const T* in) {
  return {in[0], in[1], in[2], in[3], in[4], in[5]};
}

template <class T>
void to_six(const Sym3<double>& s, T* out) {
  out[0] = T(s.xx), out[1] = T(s.xy), out[2] = T(s.xz), out[3] = T(s.yy), out[4] = T(s.yz), out[5] = T(s.zz);
}

template <class T>
Sym3<T> nan_matrix() {
  constexpr T nan = std::numeric_limits<T>::quiet_NaN();
  return {nan, nan, nan, nan, nan, nan};
}

}  // namespace viete::sym3
