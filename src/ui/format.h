// Number formats of the panels.
#pragma once

#include <cstddef>
#include <string>

#include "base/text.h"

namespace viete::ui {

using base::milliseconds;
using base::nanoseconds;

/// "50,000".
inline std::string count(std::size_t n) {
  return base::with_thousands(n);
}
/// "3.1e-16"; "0" for exactly 0; "NaN" for NaN.
std::string error(double relative);
/// With one digit: "3e-16".
std::string rough_error(double relative);
/// Three significant digits: "0.123", "12.3", "1.23e+07".
std::string length(double value);
/// "124 x".
std::string ratio(double value);

}  // namespace viete::ui
