// A lattice in a cage: stitched in place of a model without faces.
#pragma once

#include "base/worker_pool.h"
#include "mesh/surface.h"
#include "pose/cage.h"

namespace viete::weights {

/// The points of a cubic grid that are inside the cage or near it. Points are connected by the squares of the
/// grid. Parts of the cage that are a few cells apart are not connected. Depends only on the cage.
struct Lattice {
  mesh::Surface surface;  ///< a square is four triangles, two for each diagonal, so that no direction differs
  double cell;            ///< the side of a square
};

/// Makes about 6,000 points. Cell and middle follow the cage's box, so that symmetric cages have symmetric
/// lattices. Results do not depend on the number of threads.
Lattice make_lattice(const pose::Cage& cage, base::WorkerPool& pool);

/// Returns the weight of a lattice point for the interpolation at p: a quadratic B-spline of each coordinate.
/// The weights of a complete grid sum to 1; their first derivatives are continuous.
double spline_weight(const Lattice& lattice, const mesh::Point& lattice_point, const mesh::Point& p);
/// Points farther than this number of cells have no weight.
inline constexpr double spline_reach = 2.6;  // 1.5 * sqrt(3)

}  // namespace viete::weights
