// Reads one input with one reader: the result must be a valid surface or base::Error.
#pragma once

#include <cstddef>
#include <cstdint>

#include "formats/codecs.h"

namespace viete::fuzz {

using Reader = formats::ReadResult(const formats::Source&);

/// Aborts if the result is neither. `placed`: the most vertices beyond those that the file's bytes can hold.
void check_reader(Reader* reader, std::size_t placed, const std::uint8_t* data, std::size_t size);

}  // namespace viete::fuzz
