#include "cages/enclose.h"

#include <algorithm>
#include <cmath>

#include "mesh/summary.h"
#include "mesh/triangle_tree.h"
#include "mesh/triangulation.h"

namespace viete::cages {

namespace {

using mesh::Point, mesh::Surface, mesh::Vec3;

// Returns a displacement for each cage vertex, to move the cage outward past the points `outside`. `split`
// has the triangles of the cage.
std::vector<Vec3> offsets_outward(const Surface& cage, const Surface& split,
                                  const std::vector<Point>& outside, double margin) {
  const mesh::TriangleTree tree(split.positions, split.triangles);
  std::vector<Vec3> offsets(cage.positions.size(), {0, 0, 0});
  std::vector<double> farthest(cage.positions.size(), 0);
  const double side = mesh::summarize(cage).volume < 0 ? -1 : 1;  // -1 if the normals point inward
  for (const Point& p : outside) {
    const auto nearest = tree.nearest(p);
    const auto [a, b, c] = mesh::corners_of(split.positions, split.triangles[nearest.triangle]);
    const Vec3 area = mesh::cross(b - a, c - a);
    const double length = mesh::norm(area);
    if (!(length > 0)) continue;
    const double distance = std::sqrt(nearest.squared_distance) + margin;
    for (const auto v : cage.polygon(split.triangle_polygon[nearest.triangle])) {
      if (distance <= farthest[v]) continue;
      farthest[v] = distance;
      offsets[v] = (side * distance / length) * area;
    }
  }
  return offsets;
}

}  // namespace

Fitted fitted_to_box(const Surface& cage, const Surface& model, double margin) {
  const mesh::Bounds from = mesh::used_bounds(cage), to = mesh::used_bounds(model);
  const double more = 2 * margin * to.diagonal();
  double scale = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const double extent = from.high[k] - from.low[k];
    if (extent > 1e-6 * from.diagonal()) scale = std::max(scale, (to.high[k] - to.low[k] + more) / extent);
  }
  Fitted fitted{cage.positions, scale};
  for (Point& p : fitted.positions) p = to.center() + scale * (p - from.center());
  return fitted;
}

Enclosing enclose(const Surface& cage, const Surface& model, double margin) {
  constexpr int most_rounds = 40;
  const double distance = margin * mesh::used_bounds(model).diagonal();
  Surface moved = cage;
  // Later rounds test only vertices that were outside. If none is left, the next round tests all vertices.
  std::vector<Point> asked = model.positions;
  for (int round = 0;; ++round) {
    const Surface split = mesh::split_at_centers(moved).surface;
    const auto outside = mesh::points_outside(split, asked);
    const bool all = asked.size() == model.positions.size();
    if (all && (outside.empty() || round >= most_rounds)) return {std::move(moved.positions), outside.size()};
    if (outside.empty() || round >= most_rounds) {
      asked = model.positions;
      continue;
    }
    std::vector<Point> points = mesh::picked<Point>(asked, outside);
    const auto offsets = offsets_outward(moved, split, points, distance);
    for (std::size_t v = 0; v < offsets.size(); ++v) moved.positions[v] = moved.positions[v] + offsets[v];
    asked = std::move(points);
  }
}

}  // namespace viete::cages
