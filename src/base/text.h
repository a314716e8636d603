// Text and numbers for messages: printable text of files, quantities with units.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viete::base {

/// The text in a form that is safe to show or print on one line: control characters become visible ("\x1B",
/// "\n"), so that file contents cannot move a terminal's cursor or start a line; text longer than `most`
/// bytes has its middle replaced by "...". UTF-8 characters stay whole.
std::string printable(std::string_view text, std::size_t most = 2000);

/// "50,000".
std::string with_thousands(std::size_t n);
/// "1 face", "3 faces".
std::string counted(std::size_t count, const std::string& noun);
/// "88 MB", "1.2 GB": powers of a thousand, at least 1 MB.
std::string memory_size(double bytes);
/// Two decimals under 10, three significant digits up to 1000, no decimals above: "0.42", "12.3", "4567".
std::string few_digits(double value);
/// "0.42 ms", "12.3 ms", "1.20 s".
std::string milliseconds(double ms);
/// "3.21 ns", "124 ns", "1.50 us".
std::string nanoseconds(double ns);

}  // namespace viete::base
