// A soft shadow of the model on the ground: what it stands on is seen, and how far above it the rest is.
#pragma once

#include <span>
#include <vector>

#include "render/gl_objects.h"
#include "render/ground_shadow.h"
#include "render/program.h"
#include "render/surface_layer.h"
#include "render/view.h"

namespace viete::render {

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
