// Text and numbers for messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace viete::base {

/// The text in a form that is safe to print on one line. Control characters become visible ("\x1B", "\n"), so
/// that text of a file cannot control a terminal. If the text is longer than `most` bytes, "..." replaces the
/// middle.
std::string printable(std::string_view text, std::size_t most = 2000);

/// For example "50,000".
std::string with_thousands(std::size_t n);
/// For example "1 face" or "3 faces".
std::string counted(std::size_t count, const std::string& noun);
/// For example "88 MB" or "1.2 GB". At least "1 MB"; a megabyte has a million bytes.
std::string memory_size(double bytes);
/// Two decimals below 10, one below 100, otherwise none: "0.42", "12.3", "4567".
std::string few_digits(double value);
/// For example "0.42 ms", "12.3 ms" or "1.20 s".
std::string milliseconds(double ms);
/// For example "3.21 ns", "124 ns" or "1.50 us".
std::string nanoseconds(double ns);

}  // namespace viete::base
