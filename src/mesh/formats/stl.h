// STL, text and binary: separate triangles, joined at equal corners.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "mesh/formats/original.h"
#include "mesh/formats/source.h"
#include "mesh/formats/text_writer.h"

namespace viete::mesh {

/// Source: 3D Systems, StereoLithography Interface Specification, 1989. Corners with equal coordinates become
/// one vertex (0 and -0 are equal), in order of first occurrence. The two attribute bytes of binary files are
/// read as facet colours of VisCAM, SolidView and Magics; if the file size shows that they count following
/// attributes, these are skipped. Normals are only kept for writing. Throws base::Error, base::Cancelled.
ReadResult read_stl(const Source& source);

/// True if the size matches the triangle count of a binary STL exactly, or if the text starts with "solid".
bool looks_like_stl(const Source& source);

/// True if the words of a text are STL keywords, or if the first triangles of a binary file are plausible.
bool is_certainly_stl(const Beginning& file);

/// Writes text, because binary STL rounds positions to float. Writes triangles only: drops unused vertices.
void write_stl(const Content& content, TextWriter& out);

/// The file kept as read, to be written again. Binary: header, attributes and trailing bytes stay. Text:
/// solids and names stay, numbers keep their format. Normals of moved facets are updated, except 0 0 0.
/// Writing throws base::Error also if a position exceeds the float range of a binary file.
std::shared_ptr<const Original> stl_original(const Source& source, bool binary);

/// Binary STL: size of the header with the count, and of a triangle without extra attributes.
inline constexpr std::size_t stl_head_bytes = 84, stl_triangle_bytes = 50;

/// Offsets of the triangles in a binary STL.
class StlTriangles {
public:
  /// Throws base::Error if the file length contradicts the triangle count.
  explicit StlTriangles(const Source& source);

  std::size_t count() const { return count_; }
  std::size_t offset(std::size_t triangle) const {
    return starts_.empty() ? stl_head_bytes + stl_triangle_bytes * triangle : starts_[triangle];
  }
  /// Offset after the last triangle and its attributes.
  std::size_t end() const { return end_; }
  bool have_attributes() const { return !starts_.empty(); }

private:
  bool follow_attributes(std::string_view bytes);
  bool make_sense(std::string_view bytes) const;

  std::size_t count_ = 0, end_ = 0;
  std::vector<std::size_t> starts_;  // only if attributes follow
};

/// A keyword of a text STL in lower case, at most 16 letters.
std::string lower_stl_word(std::string_view word);

}  // namespace viete::mesh
