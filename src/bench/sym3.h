// viete bench sym3: measures speed and error of the exponential core, one line per documented limit.
#pragma once

#include <cstddef>
#include <filesystem>

namespace viete::bench {

/// Prints the tables. `count`: number of matrices for runs from memory, 0 for 10,000,000. Throws base::Error.
void bench_sym3(std::size_t count, const std::filesystem::path& json);

}  // namespace viete::bench
