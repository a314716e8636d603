// STL, text and binary: loose triangles, joined where their corners are equal.
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
/// one vertex (0 and -0 are equal); vertices stand in the order of their first occurrence. The two
/// attribute bytes of binary files are read as colours of facets, as VisCAM, SolidView and Magics have them;
/// where the file is as long as it must be if they count attributes that follow, those are passed over.
/// Normals are kept for writing alone. Throws base::Error, base::Cancelled.
ReadResult read_stl(const Source& source);

/// True if the size is exactly what the triangle count of a binary STL asks for, or if the text starts with
/// solid.
bool looks_like_stl(const Source& source);

/// True if the words of a text are those of STL, or if the numbers of the first triangles of a binary file
/// make sense.
bool is_certainly_stl(const Beginning& file);

/// Text, because binary STL would round the positions to float. Keeps triangles only: unused vertices are
/// lost.
void write_stl(const Content& content, TextWriter& out);

/// The file as it was, to be written again. Binary: header, attributes and what stands behind the triangles
/// stay. Text: solids and their names stay, numbers are printed as in the file. Normals of facets that moved
/// follow; those that are 0 0 0 stay so. It throws base::Error too where a position does not fit into the
/// float of a binary file.
std::shared_ptr<const Original> stl_original(const Source& source, bool binary);

/// Of a binary STL: what stands before the triangles, and each of these without attributes behind it.
inline constexpr std::size_t stl_head_bytes = 84, stl_triangle_bytes = 50;

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

/// A word of a text STL in small letters, at most 16 of them.
std::string lower_stl_word(std::string_view word);

}  // namespace viete::mesh
