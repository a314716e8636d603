// Draws the background gradient and the ground grid.
#pragma once

#include "render/gl.h"
#include "render/view.h"

namespace viete::render {

/// Draws a vertical gradient over the whole target. Dithering hides the steps between colours. Does not use
/// the depth: draw the backdrop first.
class Backdrop {
public:
  explicit Backdrop(const Gl& gl);
  void draw(const Theme& theme) const;

private:
  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
};

/// The position and cell size of the ground grid, in world units. Grid lines are aligned to the world origin.
struct GridStyle {
  Point center{0, 0, 0};  ///< a point on the ground below the model; the grid is strongest here
  double cell = 1;        ///< the distance between fine lines; every tenth line is stronger
  double radius = 10;     ///< the distance from `center` at which the grid becomes invisible
  int up = 1;             ///< the up axis: 0 x, 1 y, 2 z
  bool down = false;      ///< true: the axis points down

  friend bool operator==(const GridStyle&, const GridStyle&) = default;
};

/// Draws fine lines of constant width on the ground. Lines fade with the distance and at flat viewing angles.
/// Draw the surface first, so that it can hide the grid. The grid does not write depth.
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
