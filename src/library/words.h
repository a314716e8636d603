// Checks of names and numbers passed by callers.
#pragma once

#include <cstdio>
#include <limits>
#include <span>
#include <string>

#include "base/error.h"

namespace viete::library {

/// Formats a number briefly: "0.0015", "20000".
inline std::string plain(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// The value of that name in the table. Throws base::Error for `what` that lists the valid names.
template <class Entry>
auto named(std::span<const Entry> table, const std::string& name, const char* what) {
  std::string names;
  for (const Entry& entry : table) {
    if (entry.name == name) return entry.value;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw base::Error(what, "unknown name " + name, "choose one of " + names);
}

/// Throws base::Error that names the valid range.
inline void check_range(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return;
  const std::string range = high < std::numeric_limits<double>::infinity() ? plain(low) + " to " + plain(high)
                                                                           : plain(low) + " or more";
  throw base::Error(what, plain(value) + " is out of range", "choose " + range);
}

/// Replaces command-line options by parameter names: "--mean-value" becomes mean_value.
std::string without_dashes(const std::string& sentence);

/// Lists names with their descriptions, for docstrings: "\n  'smooth': Spreads ...".
std::string ways_text();
std::string choices_text();
std::string falloffs_text();

/// 0 for all processors.
inline int checked_threads(int threads) {
  check_range("threads", threads, 0, 1024);
  return threads;
}

}  // namespace viete::library
