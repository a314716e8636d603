// Arithmetic with about 106 bits on sums of two doubles (Dekker 1971; Knuth, TAOCP 2, 4.2.2). Internal.
#pragma once

#include <cmath>

#include "sym3/sym3.h"

namespace viete::sym3 {

/// Returns exactly a + b. Requires |a| >= |b| or a = 0.
inline DoubleDouble quick_two_sum(double a, double b) {
  const double sum = a + b;
  return {sum, b - (sum - a)};
}

/// Returns exactly a + b.
inline DoubleDouble two_sum(double a, double b) {
  const double sum = a + b, part = sum - a;
  return {sum, (a - (sum - part)) + (b - part)};
}

/// Splits `a` into two parts of at most 26 bits (Veltkamp). |a| must be below 2^996.
inline DoubleDouble halves(double a) {
  const double shifted = a * 0x1.0000002p27, hi = shifted - (shifted - a);
  return {hi, a - hi};
}

/// Returns the exact product a * b. Overflow and underflow are not handled.
inline DoubleDouble two_product(double a, double b) {
  const double product = a * b;
  const DoubleDouble x = halves(a), y = halves(b);
  return {product, ((x.hi * y.hi - product) + x.hi * y.lo + x.lo * y.hi) + x.lo * y.lo};
}

inline DoubleDouble operator-(const DoubleDouble& a) {
  return {-a.hi, -a.lo};
}

inline DoubleDouble operator+(const DoubleDouble& a, const DoubleDouble& b) {
  DoubleDouble high = two_sum(a.hi, b.hi);
  const DoubleDouble low = two_sum(a.lo, b.lo);
  high = quick_two_sum(high.hi, high.lo + low.hi);
  return quick_two_sum(high.hi, high.lo + low.lo);
}

inline DoubleDouble operator-(const DoubleDouble& a, const DoubleDouble& b) {
  return a + -b;
}

inline DoubleDouble operator*(const DoubleDouble& a, const DoubleDouble& b) {
  const DoubleDouble product = two_product(a.hi, b.hi);
  return quick_two_sum(product.hi, product.lo + (a.hi * b.lo + a.lo * b.hi));
}

inline DoubleDouble operator/(const DoubleDouble& a, const DoubleDouble& b) {
  const double first = a.hi / b.hi;
  const DoubleDouble rest = a - b * DoubleDouble{first, 0};
  const double second = rest.hi / b.hi;
  const DoubleDouble rest2 = rest - b * DoubleDouble{second, 0};
  return quick_two_sum(first, second) + DoubleDouble{rest2.hi / b.hi, 0};
}

/// Returns the root: std::sqrt, improved by one step of Newton's method (Karp and Markstein 1997).
inline DoubleDouble sqrt(const DoubleDouble& a) {
  if (a.hi == 0) return {};
  const double root = std::sqrt(a.hi);
  const DoubleDouble rest = a - two_product(root, root);
  return quick_two_sum(root, rest.hi / (2 * root));
}

inline DoubleDouble scaled(const DoubleDouble& a, double power_of_two) {
  return {a.hi * power_of_two, a.lo * power_of_two};
}

}  // namespace viete::sym3
