// The checks of the fuzzer. Each reads an input, and aborts if the result is wrong.
#pragma once

#include <cstdlib>
#include <string_view>

#include "formats/codecs.h"

namespace viete::fuzz {

using Reader = formats::ReadResult(const formats::Source&);

inline void require(bool condition) {
  if (!condition) std::abort();
}

/// The result must be base::Error or a valid surface of at most `bytes.size() + placed` vertices.
void check_reader(Reader* reader, std::size_t placed, std::string_view bytes);

/// The result must be a complete picture or base::Error.
void check_picture(std::string_view bytes);

}  // namespace viete::fuzz
