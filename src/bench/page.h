// The report as one HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/figures.h"

namespace viete::bench {

/// A paragraph of text, <p class="...">; without a class if `kind` is empty.
std::string paragraph(std::string_view text, std::string_view kind = "");

/// A command line to copy.
std::string command_line(std::string_view command);

/// The first column has names; the others have numbers and are right-aligned, except columns listed in
/// `words`. Scrolls horizontally on narrow pages.
struct HtmlTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> words = {};
};
std::string html(const HtmlTable& table);

/// A drawing with its title, which is also its accessible name.
std::string figure(std::string_view title, std::string_view svg);

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
