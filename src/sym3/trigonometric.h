// The trigonometric roots of the characteristic polynomial (paper, section 3). Internal.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "sym3/sym3.h"

namespace viete::sym3 {

/// det(x I - S) = (x - shift)^3 + p (x - shift) + q, p <= 0 up to rounding.
template <class T>
struct DepressedCubic {
  T p, q, shift;
};

/// From the coefficients of x^3 + a x^2 + b x + c, as the paper does; p and q cancel when the roots are
/// close.
template <class T>
DepressedCubic<T> depressed_cubic(const Sym3<T>& s) {
  const T a = -(s.xx + s.yy + s.zz);
  const T b = s.xx * s.yy + s.yy * s.zz + s.zz * s.xx - s.xy * s.xy - s.yz * s.yz - s.xz * s.xz;
  const T c = s.xx * s.yz * s.yz + s.yy * s.xz * s.xz + s.zz * s.xy * s.xy - s.xx * s.yy * s.zz -
              2 * s.xy * s.yz * s.xz;
  return {b - a * a / 3, c + 2 * a * a * a / 27 - a * b / 3, -a / 3};
}

/// t cos((acos k + 2 pi i) / 3) + shift: the largest root, the smallest, the middle one.
template <class T>
std::array<T, 3> viete_cosines(T t, T k, T shift) {
  constexpr T third_turn = 2 * std::numbers::pi_v<T> / 3;
  const T angle = std::acos(k) / 3;
  return {t * std::cos(angle) + shift, t * std::cos(angle + third_turn) + shift,
          t * std::cos(angle + 2 * third_turn) + shift};
}

/// r = sqrt(-12 p), k = -108 q / r^3 (the appendix misprints it as -4 q / p^3), t = r / 3. NaN if rounding
/// makes p positive or |k| > 1, or if r = 0.
template <class T>
std::array<T, 3> viete_roots_as_printed(const DepressedCubic<T>& f) {
  const T r = std::sqrt(-12 * f.p);
  return viete_cosines(r / 3, -108 * f.q / (r * r * r), f.shift);
}

/// The same, with k clamped to [-1, 1], and a triple root unless r^3 is positive.
template <class T>
std::array<T, 3> viete_roots(const DepressedCubic<T>& f) {
  const T r = std::sqrt(std::max(-12 * f.p, T(0)));
  const T r3 = r * r * r;
  if (!(r3 > 0)) return {f.shift, f.shift, f.shift};
  return viete_cosines(r / 3, std::clamp(-108 * f.q / r3, T(-1), T(1)), f.shift);
}

}  // namespace viete::sym3
