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

/// Sample points spread evenly over the original triangles: few enough to move in every frame, whatever the
/// size of the surface, and enough for large triangles.
struct SpreadPoint {
  std::array<std::uint32_t, 3> corners;
  std::array<float, 3> shares;  ///< barycentric weights of the corners, sum 1
};
/// All triangle indices must be valid.
std::vector<SpreadPoint> spread_points(std::span<const Triangle> triangles, std::span<const Point> positions);

/// Darkness of a grid of ground cells, in rows.
struct GroundShadow {
  static constexpr int square = 6;  ///< cells along a side of a drawn square
  int width = 0, height = 0;        ///< in cells, multiples of `square`; 0: no shadow
  glm::vec2 low{0, 0};              ///< lower corner of the first cell
  float cell = 1;
  std::vector<std::uint8_t> darkness;                 ///< 0 to 255; 0 along the edges
  std::vector<std::array<std::uint32_t, 2>> squares;  ///< columns and rows of the squares with shadow
};

/// Shadow of points with x and y on the ground and height z. Dark and sharp where points touch the ground,
/// wide and faint below high points; none for points far below the ground. size: of the surface.
GroundShadow ground_shadow(std::span<const glm::vec3> points, float size);

/// The ground plane, in world units.
struct ShadowStyle {
  Point center{0, 0, 0};  ///< a point of the ground, near the model
  int up = 1;             ///< axis that points up: 0 x, 1 y, 2 z
  double size = 1;        ///< model size: shadows fade with height relative to it

  friend bool operator==(const ShadowStyle&, const ShadowStyle&) = default;
};

/// Not thread-safe. Copies all spans. Takes well under a millisecond a frame, whatever the model's size.
class ShadowLayer {
public:
  explicit ShadowLayer(const Gl& gl);

  /// New topology with its positions. Throws base::Error for invalid vertex indices.
  void set_triangles(std::span<const Triangle> triangles, std::span<const Point> positions);
  /// One per vertex; call every frame. Positions are relative to origin.
  void set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin);
  void set_positions(std::span<const Point> positions);

  /// Draw after the surface and before the grid: uses the depth test, writes no depth. Invisible from below.
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
  std::vector<glm::vec3> points_, over_ground_;  // relative to origin_; on the ground, height last
  Point origin_{0, 0, 0};
  ShadowStyle cast_on_;
  GroundShadow shadow_;
  bool moved_ = false;
};

}  // namespace viete::render
