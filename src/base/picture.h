// Pictures as files hold them, decoded and made PNG.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viete::base {

/// Top row first, one byte a channel: grey, grey and opacity, RGB or RGBA.
struct Picture {
  int width = 0, height = 0, channels = 4;
  std::vector<std::uint8_t> bytes;  ///< channels * width * height
};

/// PNG, JPEG, BMP and TGA, with as many channels as asked for; 0: as it has. Its size is checked
/// before anything is decoded: sides up to 16384, 64 million pixels. Throws Error at `place`.
Picture decode_picture(const std::string& place, std::string_view bytes, int channels = 0);

/// Bytes as a Picture has them. Throws Error at `place` if the picture is empty, incomplete or too large for
/// the memory.
std::string encode_png(const std::string& place, int width, int height, int channels,
                       std::span<const std::uint8_t> bytes);

}  // namespace viete::base
