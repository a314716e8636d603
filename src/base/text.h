// Text and numbers for messages.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

// MinGW has two functions printf(); its headers name the one that they call.
#ifdef __MINGW_PRINTF_FORMAT
#define VIETE_PRINTF __MINGW_PRINTF_FORMAT
#else
#define VIETE_PRINTF printf
#endif

namespace viete::base {

/// Returns the text in a form that is safe to print on one line. Control characters become visible ("\x1B",
/// "\n"), so that text from a file cannot control a terminal. If the text has more than `most` bytes, "..."
/// replaces its middle.
std::string printable(std::string_view text, std::size_t most = 2000);

/// Returns the first bytes of the text, at most `most`, without splitting a UTF-8 character.
std::string cut(std::string_view text, std::size_t most);

/// Formats as printf() does. The result has at most 511 bytes.
[[gnu::format(VIETE_PRINTF, 1, 2)]] std::string formatted(const char* format, ...);
/// Returns text such as "50,000".
std::string with_thousands(std::size_t n);
/// Returns text such as "1 face" or "3 faces".
std::string counted(std::size_t count, const std::string& noun);
/// Returns the texts with separators. After `most` texts, ends with " ...".
std::string joined(std::span<const std::string> texts, std::string_view separator = ", ",
                   std::size_t most = std::string_view::npos);

/// Returns the text with its first letter in upper case.
std::string capitalised(std::string text);

/// Returns a list such as "a", "a or b" or "a, b or c". `last` precedes the last text.
std::string listed(std::span<const std::string> texts, std::string_view last = " or ");

/// Returns text such as "88 MB" or "1.2 GB"; at least "1 MB". A megabyte is a million bytes.
std::string memory_size(double bytes);
/// Writes two decimals below 10, one below 100, and no decimals from 100: "0.42", "12.3", "4567".
std::string few_digits(double value);
/// Returns text such as "0.42 ms", "12.3 ms" or "1.20 s".
std::string milliseconds(double ms);
/// Returns text such as "3.21 ns", "124 ns" or "1.50 us".
std::string nanoseconds(double ns);

}  // namespace viete::base
