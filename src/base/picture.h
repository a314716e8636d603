// Decodes picture files and encodes PNG.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace viete::base {

/// sRGB values, top row first. Alpha is not premultiplied.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 * width * height bytes

  /// The pixel in column x from the left and row y from the top, both starting at 0.
  std::array<std::uint8_t, 4> pixel(int x, int y) const;
};

/// Decodes PNG, JPEG, BMP and TGA with at most 64 million pixels and sides up to 16384. Throws Error with
/// `place`.
Picture decode_picture(const std::string& place, std::string_view bytes);

/// Throws Error with `place` if the picture is empty, incomplete or too large for the memory.
std::string encode_png(const std::string& place, const Picture& picture);

}  // namespace viete::base
