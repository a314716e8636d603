// A picture in memory, and as a PNG file.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace viete::render {

using Rgba8 = std::array<std::uint8_t, 4>;

/// Top row first, 4 bytes a pixel, display values (sRGB), alpha not premultiplied.
struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  ///< 4 * width * height bytes

  /// x in [0, width) from the left, y in [0, height) from the top.
  Rgba8 pixel(int x, int y) const;
};

/// What is drawn over nothing has its colour times its opacity; files have it whole.
void divide_by_opacity(Image& image);

/// Writes beside the file, syncs and renames, so that the file is whole or untouched. Throws base::Error.
void write_png(const std::filesystem::path& path, const Image& image);

/// A PNG, JPEG, BMP or TGA, halved until no side is longer than `longest` (in linear light). Its size is
/// checked before anything is decoded: sides up to 16384, 64 million pixels. Throws base::Error at `place`.
Image decode_image(const std::string& place, std::string_view bytes, int longest);

}  // namespace viete::render
