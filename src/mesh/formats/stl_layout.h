// Where things stand in STL files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/source.h"

namespace viete::mesh {

/// Of a binary STL: what stands before the triangles, and each of these without attributes behind it.
inline constexpr std::size_t stl_head_bytes = 84, stl_triangle_bytes = 50;
/// The numbers that stand there, little-endian.
std::uint16_t stl_short(const char* bytes);
std::uint32_t stl_word(const char* bytes);
double stl_float(const char* bytes);

/// Where the triangles of a binary STL stand.
class StlTriangles {
public:
  /// Throws base::Error where the length of the file does not fit what it says of itself.
  explicit StlTriangles(const Source& source);

  std::size_t count() const { return count_; }
  std::size_t offset(std::size_t triangle) const {
    return starts_.empty() ? stl_head_bytes + stl_triangle_bytes * triangle : starts_[triangle];
  }
  /// Behind the last one and its attributes.
  std::size_t end() const { return end_; }
  bool have_attributes() const { return !starts_.empty(); }

private:
  bool follow_attributes(std::string_view bytes);
  bool make_sense(std::string_view bytes) const;

  std::size_t count_ = 0, end_ = 0;
  std::vector<std::size_t> starts_;  // where attributes follow
};

/// True if the size of the file is what the count asks for, or if the first triangles make sense with the
/// attributes that they count.
bool begins_stl_triangles(std::string_view beginning, std::uint64_t file_size);

/// A word of a text STL in small letters, at most 16 of them.
std::string lower_stl_word(std::string_view word);

}  // namespace viete::mesh
