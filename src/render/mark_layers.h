// Draws points, lines and translucent faces over the scene. Points and lines have a constant size on screen.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/gl.h"
#include "render/view.h"

namespace viete::render {

/// The appearance of one point.
struct Disc {
  glm::vec4 color{1, 1, 1, 1};  ///< as displayed, with opacity
  float radius = 3.0F;          ///< in logical pixels, without the outline; 0 draws nothing
  bool ring = false;            ///< draws a thin ring around the disc, for the hovered point

  friend bool operator==(const Disc&, const Disc&) = default;
};

struct DiscStyle {
  glm::vec3 outline{0, 0, 0};  ///< the colour of the thin edge (theme.outline)
  glm::vec3 ring{1, 1, 1};     ///< the colour of rings (theme.hover)
  /// A factor for the opacity of hidden discs, but not of rings. A point counts as hidden if it is at least
  /// 2.5 radii behind a face. With a smaller limit, faces around a visible point would cut its disc.
  float hidden_opacity = 0.3F;
};

/// Draws points. Copies all spans. draw() throws base::Error for different numbers of discs and positions.
class DiscLayer {
public:
  explicit DiscLayer(const Gl& gl);

  /// Sets the appearance of each point. A later point covers earlier points.
  void set_discs(std::span<const Disc> discs);
  /// Sets the position of each point; fast enough for every frame.
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
  float width = 1.5F;            ///< in logical pixels
  float opacity = 1;             ///< the opacity of visible parts
  float hidden_opacity = 0.25F;  ///< multiplies `opacity` for hidden parts
  glm::vec4 halo{0};             ///< the colour and opacity of a thin edge around visible parts
};

/// Draws lines. Copies all spans. Throws base::Error for wrong sizes or point indices. Not thread-safe.
class LineLayer {
public:
  explicit LineLayer(const Gl& gl);

  /// Sets the segments, as pairs of point indices. Discards the positions, and makes all lines white.
  void set_segments(std::span<const Segment> segments, std::size_t point_count);
  /// Sets the position of each point; fast enough for every frame.
  void set_positions(std::span<const Point> positions);
  /// Sets the colour of each segment, as displayed, with opacity.
  void set_colors(std::span<const glm::vec4> colors);
  /// Sets the colours of both ends of each segment. Colours are interpolated between the ends.
  void set_end_colors(std::span<const glm::vec4> colors);
  void set_color(const glm::vec4& color);

  /// If no positions are set, draws nothing.
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
  float opacity = 0.05F;     ///< the opacity of faces seen from the front
  float rim = 0.10F;         ///< the additional opacity of faces seen from the side
  bool occlude = true;       ///< writes depth; lines and discs behind the faces get their hidden opacity
};

/// Draws faces. Copies all spans. Throws base::Error for wrong sizes or point indices. Not thread-safe.
class FaceLayer {
public:
  explicit FaceLayer(const Gl& gl);

  /// Sets the triangles, and discards the positions.
  void set_triangles(std::span<const Triangle> triangles, std::size_t point_count);
  /// Sets the position of each point; fast enough for every frame.
  void set_positions(std::span<const Point> positions);
  /// If no positions are set, draws nothing.
  void draw(const View& view, const FaceStyle& style) const;

private:
  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
  Buffer indices_, points_;
  std::size_t triangle_count_ = 0, point_count_ = 0;
  Point origin_{0, 0, 0};
  bool has_positions_ = false;
};

}  // namespace viete::render
