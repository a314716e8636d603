// This file compiles its own copy of the stb decoder, so that sanitizers check the decoder.
#define STB_IMAGE_IMPLEMENTATION
#include <stb_image.h>

#include "base/error.h"
#include "base/picture.h"
#include "fuzz/checks.h"

void viete::fuzz::check_picture(std::string_view bytes) {
  try {
    const viete::base::Picture p = viete::base::decode_picture("fuzz", bytes);
    const auto pixels = static_cast<std::size_t>(p.width) * static_cast<std::size_t>(p.height);
    const bool good =
        p.width > 0 && p.height > 0 && pixels <= std::size_t{1} << 26 && p.rgba.size() == 4 * pixels;
    require(good);
  } catch (const viete::base::Error& error) {
    require(!error.place().empty());
  }
}
