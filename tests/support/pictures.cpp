#include "support/pictures.h"

#include <doctest/doctest.h>
#include <stb_image.h>

#include <cstdlib>
#include <memory>

namespace viete::test {

render::Image read_png(const std::filesystem::path& path) {
  int width = 0, height = 0, channels = 0;
  const std::unique_ptr<unsigned char, decltype(&stbi_image_free)> pixels(
      stbi_load(path.c_str(), &width, &height, &channels, 4), stbi_image_free);
  REQUIRE_MESSAGE(pixels, path);
  return {width, height, {pixels.get(), pixels.get() + 4 * static_cast<std::size_t>(width) * height}};
}

double difference(const render::Image& a, const render::Image& b, int tolerance) {
  REQUIRE(a.width == b.width);
  REQUIRE(a.height == b.height);
  if (a.rgba.empty()) return 0;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    bool differs = false;
    for (std::size_t c = i; c < i + 4; ++c) differs |= std::abs(a.rgba[c] - b.rgba[c]) > tolerance;
    differing += differs ? 1 : 0;
  }
  return static_cast<double>(differing) / (static_cast<double>(a.rgba.size()) / 4);
}

render::Image shrunk(const render::Image& image, int cell) {
  render::Image small{image.width / cell, image.height / cell, {}};
  for (int y = 0; y < small.height; ++y)
    for (int x = 0; x < small.width; ++x)
      for (int channel = 0; channel < 4; ++channel) {
        int sum = 0;
        for (int i = 0; i < cell * cell; ++i) {
          const int row = y * cell + i / cell, column = x * cell + i % cell;
          sum += image.rgba[4 * (static_cast<std::size_t>(row) * image.width + column) + channel];
        }
        small.rgba.push_back(static_cast<std::uint8_t>(sum / (cell * cell)));
      }
  return small;
}

}  // namespace viete::test
