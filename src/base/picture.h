// Decodes picture files and encodes PNG.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace viete::base {

/// A picture with sRGB values, top row first. Colours are not multiplied by alpha.
struct Picture {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 * width * height bytes

  /// Returns the pixel in column x from the left and row y from the top. Both numbers start at 0.
  std::array<std::uint8_t, 4> pixel(int x, int y) const;
};

/// Decodes PNG, JPEG, BMP and TGA with at most 64 million pixels and sides of at most 16384. Throws Error
/// with `place`.
Picture decode_picture(const std::string& place, std::string_view bytes);

/// Encodes a PNG. If the picture is empty, incomplete or too large for the memory, throws Error with `place`.
std::string encode_png(const std::string& place, const Picture& picture);

}  // namespace viete::base
