// Line segments of constant width on screen, anti-aliased, faint where something hides them.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/gl_objects.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

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

}  // namespace viete::render
