#include "render/image.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"

namespace viete::render {

namespace {

void append(void* bytes, void* data, int size) {
  const auto* first = static_cast<const std::uint8_t*>(data);
  auto* target = static_cast<std::vector<std::uint8_t>*>(bytes);
  target->insert(target->end(), first, first + size);
}

std::vector<std::uint8_t> encode_png(const std::filesystem::path& path, const Image& image) {
  const bool whole = image.width > 0 && image.height > 0 &&
                     image.rgba.size() == 4 * static_cast<std::size_t>(image.width) * image.height;
  if (!whole) throw base::Error(path.string(), "the picture is empty or incomplete");
  std::vector<std::uint8_t> bytes;
  const int done = stbi_write_png_to_func(append, &bytes, image.width, image.height, 4, image.rgba.data(),
                                          4 * image.width);
  if (done == 0) throw base::Error(path.string(), "there is not enough memory to encode the picture");
  return bytes;
}

// Display values of the bytes, as light.
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

// Means of four pixels; an odd last row or column goes.
Image halved(const Image& image) {
  Image half;
  half.width = std::max(1, image.width / 2);
  half.height = std::max(1, image.height / 2);
  half.rgba.resize(4 * static_cast<std::size_t>(half.width) * half.height);
  const auto& light = light_of_bytes();
  std::uint8_t* to = half.rgba.data();
  for (int y = 0; y < half.height; ++y) {
    for (int x = 0; x < half.width; ++x, to += 4) {
      const int right = std::min(2 * x + 1, image.width - 1), below = std::min(2 * y + 1, image.height - 1);
      const Rgba8 four[] = {image.pixel(2 * x, 2 * y), image.pixel(right, 2 * y), image.pixel(2 * x, below),
                            image.pixel(right, below)};
      for (std::size_t k = 0; k < 3; ++k)
        to[k] = byte_of_light(
            0.25F * (light[four[0][k]] + light[four[1][k]] + light[four[2][k]] + light[four[3][k]]));
      to[3] = static_cast<std::uint8_t>((four[0][3] + four[1][3] + four[2][3] + four[3][3] + 2) / 4);
    }
  }
  return half;
}

}  // namespace

Image decode_image(const std::string& place, std::string_view bytes, int longest) {
  constexpr int longest_side = 16384;
  constexpr std::size_t most_pixels = std::size_t{1} << 26;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const auto size = static_cast<int>(bytes.size());
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw base::Error(place, "the picture has more than 2 GB", "make it smaller");
  Image image;
  int channels = 0;
  if (stbi_info_from_memory(data, size, &image.width, &image.height, &channels) == 0)
    throw base::Error(place, "this is not a picture that can be read here", "save it as PNG or JPEG");
  const auto pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  if (image.width < 1 || image.height < 1 || image.width > longest_side || image.height > longest_side ||
      pixels > most_pixels)
    throw base::Error(place,
                      "the picture is " + std::to_string(image.width) + " x " + std::to_string(image.height) +
                          " pixels large, 64 million are shown",
                      "make it smaller");
  const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
      stbi_load_from_memory(data, size, &image.width, &image.height, &channels, 4), stbi_image_free);
  if (!decoded) throw base::Error(place, "the picture is damaged", "save it again");
  image.rgba.assign(decoded.get(), decoded.get() + 4 * pixels);
  while (image.width > longest || image.height > longest) image = halved(image);
  return image;
}

Rgba8 Image::pixel(int x, int y) const {
  const std::size_t at = 4 * (static_cast<std::size_t>(y) * width + x);
  return {rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]};
}

void write_png(const std::filesystem::path& path, const Image& image) {
  const std::vector<std::uint8_t> png = encode_png(path, image);
  base::replace_file(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace viete::render
