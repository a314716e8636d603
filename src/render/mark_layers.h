// Points, lines and translucent faces drawn over the scene, of constant size on screen.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gl.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

/// How one point looks.
struct Disc {
  glm::vec4 color{1, 1, 1, 1};  ///< as displayed, alpha 0 to 1
  float radius = 3.0F;          ///< logical pixels, without the outline; 0 draws nothing
  bool ring = false;            ///< a thin ring around it, for the point under the cursor

  friend bool operator==(const Disc&, const Disc&) = default;
};

struct DiscStyle {
  glm::vec3 outline{0, 0, 0};  ///< colour of the thin edge (theme.outline)
  glm::vec3 ring{1, 1, 1};     ///< colour of rings (theme.hover)
  float opacity = 1;
  /// Of discs behind something, as a factor on opacity; rings are as strong as in front. A point less
  /// than 2.5 radii behind a face counts as in front of it, so that the slanted faces around it do not cut
  /// into its disc.
  float hidden_opacity = 0.3F;
};

/// Not thread-safe. All spans are copied. Throws base::Error if discs and positions differ in number when
/// drawn.
class DiscLayer {
public:
  explicit DiscLayer(const Gl& gl);

  /// Looks, when a selection or the hovered point changes: one per point. Later points lie over earlier ones.
  void set_discs(std::span<const Disc> discs);
  /// Every frame; one per point.
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
  float opacity = 1;             ///< of the visible part
  float hidden_opacity = 0.25F;  ///< of the hidden part, as a factor on opacity
  glm::vec4 halo{0};  ///< colour of a thin edge around the visible part, so that it stands out from
                      ///< what lies behind; opacity 0: none
};

/// Not thread-safe. All spans are copied. Throws base::Error if a size does not fit or a segment names a
/// missing point.
class LineLayer {
public:
  explicit LineLayer(const Gl& gl);

  /// New topology: pairs of point numbers. Forgets positions and colours.
  void set_segments(std::span<const Segment> segments, std::size_t point_count);
  /// Every frame; size equal to the point count.
  void set_positions(std::span<const Point> positions);
  /// One colour per segment as displayed, alpha 0 to 1. Until then lines are white.
  void set_colors(std::span<const glm::vec4> colors);
  /// Two per segment: of its ends, and between them what lies between.
  void set_end_colors(std::span<const glm::vec4> colors);
  /// The same colour for all.
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
