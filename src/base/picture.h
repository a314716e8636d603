// Decoding of picture files, and encoding as PNG.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace viete::base {

/// Top row first, display values (sRGB), alpha not premultiplied.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 * width * height bytes

  /// x in [0, width) from the left, y in [0, height) from the top.
  std::array<std::uint8_t, 4> pixel(int x, int y) const;
};

/// Decodes PNG, JPEG, BMP and TGA. Checks the size before decoding: sides up to 16384, 64 million pixels.
/// Throws Error at `place`.
Picture decode_picture(const std::string& place, std::string_view bytes);

/// Throws Error at `place` if the picture is empty, incomplete or too large for the memory.
std::string encode_png(const std::string& place, const Picture& picture);

}  // namespace viete::base
