// What a benchmark promises: measured, compared with its bar, printed.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace viete::bench {

/// The bars of one run, in the order in which they were checked.
struct Bars {
  nlohmann::json rows = nlohmann::json::array();

  /// Prints a line: at least, or at most, `bar`; met or not.
  void check(const std::string& what, double measured, double bar, bool at_least);
};

}  // namespace viete::bench
