// Pictures in memory. Reads and writes picture files.
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

/// Divides colours by alpha. Drawing gives colours multiplied by alpha; files store colours without it.
void divide_by_opacity(Image& image);

/// Replaces the file atomically. Throws base::Error.
void write_png(const std::filesystem::path& path, const Image& image);

/// Decodes PNG, JPEG, BMP or TGA, and halves the picture until no side is longer than `longest`. Throws
/// base::Error with `place` for invalid data, sides above 16384 or more than 64 million pixels.
Image decode_image(const std::string& place, std::string_view bytes, int longest);

}  // namespace viete::render
