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

/// Elements of a page that is also XML: every value escaped, every element closed. A paragraph of this class,
/// or without one if it is empty; a table, which scrolls on narrow pages; a drawing with its title, which is
/// also its accessible name.
std::string paragraph(std::string_view text, std::string_view kind = "");
std::string html(const Table& table);
std::string figure(std::string_view title, std::string_view svg);

/// A section of the page: text, drawings, numbers and the commands that repeat them.
struct Section {
  std::string id, origin, title;  ///< origin: the source of the figure
  std::string seen;               ///< one or two sentences on the result
  std::string why;
  std::string body;  ///< HTML: drawings and tables
  std::vector<std::string> commands;
};
/// The paper's three figures and its claims, then ours.
std::vector<Section> sections_of(const Figures& figures);

/// The main results as tiles: values with their descriptions.
std::string summary_of(const Figures& figures);

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
