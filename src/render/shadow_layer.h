// A soft shadow of the model on the ground, computed on the CPU.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/gl.h"
#include "render/surface_layer.h"
#include "render/view.h"

namespace viete::render {

/// A sample point on a triangle.
struct SpreadPoint {
  std::array<std::uint32_t, 3> corners;  ///< the vertices of the triangle
  std::array<float, 3> shares;           ///< barycentric coordinates, with sum 1
};
/// Returns 24,000 sample points, evenly spread over the area: few enough to move all points in every frame.
/// If there is no area, returns no points. All triangle indices must be valid.
std::vector<SpreadPoint> spread_points(std::span<const Triangle> triangles, std::span<const Point> positions);

/// The darkness of the ground in a grid of cells, stored in rows.
struct GroundShadow {
  static constexpr int square = 6;  ///< side of a square in cells; squares without shadow are not drawn
  int width = 0, height = 0;        ///< in cells, multiples of `square`; 0 if there is no shadow
  glm::vec2 low{0, 0};              ///< the lower corner of the first cell
  float cell = 1;
  std::vector<std::uint8_t> darkness;                 ///< 0 to 255; 0 along the edges of the grid
  std::vector<std::array<std::uint32_t, 2>> squares;  ///< column and row of each square with shadow
};

/// Returns the shadow of points on the ground z = 0. `size` is the size of the model. Points near the ground
/// have a dark, sharp shadow, and high points a faint, wide one. Points far below the ground have no shadow.
GroundShadow ground_shadow(std::span<const glm::vec3> points, float size);

/// The ground plane, in world units.
struct ShadowStyle {
  Point center{0, 0, 0};  ///< a point on the ground, near the model
  int up = 1;             ///< the up axis: 0 x, 1 y, 2 z
  double size = 1;        ///< the model's size; shadows fade at a height proportional to it
  bool down = false;      ///< true: the axis points down

  friend bool operator==(const ShadowStyle&, const ShadowStyle&) = default;
};

/// Returns 1 if the ground is seen from above, 0 from below, and a value between if it is nearly edge-on.
float from_above(const View& view, const ShadowStyle& style);

/// Draws the shadow in less than a millisecond, for all sizes of models. Copies all spans. Not thread-safe.
class ShadowLayer {
public:
  explicit ShadowLayer(const Gl& gl);

  /// Sets the triangles and the positions. Throws base::Error for invalid vertex indices.
  void set_triangles(std::span<const Triangle> triangles, std::span<const Point> positions);
  /// For a model without triangles: sets the vertices that have a shadow, and the positions of all vertices.
  /// Uses at most 24,000 of them, evenly chosen. Vertex indices must be valid.
  void set_points(std::span<const std::uint32_t> vertices, std::span<const Point> positions);
  /// Sets the vertices of a frame, with positions relative to `origin`.
  void set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin);
  void set_positions(std::span<const Point> positions);

  /// Call this after drawing the surface and before drawing the grid. The shadow is invisible from below.
  void draw(const View& view, const Theme& theme, const ShadowStyle& style);

private:
  template <class At>
  void move(const At& at, const Point& origin);
  void cast(const ShadowStyle& style);

  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
  Texture darkness_;
  BufferTexture squares_;
  std::vector<SpreadPoint> spread_;
  std::size_t vertex_count_ = 0;
  std::vector<glm::vec3> points_, over_ground_;  // points_: relative to origin_; over_ground_: z is up
  Point origin_{0, 0, 0};
  ShadowStyle cast_on_;
  GroundShadow shadow_;
  bool moved_ = false;
};

}  // namespace viete::render
