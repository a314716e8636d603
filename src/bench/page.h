// The report as one HTML page.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/figures.h"

namespace viete::bench {

/// <p class="...">, a paragraph of text; no class where that is empty.
std::string paragraph(std::string_view text, std::string_view kind = "");

/// A command that is typed.
std::string command_line(std::string_view command);

/// The first column is of names; the others are of numbers and stand to the right, but for those that are
/// called by `words`. Scrolls by itself where the page is narrow.
struct HtmlTable {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;
  std::vector<std::string> words = {};
};
std::string html(const HtmlTable& table);

/// A drawing with its title, which it is also read out by.
std::string figure(std::string_view title, std::string_view svg);

struct Made {
  std::string command;    ///< as it was typed
  std::string date;       ///< "2026-11-26 11:18 UTC"
  std::string program;    ///< version, build, compiler
  std::string kernel;     ///< of the vector code
  std::string processor;  ///< with the number of its threads
  std::string memory, system;
  double seconds = 0;  ///< that it took
};

/// Of this machine, now.
Made made_here(std::string command, double seconds);

/// Each with what it is called, in the order of reading.
std::vector<std::pair<std::string, std::string>> facts_of(const Made& made);
nlohmann::json to_json(const Made& made);

/// What page and file have as raw numbers.
nlohmann::json report_json(const Figures& figures, const Made& made);
/// CSS: how the page looks on a screen by day and by night, on a phone, on paper.
std::string page_style();
/// Well-formed as XML. Its tables and plots are of the figures, and so are its sentences.
std::string report_page(const Figures& figures, const Made& made);

}  // namespace viete::bench
