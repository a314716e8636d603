// Draws points, lines and translucent faces over the scene; points and lines have a constant size on screen.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/gl.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

/// Appearance of one point.
struct Disc {
  glm::vec4 color{1, 1, 1, 1};  ///< as displayed, with opacity
  float radius = 3.0F;          ///< logical pixels, without the outline; 0 draws nothing
  bool ring = false;            ///< draws a thin ring around the disc, for the hovered point

  friend bool operator==(const Disc&, const Disc&) = default;
};

struct DiscStyle {
  glm::vec3 outline{0, 0, 0};  ///< colour of the thin edge (theme.outline)
  glm::vec3 ring{1, 1, 1};     ///< colour of rings (theme.hover)
  /// Opacity factor of hidden discs; rings keep their opacity. A point less than 2.5 radii behind a face
  /// counts as visible, so that inclined faces around the point do not cut its disc.
  float hidden_opacity = 0.3F;
};

/// Not thread-safe. Copies all spans. draw() throws base::Error if the numbers of discs and positions differ.
class DiscLayer {
public:
  explicit DiscLayer(const Gl& gl);

  /// Sets the appearance of each point. Later points cover earlier points.
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
  float width = 1.5F;            ///< logical pixels
  float opacity = 1;             ///< of visible parts
  float hidden_opacity = 0.25F;  ///< hidden parts have the opacity `opacity` times this factor
  glm::vec4 halo{0};             ///< colour and opacity of a thin edge around visible parts
};

/// Not thread-safe. Copies all spans. Throws base::Error for wrong sizes or point indices.
class LineLayer {
public:
  explicit LineLayer(const Gl& gl);

  /// Sets the segments as pairs of point indices. Discards positions and makes all lines white.
  void set_segments(std::span<const Segment> segments, std::size_t point_count);
  /// Sets the position of each point; fast enough for every frame.
  void set_positions(std::span<const Point> positions);
  /// Sets a colour for each segment, as displayed, with opacity.
  void set_colors(std::span<const glm::vec4> colors);
  /// Sets a colour for each end of each segment. Colours are interpolated between the ends.
  void set_end_colors(std::span<const glm::vec4> colors);
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
  float opacity = 0.05F;     ///< of faces seen from the front
  float rim = 0.10F;         ///< additional opacity of faces seen from the side
  bool occlude = true;       ///< writes depth, so that lines and discs behind faces are drawn as hidden
};

/// Not thread-safe. Copies all spans. Throws base::Error for wrong sizes or point indices.
class FaceLayer {
public:
  explicit FaceLayer(const Gl& gl);

  /// Sets the triangles and discards positions.
  void set_triangles(std::span<const Triangle> triangles, std::size_t point_count);
  /// Sets the position of each point; fast enough for every frame.
  void set_positions(std::span<const Point> positions);
  /// Draws nothing before set_positions().
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
