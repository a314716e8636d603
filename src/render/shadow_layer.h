// A soft shadow of the model on the ground, computed on the CPU.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/gl.h"
#include "render/program.h"
#include "render/surface_layer.h"
#include "render/view.h"

namespace viete::render {

/// A sample point on a triangle. Sample points are evenly spread over the area. Their number does not depend
/// on the size of the surface, and is small enough to move all points in every frame.
struct SpreadPoint {
  std::array<std::uint32_t, 3> corners;
  std::array<float, 3> shares;  ///< barycentric coordinates, with sum 1
};
/// Returns evenly spread sample points of the triangles. All triangle indices must be valid.
std::vector<SpreadPoint> spread_points(std::span<const Triangle> triangles, std::span<const Point> positions);

/// The darkness of the ground in a grid of cells, stored in rows.
struct GroundShadow {
  static constexpr int square = 6;  ///< the number of cells along a side of a drawn square
  int width = 0, height = 0;        ///< in cells, multiples of `square`; 0 if there is no shadow
  glm::vec2 low{0, 0};              ///< the lower corner of the first cell
  float cell = 1;
  std::vector<std::uint8_t> darkness;                 ///< 0 to 255; 0 along the edges of the grid
  std::vector<std::array<std::uint32_t, 2>> squares;  ///< the columns and rows of the squares with shadow
};

/// Returns the shadow of points with z as the height, for a surface of this size. The shadow is dark and
/// sharp near the ground, wide and faint below high points. Points far below the ground have no shadow.
GroundShadow ground_shadow(std::span<const glm::vec3> points, float size);

/// The ground plane, in world units.
struct ShadowStyle {
  Point center{0, 0, 0};  ///< a point on the ground, near the model
  int up = 1;             ///< the up axis: 0 x, 1 y, 2 z
  double size = 1;        ///< the model's size; shadows fade at a height proportional to it

  friend bool operator==(const ShadowStyle&, const ShadowStyle&) = default;
};

/// Draws the shadow, in less than a millisecond for models of any size. Copies all spans. Not thread-safe.
class ShadowLayer {
public:
  explicit ShadowLayer(const Gl& gl);

  /// Sets the triangles and the positions. Throws base::Error for invalid vertex indices.
  void set_triangles(std::span<const Triangle> triangles, std::span<const Point> positions);
  /// Sets the vertices, with positions relative to `origin`. Call it for every frame.
  void set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin);
  void set_positions(std::span<const Point> positions);

  /// Draw it after the surface and before the grid: tests the depth without writing it. Invisible from below.
  void draw(const View& view, const Theme& theme, const ShadowStyle& style);

private:
  template <class At>
  void set_points(const At& at, const Point& origin);
  void cast(const ShadowStyle& style);

  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
  Texture darkness_;
  BufferTexture squares_;
  std::vector<SpreadPoint> spread_;
  std::size_t vertex_count_ = 0;
  std::vector<glm::vec3> points_, over_ground_;  // relative to origin_; with z as the height above the ground
  Point origin_{0, 0, 0};
  ShadowStyle cast_on_;
  GroundShadow shadow_;
  bool moved_ = false;
};

}  // namespace viete::render
