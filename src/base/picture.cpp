#include "base/picture.h"

#include <stb_image.h>
#include <stb_image_write.h>

#include <algorithm>
#include <limits>
#include <memory>

#include "base/error.h"

namespace viete::base {

namespace {

// Returns false for PSD, PIC, HDR, PNM and GIF: the stb library decodes these formats less safely.
bool is_known(std::string_view bytes) {
  using namespace std::string_view_literals;
  constexpr auto others =
      std::to_array({"8BPS"sv, "\x53\x80\xF6\x34"sv, "#?RADIANCE"sv, "#?RGBE"sv, "P5"sv, "P6"sv, "GIF8"sv});
  return std::ranges::none_of(others, [&](std::string_view mark) { return bytes.starts_with(mark); });
}

std::size_t byte_at(std::string_view bytes, std::size_t i) {
  return i < bytes.size() ? static_cast<unsigned char>(bytes[i]) : 0;
}

// True if the JPEG tables at this position have at most 256 Huffman codes each. The stb library of Debian 12
// does not check this, and would overflow its arrays.
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

// True if all Huffman tables of a JPEG are valid. Up to the first scan, reads the segments in order. After
// the first scan, or after a damaged segment, checks all bytes that look like tables.
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

std::size_t word_at(std::string_view bytes, std::size_t i) {
  return byte_at(bytes, i) << 24 | byte_at(bytes, i + 1) << 16 | byte_at(bytes, i + 2) << 8 |
         byte_at(bytes, i + 3);
}

// Returns the number of pixels. If the picture is too large, throws Error.
std::size_t check_size(const std::string& place, std::size_t width, std::size_t height) {
  constexpr std::size_t longest_side = 16384, most_pixels = std::size_t{1} << 26;
  if (width > 0 && height > 0 && width <= longest_side && height <= longest_side &&
      width * height <= most_pixels)
    return width * height;
  throw Error(place,
              "the picture is " + std::to_string(width) + " x " + std::to_string(height) +
                  " pixels large, the limit is 64 million pixels and 16384 on each side",
              "make the picture smaller");
}

void append_to(void* text, void* data, int size) {
  static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

std::array<std::uint8_t, 4> Picture::pixel(int x, int y) const {
  const std::size_t at = 4 * (static_cast<std::size_t>(y) * width + x);
  return {rgba[at], rgba[at + 1], rgba[at + 2], rgba[at + 3]};
}

Picture decode_picture(const std::string& place, std::string_view bytes) {
  const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
  const auto size = static_cast<int>(bytes.size());
  if (bytes.size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    throw Error(place, "the picture has more than 2 GB", "make the picture smaller");
  if (bytes.starts_with('\xFF') && !has_sound_tables(bytes))
    throw Error(place, "the picture is damaged", "save the picture again");
  Picture picture;
  int channels = 0;
  // For a PNG that is too large, the stb library does not report the size. Reads the size from the header.
  if (bytes.starts_with("\x89PNG") && bytes.size() >= 24 && bytes.substr(0, 16).ends_with("IHDR"))
    check_size(place, word_at(bytes, 16), word_at(bytes, 20));
  if (!is_known(bytes) || stbi_info_from_memory(data, size, &picture.width, &picture.height, &channels) == 0)
    throw Error(place, "this is not a picture in a supported format", "save the picture as PNG or JPEG");
  const std::size_t pixels =
      check_size(place, static_cast<std::size_t>(picture.width), static_cast<std::size_t>(picture.height));
  const std::unique_ptr<stbi_uc, void (*)(void*)> decoded(
      stbi_load_from_memory(data, size, &picture.width, &picture.height, &channels, 4), stbi_image_free);
  const bool as_announced =
      static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height) == pixels;
  if (!decoded || !as_announced) throw Error(place, "the picture is damaged", "save the picture again");
  picture.rgba.assign(decoded.get(), decoded.get() + 4 * pixels);
  return picture;
}

std::string encode_png(const std::string& place, const Picture& picture) {
  const auto& [width, height, rgba] = picture;
  if (width <= 0 || height <= 0 || rgba.size() != 4 * static_cast<std::size_t>(width) * height)
    throw Error(place, "the picture is empty or incomplete");
  std::string png;
  if (stbi_write_png_to_func(append_to, &png, width, height, 4, rgba.data(), 4 * width) == 0)
    throw Error(place, "there is not enough memory to encode the picture", "choose a smaller picture");
  return png;
}

}  // namespace viete::base
