#include "mesh/formats/stl_layout.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "base/error.h"

namespace viete::mesh {

std::uint16_t stl_short(const char* bytes) {
  return static_cast<std::uint16_t>(static_cast<unsigned char>(bytes[0]) |
                                    static_cast<unsigned char>(bytes[1]) << 8);
}

std::uint32_t stl_word(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

double stl_float(const char* bytes) {
  return std::bit_cast<float>(stl_word(bytes));
}

namespace {

[[noreturn]] void refuse_length(const Source& source, const std::string& problem) {
  throw base::Error(source.name, problem, "it seems to be cut short or damaged: export or copy it again");
}

// Read from a wrong place, bytes give numbers of no size that a model, or a normal, has.
bool makes_sense(const char* triangle) {
  for (std::size_t i = 0; i < 12; ++i) {
    const double size = std::abs(stl_float(triangle + 4 * i));
    if (size != 0 && !(size > 1e-37 && size < (i < 3 ? 1e6 : 1e30))) return false;
  }
  return true;
}

}  // namespace

StlTriangles::StlTriangles(const Source& source) {
  const std::string_view bytes = source.bytes;
  if (bytes.size() < stl_head_bytes)
    refuse_length(source, "a binary STL has 84 bytes at least, this file " + std::to_string(bytes.size()));
  count_ = stl_word(bytes.data() + 80);
  const std::size_t room = bytes.size() - stl_head_bytes;
  const std::string announced = "the header announces " + std::to_string(count_) + " triangles";
  if (count_ > room / stl_triangle_bytes)
    refuse_length(source, announced + ", the file has room for " + std::to_string(room / stl_triangle_bytes));
  if (count_ == 0 && room > 0)
    refuse_length(source, announced + ", and " + std::to_string(room) + " bytes follow");
  end_ = stl_head_bytes + count_ * stl_triangle_bytes;
  if (end_ == bytes.size() || follow_attributes(bytes) || make_sense(bytes)) return;
  refuse_length(source, announced + ", and neither they alone nor they and the attributes that they count " +
                            "behind them are what follows");
}

// True where there are any and they lie within the file.
bool StlTriangles::follow_attributes(std::string_view bytes) {
  std::vector<std::size_t> starts;
  std::size_t at = stl_head_bytes;
  for (std::size_t t = 0; t < count_; ++t) {
    if (bytes.size() - at < stl_triangle_bytes) return false;
    starts.push_back(at);
    at += stl_triangle_bytes;
    const std::uint16_t more = stl_short(bytes.data() + at - 2);
    if (bytes.size() - at < more) return false;
    at += more;
  }
  if (at == end_) return false;
  end_ = at;
  starts_ = std::move(starts);
  return true;
}

bool StlTriangles::make_sense(std::string_view bytes) const {
  for (std::size_t t = 0; t < count_; ++t)
    if (!makes_sense(bytes.data() + offset(t))) return false;
  return true;
}

bool begins_stl_triangles(std::string_view beginning, std::uint64_t file_size) {
  if (beginning.size() < stl_head_bytes) return false;
  const std::uint32_t count = stl_word(beginning.data() + 80);
  const std::uint64_t least = stl_head_bytes + std::uint64_t{stl_triangle_bytes} * count;
  if (count == 0 || least >= file_size) return least == file_size;
  std::size_t at = stl_head_bytes;
  for (std::uint32_t t = 0; t < count && at + stl_triangle_bytes <= beginning.size(); ++t) {
    if (!makes_sense(beginning.data() + at)) return false;
    at += stl_triangle_bytes;
    at += stl_short(beginning.data() + at - 2);
  }
  return true;
}

std::string lower_stl_word(std::string_view word) {
  std::string text(word.substr(0, 16));
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
  return text;
}

}  // namespace viete::mesh
