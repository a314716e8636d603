// Collects what a reader finds and keeps the invariants of Surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "mesh/formats/original.h"
#include "mesh/formats/source.h"

namespace viete::mesh {

class SurfaceBuilder {
public:
  explicit SurfaceBuilder(const Source& source) : source_(source) {
    result_.surface.polygon_starts.push_back(0);
  }

  Surface& surface() { return result_.surface; }
  std::size_t vertex_count() const { return result_.surface.positions.size(); }

  /// Throws base::Error past 2^32 - 1 vertices.
  void position(const Point& p);

  /// The caller has checked the index, or will before finish().
  void corner(std::uint32_t vertex) { result_.surface.corners.push_back(vertex); }

  /// Corners since the last polygon make one. Fewer than three make none: that is counted and told at the
  /// end.
  void end_polygon();

  /// Keeps the comment if it is among the first 64 of the file's head.
  void comment(std::string_view text);
  void warn(std::string text) { result_.warnings.push_back(std::move(text)); }

  /// Cuts the polygons into triangles. Throws base::Error if the file holds no vertex; warns if it holds no
  /// polygon.
  ReadResult finish(std::string format);

private:
  const Source& source_;
  ReadResult result_;
  std::size_t short_polygons_ = 0;
};

}  // namespace viete::mesh
