// The report as one HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/figures.h"

namespace viete::bench {

/// When and where the figures were measured.
struct Made {
  std::string date, processor;  ///< "2026-11-26 11:18 UTC"; with its number of threads
  std::vector<std::pair<std::string, std::string>> facts;  ///< with their labels, in reading order
};
/// On this machine, by this command, as typed.
Made made_here(const std::string& command, double seconds);

/// The raw numbers of the page and of report.json.
nlohmann::json report_json(const Figures& figures, const Made& made);
/// Well-formed XML. Tables, plots and text are derived from the figures.
std::string report_page(const Figures& figures, const Made& made);

}  // namespace viete::bench
