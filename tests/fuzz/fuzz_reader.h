// Reads an input with a reader. The result must be a valid surface or base::Error.
#pragma once

#include <cstddef>
#include <cstdint>

#include "formats/codecs.h"

namespace viete::fuzz {

using Reader = formats::ReadResult(const formats::Source&);

/// If the result is neither, aborts. The surface may have `placed` vertices more than the file has bytes.
void check_reader(Reader* reader, std::size_t placed, const std::uint8_t* data, std::size_t size);

}  // namespace viete::fuzz
