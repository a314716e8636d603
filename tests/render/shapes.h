// Shapes for the tests of lines, discs and faces.
#pragma once

#include "render/mark_layers.h"
#include "render/surface_layer.h"
#include "support/stage.h"

namespace viete::test {

inline render::Theme black_model() {
  render::Theme theme = render::dark_theme();
  theme.exposure = 0;
  return theme;
}

/// A wall at x >= 0, z = 1, drawn black so that only lines and discs are visible.
struct Wall {
  explicit Wall(const render::Gl& gl) : surface(gl) {
    const std::vector<Point> corners{{0, -9, 1}, {15, -9, 1}, {15, 9, 1}, {0, 9, 1}};
    const std::vector<render::Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    surface.set_triangles(triangles, 4);
    surface.set_positions(corners, std::vector<Point>(4, Point{0, 0, 1}));
  }
  void draw(const render::View& view) const { surface.draw(view, black_model(), {}); }
  render::SurfaceLayer surface;
};

inline void set_line(render::LineLayer& lines, const Point& a, const Point& b,
                     const glm::vec4& color = glm::vec4(1)) {
  const std::vector<render::Segment> segments{{0, 1}};
  lines.set_segments(segments, 2);
  lines.set_positions(std::vector<Point>{a, b});
  lines.set_color(color);
}

inline void set_disc(render::DiscLayer& discs, const Point& at, const render::Disc& disc) {
  discs.set_discs(std::vector<render::Disc>{disc});
  discs.set_positions(std::vector<Point>{at});
}

}  // namespace viete::test
