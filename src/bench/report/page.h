// The report as one page of HTML that needs nothing else: no script, no file, no network.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "bench/report/figures.h"
#include "bench/report/made.h"

namespace viete::bench {

/// What page and file have as raw numbers.
nlohmann::json report_json(const Figures& figures, const Made& made);
/// Well-formed as XML. Its tables and plots are of the figures, and so are its sentences.
std::string report_page(const Figures& figures, const Made& made);

}  // namespace viete::bench
