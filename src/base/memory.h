// How much memory is left.
#pragma once

#include <optional>

namespace viete::base {

/// Bytes that the system can give without swapping; nothing where it does not say. Thread-safe.
std::optional<double> free_memory();

}  // namespace viete::base
