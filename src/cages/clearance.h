// Computes distances to a model on a grid.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"

namespace viete::cages {

using mesh::Point, mesh::Vec3;

using Index3 = std::array<std::size_t, 3>;

/// Calls visit(i, j, k) for all indices from `low` to `high`, including `high`.
template <class Visit>
void for_box(const Index3& low, const Index3& high, Visit&& visit) {
  for (std::size_t k = low[2]; k <= high[2]; ++k)
    for (std::size_t j = low[1]; j <= high[1]; ++j) {
      for (std::size_t i = low[0]; i <= high[0]; ++i) visit(i, j, k);
    }
}

struct Grid {
  Point origin{};
  double step = 1;
  Index3 size{};          ///< the number of nodes along each axis
  bool mirrored = false;  ///< if true, the grid covers only x >= 0

  std::size_t node_count() const { return size[0] * size[1] * size[2]; }
  std::size_t index(std::size_t i, std::size_t j, std::size_t k) const {
    return (k * size[1] + j) * size[0] + i;
  }
  Point place(std::size_t i, std::size_t j, std::size_t k) const {
    return origin + step * Vec3{static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)};
  }
  Index3 node(std::size_t index) const {
    return {index % size[0], index / size[0] % size[1], index / size[0] / size[1]};
  }
  Point place(std::size_t index) const {
    const auto [i, j, k] = node(index);
    return place(i, j, k);
  }
};

/// Returns a grid around a box, with `padding` on each side and about `cells` cells along the longest side.
/// If `mirrored` is true, the box must be symmetric about x = 0.
Grid grid_around(const mesh::Bounds& box, std::size_t cells, double padding, bool mirrored);

struct Closing {
  double offset = 0;  ///< the distance from the model to the extracted surface
  double gap = 0;     ///< closes gaps that are narrower than twice this value
};

/// The clearance of points: the distance to the model, interpolated on a grid. In closed gaps, the clearance
/// is smaller than the distance. Inside the model and enclosed cavities, it is negative. Thread-safe.
class Clearance {
public:
  Clearance(const Grid& grid, std::vector<float> values);

  const Grid& grid() const { return grid_; }
  float at_node(std::size_t index) const { return values_[index]; }

  /// Returns the clearance. Outside of the grid, returns a lower bound of the distance to the model.
  double at(const Point& p) const { return at(in_steps(p)); }

  /// True if the clearance is at least `margin` at all samples on the triangle. The samples are about a grid
  /// step apart, and farther apart where the clearance is large. Does not test the corners.
  bool is_clear(const mesh::Corners& t, double margin) const;

private:
  using Place = mesh::Vec3f;  // a position in grid steps from the origin
  Place in_steps(const Point& p) const;
  float at(const Place& p) const;
  bool is_clear(const Place& a, const Place& b, const Place& c, float radius, float margin) const;

  Grid grid_;
  std::array<float, 3> last_;  // the largest index of a node along each axis
  std::vector<float> values_;
};

struct Obstacle {
  const mesh::TriangleTree& tree;  ///< the triangles of the model
  bool closed = false;             ///< if false, uses winding numbers to find the inside
};

/// Computes the clearance. Far from the model, the values are lower bounds. The result does not depend on the
/// pool. Throws base::Cancelled.
Clearance clearance(const Obstacle& model, const Grid& grid, const Closing& closing, base::WorkerPool& pool,
                    base::Progress* progress = nullptr);

/// Adds balls around the points `centers` to the model. The balls represent details that are smaller than a
/// grid step. Updates only nodes that are nearer than `most` to a ball.
Clearance with_balls(const Clearance& clearance, std::span<const Point> centers, double radius, double most);

}  // namespace viete::cages
