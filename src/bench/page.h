// The report as one page of HTML that needs nothing else: no script, no file, no network.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/figures.h"
#include "bench/made.h"

namespace viete::bench {

/// What page and file have as raw numbers.
nlohmann::json report_json(const Figures& figures, const Made& made);
/// CSS: how the page looks on a screen by day and by night, on a phone, on paper.
std::string page_style();
/// Well-formed as XML. Its tables and plots are of the figures, and so are its sentences.
std::string report_page(const Figures& figures, const Made& made);

}  // namespace viete::bench
