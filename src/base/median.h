// The median of numbers.
#pragma once

#include <algorithm>
#include <vector>

namespace viete::base {

/// Returns the median. If the number of values is even, returns the larger of the two middle values. `values`
/// must not be empty or contain NaN.
inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace viete::base
