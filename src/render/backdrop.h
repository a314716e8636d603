// Draws the background gradient and the ground grid.
#pragma once

#include "render/gl.h"
#include "render/program.h"
#include "render/view.h"

namespace viete::render {

/// Draws a vertical gradient over the whole target, with dithering against visible steps. Draw it first: it
/// ignores depth.
class Backdrop {
public:
  explicit Backdrop(const Gl& gl);
  void draw(const Theme& theme) const;

private:
  const Gl& gl_;
  Program program_;
  VertexArray vertex_array_;
};

/// Place and cell size of the ground grid, in world units. Lines are aligned to the world origin.
struct GridStyle {
  Point center{0, 0, 0};  ///< a ground point below the model, where the grid is strongest
  double cell = 1;        ///< distance of fine lines; every tenth line is stronger
  double radius = 10;     ///< distance from center at which the grid becomes invisible
  int up = 1;             ///< the up axis: 0 x, 1 y, 2 z

  friend bool operator==(const GridStyle&, const GridStyle&) = default;
};

/// Draws a plane of fine lines of constant width, which fade with the distance and at flat viewing angles.
/// Draw it after the surface: it tests the depth but does not write it.
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
