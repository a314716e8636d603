// A soft shadow of the model on the ground, computed without the graphics card.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/gl.h"
#include "render/program.h"
#include "render/surface_layer.h"
#include "render/view.h"

namespace viete::render {

/// Places spread evenly over triangles as they were at first: few enough to be moved in every frame, whatever
/// the size of the surface, and enough for large triangles.
class SpreadPoints {
public:
  struct Place {
    std::array<std::uint32_t, 3> corners;
    std::array<float, 3> shares;  ///< of the corners; their sum is 1
  };

  SpreadPoints() = default;
  /// Triangles must name vertices that are there.
  SpreadPoints(std::span<const Triangle> triangles, std::span<const Point> positions);

  std::span<const Place> places() const { return places_; }

private:
  std::vector<Place> places_;
};

/// Darkness of cells of the ground, row by row.
struct GroundShadow {
  static constexpr int square = 6;  ///< cells along a side of the squares that are drawn
  int width = 0, height = 0;        ///< in cells, whole squares; 0: there is none
  glm::vec2 low{0, 0};              ///< the corner of the first cell
  float cell = 1;
  std::vector<std::uint8_t> darkness;                 ///< 0 to 255; 0 along the edges
  std::vector<std::array<std::uint32_t, 2>> squares;  ///< columns and rows of those that are not all light
};

/// Of points whose x and y lie on the ground and whose z is the height above it. Dark and sharp where they
/// touch it, wide and faint below what is high; nothing of what is far below it. size: of the surface.
GroundShadow ground_shadow(std::span<const glm::vec3> points, float size);

/// Where the ground lies, in the caller's world.
struct ShadowStyle {
  Point center{0, 0, 0};  ///< a point of the ground, near the model
  int up = 1;             ///< axis that points up: 0 x, 1 y, 2 z
  double size = 1;        ///< of the model: shadows fade with heights of some share of it

  friend bool operator==(const ShadowStyle&, const ShadowStyle&) = default;
};

/// Not thread-safe. All spans are copied. Takes well under a millisecond a frame, whatever the model's size.
class ShadowLayer {
public:
  explicit ShadowLayer(const Gl& gl);

  /// New topology, with its positions. Triangles that name a missing vertex throw base::Error.
  void set_triangles(std::span<const Triangle> triangles, std::span<const Point> positions);
  /// Every frame; one per vertex, positions relative to origin.
  void set_vertices(std::span<const SurfaceVertex> vertices, const Point& origin);
  void set_positions(std::span<const Point> positions);

  /// After the surface, before the grid: tested against depth, and writes none. Nothing is seen from below.
  void draw(const View& view, const Theme& theme, const ShadowStyle& style);

private:
  void cast(const ShadowStyle& style);

  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
  Texture darkness_;
  BufferTexture squares_;
  SpreadPoints spread_;
  std::size_t vertex_count_ = 0;
  std::vector<glm::vec3> points_, over_ground_;  // relative to origin_; to the ground, height last
  Point origin_{0, 0, 0};
  ShadowStyle cast_on_;
  GroundShadow shadow_;
  bool moved_ = false;
};

}  // namespace viete::render
