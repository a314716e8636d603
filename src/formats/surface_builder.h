// Builds a valid Surface from the vertices and polygons of a file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

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

  /// Adds a vertex. Throws base::Error if there are more than 2^32 - 1 vertices.
  void position(const mesh::Point& p);

  /// Adds a corner. The caller must check the index before finish().
  void corner(std::uint32_t vertex) { result_.surface.corners.push_back(vertex); }

  /// Makes a polygon from the corners since the previous polygon. Drops polygons of fewer than three corners.
  void end_polygon();

  /// Makes the result a capture: points without faces are then no reason for a warning.
  void splats(std::shared_ptr<const mesh::Splats> splats) { result_.splats = std::move(splats); }

  /// Keeps the first 64 comments.
  void comment(std::string_view text);
  /// Adds the comments before the first statement.
  void comments(TextCursor& text);
  /// Adds a warning about the file, or about a line of the file.
  void warn(const std::string& text) { warn_at(source_.name, text); }
  void warn_at(const std::string& place, const std::string& text) {
    result_.warnings.push_back(place + ": " + text);
  }

  /// Triangulates the polygons. Without vertices, throws base::Error. Warns about dropped or missing
  /// polygons.
  ReadResult finish(std::string format, Attributes attributes = {});

private:
  const Source& source_;
  ReadResult result_;
  std::size_t short_polygons_ = 0;
};

}  // namespace viete::formats
