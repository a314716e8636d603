// Numbers in sentences: counts and sizes of memory.
#pragma once

#include <cstddef>
#include <string>

namespace viete::scene {

/// "50,000".
std::string with_thousands(std::size_t n);
/// "88 MB", "1.2 GB": powers of a thousand, at least 1 MB.
std::string memory_size(std::size_t bytes);

}  // namespace viete::scene
