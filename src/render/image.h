// A picture in memory, and its PNG file.
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

/// Divides colours by alpha: drawing gives premultiplied colours, files store straight ones.
void divide_by_opacity(Image& image);

/// Writes a temporary file, syncs and renames it: atomic. Throws base::Error.
void write_png(const std::filesystem::path& path, const Image& image);

/// Decodes PNG, JPEG, BMP or TGA; halves it (in linear light) until no side is longer than `longest`. Checks
/// the size first: sides up to 16384, 64 million pixels. Throws base::Error at `place`.
Image decode_image(const std::string& place, std::string_view bytes, int longest);

}  // namespace viete::render
