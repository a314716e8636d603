#include "base/picture.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <limits>
#include <memory>

#include "base/error.h"

namespace viete::base {

namespace {

void append_to(void* text, void* data, int size) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

Picture decode_picture(const std::string& place, std::string_view bytes, int channels) {
  constexpr int longest_side = 16384;
  constexpr std::size_t most_pixels = std::size_t{1} << 26;
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const auto size = static_cast<int>(bytes.size());
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(place, "the picture has more than 2 GB", "make it smaller");
  Picture picture;
  if (stbi_info_from_memory(data, size, &picture.width, &picture.height, &picture.channels) == 0)
    throw Error(place, "this is not a picture that can be read here", "save it as PNG or JPEG");
  const auto pixels = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
  if (picture.width < 1 || picture.height < 1 || picture.width > longest_side ||
      picture.height > longest_side || pixels > most_pixels)
    throw Error(place,
                "the picture is " + std::to_string(picture.width) + " x " + std::to_string(picture.height) +
                    " pixels large, 64 million are shown",
                "make it smaller");
  const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
      stbi_load_from_memory(data, size, &picture.width, &picture.height, &picture.channels, channels),
      stbi_image_free);
  if (!decoded) throw Error(place, "the picture is damaged", "save it again");
  if (channels > 0) picture.channels = channels;
  picture.bytes.assign(decoded.get(), decoded.get() + static_cast<std::size_t>(picture.channels) * pixels);
  return picture;
}

std::string encode_png(const std::string& place, int width, int height, int channels,
                       std::span<const std::uint8_t> bytes) {
  const bool whole = width > 0 && height > 0 &&
                     bytes.size() == static_cast<std::size_t>(channels) * static_cast<std::size_t>(width) *
                                         static_cast<std::size_t>(height);
  if (!whole) throw Error(place, "the picture is empty or incomplete");
  std::string png;
  if (stbi_write_png_to_func(append_to, &png, width, height, channels, bytes.data(), channels * width) == 0)
    throw Error(place, "there is not enough memory to encode the picture");
  return png;
}

}  // namespace viete::base
