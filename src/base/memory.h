// How much memory is left, and what is said where that is not enough.
#pragma once

#include <optional>
#include <string>

namespace viete::base {

/// Bytes that the system can give without swapping; nothing where it does not say. Thread-safe.
std::optional<double> free_memory();

/// What memory is wanted for, as base::Error says it.
struct MemoryNeed {
  double bytes;
  std::string taker;   ///< "1000 matrices take"
  std::string advice;  ///< "give a smaller number"
  std::string place;
};

/// Throws base::Error when more than nine tenths of the memory that is free are needed. Passes where the
/// system does not say how much that is. Thread-safe.
void require_memory(const MemoryNeed& need);

/// The same error, when memory has run out.
[[noreturn]] void refuse_memory(const MemoryNeed& need);

}  // namespace viete::base
