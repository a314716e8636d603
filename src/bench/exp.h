// The times of exp as text, numbers and a picture.
#pragma once

#include <nlohmann/json.hpp>

#include "bench/plot.h"
#include "bench/timing/exp.h"

namespace viete::bench {

/// "planes".
const char* layout_name(sym3::Layout layout);

void print(const ExpBench& bench);
nlohmann::json to_json(const ExpBench& bench);
Plot plot_of(const ExpBench& bench);

}  // namespace viete::bench
