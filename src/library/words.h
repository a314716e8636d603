// Words and numbers that callers give, checked.
#pragma once

#include <cstdio>
#include <limits>
#include <span>
#include <string>

#include "base/error.h"

namespace viete::library {

/// "0.0015", "20000".
inline std::string plain(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

/// What a table has of that name. Throws base::Error that names `what` and the names that there are.
template <class Entry>
auto named(std::span<const Entry> table, const std::string& name, const char* what) {
  std::string names;
  for (const Entry& entry : table) {
    if (entry.name == name) return entry.value;
    names += (names.empty() ? "" : ", ") + std::string(entry.name);
  }
  throw base::Error(what, "there is none called " + name, "choose one of " + names);
}

/// Throws base::Error with the range.
inline void check_range(const char* what, double value, double low, double high) {
  if (value >= low && value <= high) return;
  const std::string range = high < std::numeric_limits<double>::infinity() ? plain(low) + " to " + plain(high)
                                                                           : plain(low) + " or more";
  throw base::Error(what, plain(value) + " is out of range", "choose " + range);
}

/// Options of the command line as words: "--mean-value" is mean_value.
std::string without_dashes(const std::string& sentence);

/// What words there are for ways, elements, weights and blends, and for falloffs: "\n  'smooth': Spreads
/// ...".
std::string ways_text();
std::string choices_text();
std::string falloffs_text();

/// 0 for all processors.
inline int checked_threads(int threads) {
  check_range("threads", threads, 0, 1024);
  return threads;
}

}  // namespace viete::library
