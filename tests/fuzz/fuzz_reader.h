// Reads an input with a reader. The result must be a valid surface or base::Error.
#pragma once

#include <cstddef>
#include <cstdint>

#include "formats/codecs.h"

namespace viete::fuzz {

using Reader = formats::ReadResult(const formats::Source&);

/// Aborts unless the reader throws base::Error or returns a valid surface of at most `size + placed`
/// vertices.
void check_reader(Reader* reader, std::size_t placed, const std::uint8_t* data, std::size_t size);

}  // namespace viete::fuzz
