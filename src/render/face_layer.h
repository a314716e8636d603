// Translucent faces: a light tint, and depth, so that what is drawn later knows what lies in front.
#pragma once

#include <cstdint>
#include <span>

#include "render/gl_objects.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

struct FaceStyle {
  glm::vec3 color{1, 1, 1};  ///< as displayed
  float opacity = 0.05F;     ///< of a face seen from the front; 0 tints nothing
  float rim = 0.10F;         ///< added where a face is seen edge-on
  bool occlude = true;  ///< write depth after tinting, so that lines and discs behind a face are drawn faint
};

/// Not thread-safe. All spans are copied. Throws base::Error if a size does not fit or a triangle names a
/// missing point.
class FaceLayer {
public:
  explicit FaceLayer(const Gl& gl);

  /// New topology; forgets positions.
  void set_triangles(std::span<const Triangle> triangles, std::size_t point_count);
  /// Every frame; size equal to the point count.
  void set_positions(std::span<const Point> positions);
  /// Draws nothing before set_positions().
  void draw(const View& view, const FaceStyle& style) const;

private:
  void draw_triangles() const;
  void draw_depth() const;

  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
  Buffer indices_, points_;
  std::size_t triangle_count_ = 0, point_count_ = 0;
  Point origin_{0, 0, 0};
  bool has_positions_ = false;
};

}  // namespace viete::render
