// Pictures in memory; reading and writing picture files.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/picture.h"

namespace viete::render {

using Rgba8 = std::array<std::uint8_t, 4>;
using Image = base::Picture;

/// Divides the colours by alpha. Drawing multiplies colours by alpha, but files need the original colours.
void divide_by_opacity(Image& image);

/// Writes the image and replaces an existing file atomically. Throws base::Error.
void write_png(const std::filesystem::path& path, const Image& image);

/// Decodes PNG, JPEG, BMP or TGA. Halves the picture until each side is at most `longest`. Throws base::Error
/// with `place` if the data is invalid, a side is above 16384, or there are more than 64 million pixels.
Image decode_image(const std::string& place, std::string_view bytes, int longest);

}  // namespace viete::render
