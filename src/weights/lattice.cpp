#include "weights/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "mesh/triangle_tree.h"

namespace viete::weights {

namespace {

using mesh::none, mesh::Point;

constexpr double wanted_points = 6000;
constexpr double first_cells = 24, most_cells = 200;  // along the diagonal of the cage's box
constexpr int tries = 4;
// Points up to this number of cells from the cage are kept. Then a point in the cage has a kept neighbour.
constexpr double margin = 0.87;

/// The grid of a cell size, with the numbers of the kept points.
class Grid {
public:
  Grid(const mesh::Bounds& box, double cell) : middle_(box.center()), cell_(cell) {
    for (std::size_t k = 0; k < 3; ++k) {
      half_[k] = static_cast<std::size_t>(std::ceil(0.5 * (box.high[k] - box.low[k]) / cell + margin));
      size_[k] = 2 * half_[k] + 1;
    }
    number_.assign(size_[0] * size_[1] * size_[2], none);
  }

  std::size_t keep(const mesh::TriangleTree& cage, base::WorkerPool& pool) {
    const double square = margin * cell_ * margin * cell_;
    pool.for_blocks(number_.size(), 256, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const Point p = point(i);
        if (cage.nearest(p, square).triangle != none || std::abs(cage.winding_number(p)) >= 0.5)
          number_[i] = 0;
      }
    });
    std::uint32_t count = 0;
    for (auto& number : number_)
      if (number != none) number = count++;
    return count;
  }

  mesh::Surface surface() const {
    std::vector<Point> points;
    std::vector<mesh::Triangle> triangles;
    const std::array<std::size_t, 3> steps{1, size_[0], size_[0] * size_[1]};
    for (std::size_t i = 0; i < number_.size(); ++i) {
      if (number_[i] == none) continue;
      points.push_back(point(i));
      for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
        if (at(i, u) + 1 == size_[u] || at(i, v) + 1 == size_[v]) continue;
        const std::uint32_t a = number_[i], b = number_[i + steps[u]], c = number_[i + steps[u] + steps[v]],
                            d = number_[i + steps[v]];
        if (b == none || c == none || d == none) continue;
        triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}, {a, b, d}, {b, c, d}});
      }
    }
    return mesh::from_triangles(std::move(points), triangles);
  }

private:
  std::size_t at(std::size_t i, std::size_t axis) const {
    return axis == 0 ? i % size_[0] : axis == 1 ? i / size_[0] % size_[1] : i / (size_[0] * size_[1]);
  }
  Point point(std::size_t i) const {
    Point p = middle_;
    for (std::size_t k = 0; k < 3; ++k)
      p[k] += cell_ * (static_cast<double>(at(i, k)) - static_cast<double>(half_[k]));
    return p;
  }

  Point middle_;
  double cell_;
  std::array<std::size_t, 3> half_, size_;
  std::vector<std::uint32_t> number_;
};

double spline(double x) {
  x = std::abs(x);
  return x < 0.5 ? 0.75 - x * x : x < 1.5 ? 0.5 * (1.5 - x) * (1.5 - x) : 0;
}

}  // namespace

Lattice make_lattice(const pose::Cage& cage, base::WorkerPool& pool) {
  const auto& x = cage.elements.positions;
  const mesh::TriangleTree tree(x, cage.elements.triangles);
  const mesh::Bounds box = mesh::bounds(x);
  double cell = box.diagonal() / first_cells;
  for (int i = 0;; ++i) {
    Grid grid(box, cell);
    const double count = static_cast<double>(grid.keep(tree, pool));
    const double next = std::max(cell * std::cbrt(count / wanted_points), box.diagonal() / most_cells);
    if (i == tries || std::abs(next / cell - 1) < 0.05) return {grid.surface(), cell};
    cell = next;
  }
}

double spline_weight(const Lattice& lattice, const Point& lattice_point, const Point& p) {
  double weight = 1;
  for (std::size_t k = 0; k < 3; ++k) weight *= spline((p[k] - lattice_point[k]) / lattice.cell);
  return weight;
}

}  // namespace viete::weights
