// Reads an input as a picture. The result must be a complete picture or base::Error. This file compiles its
// own copy of the stb decoder, so that sanitizers check the decoder.
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

#include <cstdint>
#include <cstdlib>
#include <string_view>

#include "base/error.h"
#include "base/picture.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    const viete::base::Picture p = viete::base::decode_picture("fuzz", bytes);
    const auto pixels = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
    const bool good =
        p.width > 0 && p.height > 0 && pixels <= std::size_t{1} << 26 && p.rgba.size() == 4 * pixels;
    if (!good) std::abort();
  } catch (const viete::base::Error& error) {
    if (error.place().empty()) std::abort();
  }
  return 0;
}
