// How far places around a model are from it: what the making of a cage asks thousands of times.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"

namespace viete::cages {

using mesh::Point, mesh::Vec3;

/// Nodes of a regular grid. With `mirrored`, the nodes i = 0 lie in the plane x = 0 and stand for both sides.
struct Grid {
  Point origin{};
  double step = 1;
  std::array<std::size_t, 3> size{};  ///< nodes along each axis
  bool mirrored = false;

  std::size_t node_count() const { return size[0] * size[1] * size[2]; }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (k * size[1] + j) * size[0] + i;
  }
  Point place(std::size_t i, std::size_t j, std::size_t k) const {
    return origin + step * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
  }
};

/// Nodes around a box: `padding` more on every side, and about `cells` along its longest side. With mirrored,
/// of the half x >= 0 of a box that is symmetric about x = 0.
Grid grid_around(const mesh::Bounds& box, std::size_t cells, double padding, bool mirrored);

struct Closing {
  double offset = 0;  ///< of the surface that is extracted from the model
  double gap = 0;     ///< gaps narrower than twice this are closed; 0: none
};

/// Distances to a model, sampled on a grid and interpolated: positive outside, about the distance to the
/// model; smaller in gaps that are closed, and negative within the model and in what it encloses.
/// Thread-safe.
class Clearance {
public:
  Clearance(const Grid& grid, std::vector<float> values);

  const Grid& grid() const { return grid_; }
  float at_node(std::size_t index) const { return values_[index]; }

  /// Anywhere. Outside of the grid, which holds the model: no more than the distance.
  double at(const Point& p) const;

  /// True if it is at least `margin` on all of the triangle, as far as samples a step apart tell; its
  /// corners are not looked at. A sample says the same of all around it that is nearer than what it has to
  /// spare.
  bool is_clear(const mesh::Corners& t, double margin) const;

private:
  using Place = mesh::Vec3f;  // in steps from the grid's origin
  Place in_steps(const Point& p) const;
  float at(const Place& p) const;
  bool is_clear(const Place& a, const Place& b, const Place& c, float radius, float margin) const;

  Grid grid_;
  std::array<float, 3> last_;  // node along each axis
  std::vector<float> values_;
};

/// What is asked about the model: its triangles in a tree, and whether it has holes, so that its inside is
/// told by winding numbers.
struct Obstacle {
  const mesh::TriangleTree& tree;
  bool closed = false;
};

/// Outside is what is reached from the border of the grid through places farther from the model than offset +
/// gap around which the model does not wind; all that is nearer to it than gap counts to it again, so that
/// gaps stay closed. Distances beyond a few steps more are lower bounds. Same bits for any pool. Throws
/// base::Cancelled.
Clearance clearance(const Obstacle& model, const Grid& grid, const Closing& closing, base::WorkerPool& pool,
                    base::Progress* progress = nullptr);

/// The same with balls around these points taken for parts of the model, where it is less than `most`: what
/// is smaller than the grid's step is not passed over then.
Clearance with_balls(const Clearance& clearance, std::span<const Point> centers, double radius, double most);

}  // namespace viete::cages
