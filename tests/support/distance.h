// The largest difference between two lists of numbers or points.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "base/vector.h"

namespace viete::test {

/// Returns the largest distance: NaN if a number is NaN, and infinity if the sizes differ.
inline double largest_distance(std::span<const base::Vec3> a, std::span<const base::Vec3> b) {
  double largest = a.size() == b.size() ? 0 : HUGE_VAL;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
    const double d = norm(a[i] - b[i]);
    largest = d <= largest ? largest : d;
  }
  return largest;
}

/// Returns the largest difference. If a number is NaN, the result is NaN. The sizes must be equal.
inline double largest_difference(std::span<const double> a, std::span<const double> b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double d = std::abs(a[i] - b[i]);
    largest = d <= largest ? largest : d;
  }
  return largest;
}

}  // namespace viete::test
