// The surface at a given clearance, as triangles.
#pragma once

#include <vector>

#include "cages/clearance.h"
#include "mesh/surface.h"

namespace viete::cages {

/// Triangles that work goes on with: they refer to positions by number.
struct Shell {
  std::vector<Point> positions;
  std::vector<mesh::Triangle> triangles;
};

/// The triangles between nodes above the level and others, counter-clockwise from where the clearance is
/// larger. An oriented manifold: closed, or, on a mirrored grid, ending in the plane x = 0, with no vertex
/// beyond. Marching cubes (Lorensen and Cline 1987) whose loops are traced along the faces of each cell: what
/// is below the level is joined across a face where both ways are possible, so that neighbours agree. About
/// two triangles for each cell that the surface runs through.
Shell extract(const Clearance& clearance, double level);

}  // namespace viete::cages
