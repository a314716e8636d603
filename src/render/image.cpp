#include "render/image.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <cstdlib>
#include <fstream>
#include <memory>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"

namespace viete::render {

namespace {

constexpr int largest_side = 16384;

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

std::vector<std::uint8_t> read_bytes(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  if (!file.is_open() || file.bad())
    throw base::Error(path.string(), "cannot be read", "check the name and the rights");
  return bytes;
}

}  // namespace

Rgba8 Image::pixel(int x, int y) const {
  const std::size_t at = 4 * (static_cast<std::size_t>(y) * width + x);
  return {rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]};
}

void write_png(const std::filesystem::path& path, const Image& image) {
  const std::vector<std::uint8_t> png = encode_png(path, image);
  base::replace_file(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

Image read_png(const std::filesystem::path& path) {
  const std::vector<std::uint8_t> bytes = read_bytes(path);
  const auto length = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  const bool known = stbi_info_from_memory(bytes.data(), length, &width, &height, &channels) != 0;
  if (!known) throw base::Error(path.string(), "is not a picture that can be read", "give a PNG file");
  if (width > largest_side || height > largest_side)
    throw base::Error(path.string(), "is larger than 16384 pixels a side");

  std::unique_ptr<unsigned char, decltype(&stbi_image_free)> pixels(
      stbi_load_from_memory(bytes.data(), length, &width, &height, &channels, 4), stbi_image_free);
  if (!pixels) throw base::Error(path.string(), std::string("is damaged: ") + stbi_failure_reason());
  return {width, height, {pixels.get(), pixels.get() + 4 * static_cast<std::size_t>(width) * height}};
}

double difference(const Image& a, const Image& b, int tolerance) {
  if (a.width != b.width || a.height != b.height)
    throw base::Error("pictures", "differ in size and cannot be compared");
  if (a.rgba.empty()) return 0;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < a.rgba.size(); i += 4) {
    bool differs = false;
    for (std::size_t c = i; c < i + 4; ++c) differs |= std::abs(a.rgba[c] - b.rgba[c]) > tolerance;
    differing += differs ? 1 : 0;
  }
  return static_cast<double>(differing) / (static_cast<double>(a.rgba.size()) / 4);
}

}  // namespace viete::render
