// Collects a reader's data and ensures the invariants of Surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "formats/original.h"
#include "formats/source.h"
#include "formats/text_cursor.h"

namespace viete::formats {

class SurfaceBuilder {
public:
  explicit SurfaceBuilder(const Source& source) : source_(source) {
    result_.surface.polygon_starts.push_back(0);
  }

  mesh::Surface& surface() { return result_.surface; }
  std::size_t vertex_count() const { return result_.surface.positions.size(); }

  /// Throws base::Error past 2^32 - 1 vertices.
  void position(const mesh::Point& p);

  /// The index must be checked before finish().
  void corner(std::uint32_t vertex) { result_.surface.corners.push_back(vertex); }

  /// Ends a polygon of the corners added since the last one. Drops and counts those with fewer than three
  /// corners; finish() warns about them.
  void end_polygon();

  /// Keeps the comment if it is among the first 64 of the header.
  void comment(std::string_view text);
  /// The comments up to the first statement.
  void comments(TextCursor& text);
  void warn(std::string text) { result_.warnings.push_back(std::move(text)); }

  /// Triangulates the polygons. Throws base::Error without vertices; warns without polygons.
  ReadResult finish(std::string format);

private:
  const Source& source_;
  ReadResult result_;
  std::size_t short_polygons_ = 0;
};

}  // namespace viete::formats
