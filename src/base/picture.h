// Decoding of picture files, and encoding as PNG.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace viete::base {

/// Top row first, one byte per channel: grey, grey and opacity, RGB or RGBA.
struct Picture {
  int width = 0, height = 0, channels = 4;
  std::vector<std::uint8_t> bytes;  ///< channels * width * height
};

/// Decodes PNG, JPEG, BMP and TGA to `channels` channels; 0: as in the file. Checks the size before decoding:
/// sides up to 16384, 64 million pixels. Throws Error at `place`.
Picture decode_picture(const std::string& place, std::string_view bytes, int channels = 0);

/// Bytes as in Picture. Throws Error at `place` if the picture is empty, incomplete or too large for the
/// memory.
std::string encode_png(const std::string& place, int width, int height, int channels,
                       std::span<const std::uint8_t> bytes);

}  // namespace viete::base
