// The median of numbers.
#pragma once

#include <algorithm>
#include <vector>

namespace viete::base {

/// For an even number of values, the larger of the two in the middle. `values` must not be empty or contain
/// NaN.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace viete::base
