// The report as one HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/figures.h"
#include "bench/table.h"

namespace viete::bench {

/// Returns a paragraph of the class `kind`, or without class if `kind` is empty. paragraph(), html() and
/// figure() return well-formed XML: values are escaped, and elements are closed.
std::string paragraph(std::string_view text, std::string_view kind = "");
/// Returns a table that scrolls on narrow pages.
std::string html(const Table& table);
/// Returns a drawing with a title for screen readers.
std::string figure(std::string_view title, std::string_view svg);

/// A section of the page: text, drawings, numbers, and the commands to repeat the measurement.
struct Section {
  std::string id, origin, title;  ///< `origin`: "Figure 1 of the paper" or "Not in the paper"
  std::string seen;               ///< one or two sentences about the result
  std::string why;
  std::string body;  ///< drawings and tables in HTML
  std::vector<std::string> commands;
};
/// Returns sections for the paper's three figures and claims, then sections for the new figures.
std::vector<Section> sections_of(const Figures& figures);

/// Returns the main results as tiles: values with their descriptions.
std::string summary_of(const Figures& figures);

/// The contents of page.css, which the build embeds in the program.
const char* page_style();

/// The time and the computer of the measurement.
struct Made {
  std::string date, processor;                             ///< `date` is for example "2026-11-26 11:18 UTC"
  std::vector<std::pair<std::string, std::string>> facts;  ///< labels and values in reading order
};
/// Returns the facts about this computer. `command` is the command line of the user.
Made made_here(const std::string& command, double seconds);

nlohmann::json report_json(const Figures& figures, const Made& made);
/// Returns the page as well-formed XML. The tables, plots and texts come from the figures.
std::string report_page(const Figures& figures, const Made& made);

}  // namespace viete::bench
