// Numbers as people read them: few digits, a unit, no dancing.
#pragma once

#include <cstddef>
#include <string>

namespace viete::ui {

/// "0.42 ms", "12.3 ms", "1.20 s": two decimals under 10 ms, three significant digits above.
std::string milliseconds(double ms);
/// "3.21 ns", "124 ns", "1.50 us".
std::string nanoseconds(double ns);
/// "50,000".
std::string count(std::size_t n);
/// "3.1e-16"; "0" for exactly 0; "NaN" for NaN.
std::string error(double relative);
/// Three significant digits: "0.123", "12.3", "1.23e+07".
std::string length(double value);
/// "124 x".
std::string ratio(double value);

}  // namespace viete::ui
