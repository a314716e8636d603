// Number formats of the panels.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

#include "base/text.h"

namespace viete::ui {

using base::formatted;
using base::milliseconds;
using base::nanoseconds;

/// Beside times that are too long, see workspace::FrameTimes::busy.
inline constexpr std::string_view busy_words = "the computer is busy";

/// For example "50,000".
inline std::string count(std::size_t n) {
  return base::with_thousands(n);
}
/// For example "3.1e-16". Exactly 0 gives "0", NaN gives "NaN".
std::string error(double relative);
/// With one digit, for example "3e-16".
std::string rough_error(double relative);

}  // namespace viete::ui
