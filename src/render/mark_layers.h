// Points, lines and translucent faces drawn over the scene, with constant size on screen.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gl.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

/// Appearance of one point.
struct Disc {
  glm::vec4 color{1, 1, 1, 1};  ///< as displayed, alpha 0 to 1
  float radius = 3.0F;          ///< logical pixels, without the outline; 0 draws nothing
  bool ring = false;            ///< a thin ring around it, for the hovered point

  friend bool operator==(const Disc&, const Disc&) = default;
};

struct DiscStyle {
  glm::vec3 outline{0, 0, 0};  ///< colour of the thin edge (theme.outline)
  glm::vec3 ring{1, 1, 1};     ///< colour of rings (theme.hover)
  float opacity = 1;
  /// Opacity factor of discs behind something; rings are not faded. A point less than 2.5 radii behind a face
  /// counts as in front, so that the slanted faces around it do not cut into its disc.
  float hidden_opacity = 0.3F;
};

/// Not thread-safe. Copies all spans. draw() throws base::Error if the numbers of discs and positions differ.
class DiscLayer {
public:
  explicit DiscLayer(const Gl& gl);

  /// Appearance, one per point; call when the selection or the hovered point changes. Later points cover
  /// earlier ones.
  void set_discs(std::span<const Disc> discs);
  /// One per point; call every frame.
  void set_positions(std::span<const Point> positions);
  void draw(const View& view, const DiscStyle& style) const;

private:
  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
  BufferTexture points_, looks_;
  std::size_t point_count_ = 0, disc_count_ = 0;
  Point origin_{0, 0, 0};
};

using Segment = std::array<std::uint32_t, 2>;

struct LineStyle {
  float width = 1.5F;            ///< logical pixels
  float opacity = 1;             ///< opacity of visible parts
  float hidden_opacity = 0.25F;  ///< factor on opacity for hidden parts
  glm::vec4 halo{0};             ///< colour of a thin edge around the visible part, which
                                 ///< separates it from the background; opacity 0: none
};

/// Not thread-safe. Copies all spans. Throws base::Error if sizes do not match or a segment uses an invalid
/// point index.
class LineLayer {
public:
  explicit LineLayer(const Gl& gl);

  /// New topology: pairs of point indices. Discards positions and colours.
  void set_segments(std::span<const Segment> segments, std::size_t point_count);
  /// One per point; call every frame.
  void set_positions(std::span<const Point> positions);
  /// One colour per segment as displayed, alpha 0 to 1. Until then lines are white.
  void set_colors(std::span<const glm::vec4> colors);
  /// Two colours per segment, one for each end, interpolated between.
  void set_end_colors(std::span<const glm::vec4> colors);
  /// One colour for all segments.
  void set_color(const glm::vec4& color);

  /// Draws nothing before set_positions().
  void draw(const View& view, const LineStyle& style) const;

private:
  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
  BufferTexture segments_, points_, colors_;
  std::size_t segment_count_ = 0, point_count_ = 0;
  Point origin_{0, 0, 0};
  bool has_positions_ = false;
};

struct FaceStyle {
  glm::vec3 color{1, 1, 1};  ///< as displayed
  float opacity = 0.05F;     ///< opacity of front-facing faces; 0: no tint
  float rim = 0.10F;         ///< added for faces seen edge-on
  bool occlude = true;  ///< writes depth after tinting, so that lines and discs behind faces appear faint
};

/// Not thread-safe. Copies all spans. Throws base::Error if sizes do not match or a triangle uses an invalid
/// point index.
class FaceLayer {
public:
  explicit FaceLayer(const Gl& gl);

  /// New topology; discards positions.
  void set_triangles(std::span<const Triangle> triangles, std::size_t point_count);
  /// One per point; call every frame.
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
