// Background gradient and ground grid.
#pragma once

#include "render/gl.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

/// A vertical gradient over the whole target, dithered against banding. Draw first; ignores depth.
class Backdrop {
public:
  explicit Backdrop(const Gl& gl);
  void draw(const Theme& theme) const;

private:
  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
};

/// Place and cell size of the ground grid, in world units.
struct GridStyle {
  Point center{0, 0, 0};  ///< a ground point below the model, from which the grid fades out; lines
                          ///< are aligned to the world origin
  double cell = 1;        ///< distance of fine lines; every tenth one is stronger
  double radius = 10;     ///< distance from center at which the grid has faded out
  int up = 1;             ///< axis that points up: 0 x, 1 y, 2 z

  friend bool operator==(const GridStyle&, const GridStyle&) = default;
};

/// A plane of fine lines of constant width, faded by distance and at grazing angles. Draw after the surface:
/// uses the depth test but writes no depth.
class Grid {
public:
  explicit Grid(const Gl& gl);
  void draw(const View& view, const Theme& theme, const GridStyle& style) const;

private:
  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
};

}  // namespace viete::render
