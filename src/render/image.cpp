#include "render/image.h"

#include <stb_image_write.h>

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

}  // namespace

Rgba8 Image::pixel(int x, int y) const {
  const std::size_t at = 4 * (static_cast<std::size_t>(y) * width + x);
  return {rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]};
}

void write_png(const std::filesystem::path& path, const Image& image) {
  const std::vector<std::uint8_t> png = encode_png(path, image);
  base::replace_file(path, {reinterpret_cast<const char*>(png.data()), png.size()});
}

}  // namespace viete::render
