// viete bench sym3: what the exponential core promises of speed and error, measured, each promise one line.
#pragma once

#include <cstddef>
#include <filesystem>

namespace viete::bench {

/// Prints the tables. `count`: matrices of the runs from memory, 0 for 10,000,000. Throws base::Error.
void bench_sym3(std::size_t count, const std::filesystem::path& json);

}  // namespace viete::bench
