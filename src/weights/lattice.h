// A lattice in a cage: stitched in place of a model without faces.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"
#include "pose/cage.h"
#include "weights/surface_proxy.h"

namespace viete::weights {

/// The points of a cubic grid that are inside the cage or near it, about 6,000. Squares of the grid connect
/// them. Parts of the cage that are a few cells apart are not connected. Depends only on the cage: a
/// symmetric cage has a symmetric lattice. Thread-safe after construction.
class Lattice {
public:
  /// The result does not depend on the number of threads.
  Lattice(const pose::Cage& cage, base::WorkerPool& pool);

  /// The points. A square is four triangles, two for each diagonal, so that no direction differs.
  mesh::Surface surface() const;

  using Term = SurfaceProxy::Term;
  /// Writes the terms of the value at p: products of quadratic B-splines of the coordinates, divided by their
  /// sum. The value and its first derivatives are continuous in the cage. Far from all points, there are no
  /// terms.
  void terms(const mesh::Point& p, std::vector<Term>& terms) const;

private:
  std::size_t keep(const mesh::TriangleTree& cage, base::WorkerPool& pool);
  std::size_t coordinate(std::size_t place, std::size_t axis) const {
    return place / step(axis) % size_[axis];
  }
  std::size_t step(std::size_t axis) const {
    return axis == 0 ? 1 : axis == 1 ? size_[0] : size_[0] * size_[1];
  }
  mesh::Point point(std::size_t place) const;

  mesh::Point low_{};  // the first point of the grid
  double cell_ = 0;
  std::array<std::size_t, 3> size_{};
  std::vector<std::uint32_t> number_;  // of each place in the grid, or none
};

}  // namespace viete::weights
