// Whether a binding fits the memory that is free.
#pragma once

#include <cstddef>

namespace viete::deform {

/// Throws base::Error with numbers and advice when `bytes` are more than nine tenths of what the system can
/// give without swapping. Passes where the system does not say.
void require_memory(double bytes, std::size_t vertices, std::size_t handles);

/// The same error, when memory has run out.
[[noreturn]] void refuse_memory(double bytes, std::size_t vertices, std::size_t handles);

}  // namespace viete::deform
