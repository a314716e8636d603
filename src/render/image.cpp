#include "render/image.h"

#include <algorithm>
#include <cmath>

#include "base/atomic_file.h"

namespace viete::render {

namespace {

// Returns the linear light for each 8-bit sRGB value.
const std::array<float, 256>& light_of_bytes() {
  static const auto table = [] {
    std::array<float, 256> light;
    for (std::size_t i = 0; i < 256; ++i) {
      const double x = static_cast<double>(i) / 255;
      light[i] = static_cast<float>(x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
    }
    return light;
  }();
  return table;
}

std::uint8_t byte_of_light(float light) {
  const float x = light <= 0.0031308F ? 12.92F * light : 1.055F * std::pow(light, 1 / 2.4F) - 0.055F;
  return static_cast<std::uint8_t>(std::lround(255 * x));
}

// Averages blocks of 2 x 2 pixels in linear light. Ignores an odd last row or column.
Image halved(const Image& image) {
  Image half;
  half.width = std::max(1, image.width / 2);
  half.height = std::max(1, image.height / 2);
  half.rgba.resize(4 * static_cast<std::size_t>(half.width) * half.height);
  const auto& light = light_of_bytes();
  std::uint8_t* to = half.rgba.data();
  for (int y = 0; y < half.height; ++y)
    for (int x = 0; x < half.width; ++x, to += 4) {
      const int right = std::min(2 * x + 1, image.width - 1), below = std::min(2 * y + 1, image.height - 1);
      const Rgba8 four[] = {image.pixel(2 * x, 2 * y), image.pixel(right, 2 * y), image.pixel(2 * x, below),
                            image.pixel(right, below)};
      for (std::size_t k = 0; k < 3; ++k)
        to[k] = byte_of_light(
            0.25F * (light[four[0][k]] + light[four[1][k]] + light[four[2][k]] + light[four[3][k]]));
      to[3] = static_cast<std::uint8_t>((four[0][3] + four[1][3] + four[2][3] + four[3][3] + 2) / 4);
    }
  return half;
}

}  // namespace

Image decode_image(const std::string& place, std::string_view bytes, int longest) {
  Image image = base::decode_picture(place, bytes);
  while (image.width > longest || image.height > longest) image = halved(image);
  return image;
}

void divide_by_opacity(Image& image) {
  for (std::size_t i = 0; i + 3 < image.rgba.size(); i += 4) {
    const int opacity = std::max<int>(1, image.rgba[i + 3]);
    for (std::size_t k = 0; k < 3; ++k)
      image.rgba[i + k] =
          static_cast<std::uint8_t>(std::min(255, (255 * image.rgba[i + k] + opacity / 2) / opacity));
  }
}

void write_png(const std::filesystem::path& path, const Image& image) {
  base::replace_file(path, base::encode_png(path.string(), image));
}

}  // namespace viete::render
