// The report as one HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/figures.h"

namespace viete::bench {

struct Made {
  std::string command;    ///< as typed
  std::string date;       ///< "2026-11-26 11:18 UTC"
  std::string program;    ///< version, build, compiler
  std::string kernel;     ///< kernel of the vector code
  std::string processor;  ///< with its number of threads
  std::string memory, system;
  double seconds = 0;  ///< duration
};

/// The facts about this machine and run.
Made made_here(std::string command, double seconds);

/// The facts with their labels, in reading order.
std::vector<std::pair<std::string, std::string>> facts_of(const Made& made);
nlohmann::json to_json(const Made& made);

/// The raw numbers of the page and of report.json.
nlohmann::json report_json(const Figures& figures, const Made& made);
/// CSS for screens in light and dark themes, for phones, and for print.
std::string page_style();
/// Well-formed XML. Tables, plots and text are derived from the figures.
std::string report_page(const Figures& figures, const Made& made);

}  // namespace viete::bench
