// Numbers as panels show them.
#pragma once

#include <cstddef>
#include <string>

#include "base/quantity.h"
#include "scene/document/length_unit.h"

namespace viete::ui {

using base::milliseconds;
using base::nanoseconds;

/// "50,000".
inline std::string count(std::size_t n) {
  return base::with_thousands(n);
}
/// "3.1e-16"; "0" for exactly 0; "NaN" for NaN.
std::string error(double relative);
/// The same with one digit: "3e-16".
std::string rough_error(double relative);
/// Three significant digits: "0.123", "12.3", "1.23e+07".
std::string length(double value);
/// Six digits, and the unit: "12.4 cm" with a small 2 for power 2.
std::string measured(double value, scene::LengthUnit unit, int power = 1);
/// "124 x".
std::string ratio(double value);

}  // namespace viete::ui
