// Text and numbers for messages: printable text of files, quantities with units.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viete::base {

/// The text as it may stand in a line that is shown or printed, whatever it holds: control characters become
/// visible ("\x1B", "\n"), so that no file moves the cursor of a terminal or begins a line; of more than
/// `most` bytes the middle gives way to "...". Letters of UTF-8 stay whole.
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
