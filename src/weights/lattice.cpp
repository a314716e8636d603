#include "weights/lattice.h"

#include <algorithm>
#include <cmath>

namespace viete::weights {

namespace {

using mesh::none, mesh::Point;

constexpr double wanted_points = 6000;
constexpr double first_cells = 24, most_cells = 200;  // along the diagonal of the cage's box
constexpr int tries = 4;
// Points up to this number of cells from the cage are kept. Then a point in the cage has a kept neighbour.
constexpr double margin = 0.87;

}  // namespace

Lattice::Lattice(const pose::Cage& cage, base::WorkerPool& pool) {
  const auto& x = cage.elements.positions;
  const mesh::TriangleTree tree(x, cage.elements.triangles);
  const mesh::Bounds box = mesh::bounds(x);
  double next = box.diagonal() / first_cells;
  for (int i = 0; i < tries && std::abs(next - cell_) > 0.05 * cell_; ++i) {
    cell_ = next;
    for (std::size_t k = 0; k < 3; ++k) {
      const double half = std::ceil(0.5 * (box.high[k] - box.low[k]) / cell_ + margin) + 1;
      size_[k] = 2 * static_cast<std::size_t>(half) + 1;
      low_[k] = box.center()[k] - half * cell_;
    }
    const auto count = static_cast<double>(keep(tree, pool));
    next = std::max(cell_ * std::cbrt(count / wanted_points), box.diagonal() / most_cells);
  }
}

std::size_t Lattice::keep(const mesh::TriangleTree& cage, base::WorkerPool& pool) {
  number_.assign(size_[0] * size_[1] * size_[2], none);
  const double square = margin * cell_ * margin * cell_;
  pool.for_blocks(number_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point p = point(i);
      if (cage.nearest(p, square).triangle != none || std::abs(cage.winding_number(p)) >= 0.5) number_[i] = 0;
    }
  });
  std::uint32_t count = 0;
  for (auto& number : number_)
    if (number != none) number = count++;
  return count;
}

Point Lattice::point(std::size_t place) const {
  Point p = low_;
  for (std::size_t k = 0; k < 3; ++k) p[k] += cell_ * static_cast<double>(coordinate(place, k));
  return p;
}

mesh::Surface Lattice::surface() const {
  std::vector<Point> points;
  std::vector<mesh::Triangle> triangles;
  for (std::size_t i = 0; i < number_.size(); ++i) {
    if (number_[i] == none) continue;
    points.push_back(point(i));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      if (coordinate(i, u) + 1 == size_[u] || coordinate(i, v) + 1 == size_[v]) continue;
      const std::uint32_t a = number_[i], b = number_[i + step(u)], c = number_[i + step(u) + step(v)],
                          d = number_[i + step(v)];
      if (b == none || c == none || d == none) continue;
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}, {a, b, d}, {b, c, d}});
    }
  }
  return mesh::from_triangles(std::move(points), triangles);
}

void Lattice::terms(const Point& p, std::vector<Term>& terms) const {
  terms.clear();
  std::array<std::size_t, 3> first;                // of the three points that have an effect
  std::array<std::array<double, 3>, 3> factors{};  // [axis][point]
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = (p[k] - low_[k]) / cell_, nearest = std::round(x), t = x - nearest;
    if (!(nearest >= 1 && nearest + 2 <= static_cast<double>(size_[k]))) return;
    first[k] = static_cast<std::size_t>(nearest) - 1;
    factors[k] = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
  }
  double sum = 0;
  for (std::size_t i = 0; i < 27; ++i) {
    const std::array<std::size_t, 3> at{i % 3, i / 3 % 3, i / 9};
    std::size_t place = 0;
    double factor = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      place += (first[k] + at[k]) * step(k);
      factor *= factors[k][at[k]];
    }
    if (number_[place] == none || factor == 0) continue;
    terms.push_back({number_[place], factor});
    sum += factor;
  }
  for (Term& term : terms) term.factor /= sum;
}

}  // namespace viete::weights
