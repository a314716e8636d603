#include "base/picture.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>

#include "base/error.h"

namespace viete::base {

namespace {

// PNG, JPEG, BMP, and TGA, which has no signature. The library also decodes PSD, PIC, HDR, PNM and GIF, but
// less robustly.
bool is_known(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr auto others =
      std::to_array({"8BPS"sv, "\x53\x80\xF6\x34"sv, "#?RADIANCE"sv, "#?RGBE"sv, "P5"sv, "P6"sv, "GIF8"sv});
  return std::ranges::none_of(others, [&](std::string_view mark) { return bytes.starts_with(mark); });
}

std::size_t byte_at(std::string_view bytes, std::size_t i) {
  return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
}

// A JPEG has at most 256 Huffman codes. The library version of Debian 12 does not check the counts, and
// overflows its tables. at: position after the marker.
bool counts_fit(std::string_view bytes, std::size_t at) {
  std::size_t left = 256 * byte_at(bytes, at) + byte_at(bytes, at + 1);
  at += 2;
  for (left -= std::min<std::size_t>(left, 2); left > 0 && at < bytes.size();) {
    std::size_t codes = 0;
    for (std::size_t i = 1; i <= 16; ++i) codes += byte_at(bytes, at + i);
    if (codes > 256) return false;
    at += 17 + codes;
    left -= std::min(left, 17 + codes);
  }
  return true;
}

// Segments with a length follow each other up to the first scan. After it, or if the sequence is broken,
// anything that looks like tables must be valid.
bool has_sound_tables(std::string_view bytes) {
  constexpr std::size_t tables = 0xC4, scan = 0xDA, mark = 0xFF;
  std::size_t at = std::min(bytes.find_first_not_of('\xFF'), bytes.size() - 1) + 1;  // after the first marker
  while (byte_at(bytes, at) == mark && byte_at(bytes, at + 1) != mark) {
    const std::size_t kind = byte_at(bytes, at + 1);
    const std::size_t length = 256 * byte_at(bytes, at + 2) + byte_at(bytes, at + 3);
    if (kind == scan || length < 2) break;
    if (kind == tables && !counts_fit(bytes, at + 2)) return false;
    at += 2 + length;
  }
  while ((at = bytes.find("\xFF\xC4", at)) != std::string_view::npos) {
    at += 2;
    if (!counts_fit(bytes, at)) return false;
  }
  return true;
}

// Big-endian. The library rejects large PNG files without reporting their size.
std::size_t word_at(std::string_view bytes, std::size_t i) {
  return byte_at(bytes, i) << 24 | byte_at(bytes, i + 1) << 16 | byte_at(bytes, i + 2) << 8 |
         byte_at(bytes, i + 3);
}

// The number of pixels.
std::size_t check_size(const std::string& place, std::size_t width, std::size_t height) {
  constexpr std::size_t longest_side = 16384, most_pixels = std::size_t{1} << 26;
  if (width > 0 && height > 0 && width <= longest_side && height <= longest_side &&
      width * height <= most_pixels)
    return width * height;
  throw Error(place,
              "the picture is " + std::to_string(width) + " x " + std::to_string(height) +
                  " pixels large, the limit is 64 million",
              "make it smaller");
}

void append_to(void* text, void* data, int size) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

Picture decode_picture(const std::string& place, std::string_view bytes, int channels) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const auto size = static_cast<int>(bytes.size());
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(place, "the picture has more than 2 GB", "make it smaller");
  if (bytes.starts_with('\xFF') && !has_sound_tables(bytes))
    throw Error(place, "the picture is damaged", "save it again");
  Picture picture;
  if (bytes.starts_with("\x89PNG") && bytes.size() >= 24 && bytes.substr(0, 16).ends_with("IHDR"))
    check_size(place, word_at(bytes, 16), word_at(bytes, 20));
  if (!is_known(bytes) ||
      stbi_info_from_memory(data, size, &picture.width, &picture.height, &picture.channels) == 0)
    throw Error(place, "this is not a picture in a supported format", "save it as PNG or JPEG");
  const std::size_t pixels =
      check_size(place, static_cast<std::size_t>(picture.width), static_cast<std::size_t>(picture.height));
  const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
      stbi_load_from_memory(data, size, &picture.width, &picture.height, &picture.channels, channels),
      stbi_image_free);
  const bool as_said =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) == pixels;
  if (!decoded || !as_said) throw Error(place, "the picture is damaged", "save it again");
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
