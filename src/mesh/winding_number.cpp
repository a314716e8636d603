#include "mesh/winding_number.h"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <numeric>

#include "mesh/triangle.h"
#include "mesh/triangle_tree.h"

namespace viete::mesh {

namespace {

// Transforms the surface to a diagonal of 1. This keeps products in the range of double.
struct ToUnit {
  Point center;
  double scale;

  explicit ToUnit(const Surface& surface) {
    const Bounds box = used_bounds(surface);
    center = box.center();
    scale = box.diagonal() > 0 ? 1 / box.diagonal() : 1;
  }
  Point operator()(const Point& p) const { return scale * (p - center); }
};

double winding_number(std::span<const Point> positions, std::span<const Triangle> triangles, const Point& p) {
  double halves = 0;
  for (const auto& [a, b, c] : triangles)
    halves += half_solid_angle(positions[a] - p, positions[b] - p, positions[c] - p);
  return halves / (2 * std::numbers::pi);
}

}  // namespace

double winding_number(const Surface& surface, const Point& p) {
  const ToUnit unit(surface);
  std::vector<Point> positions;
  for (const Point& q : surface.positions) positions.push_back(unit(q));
  return winding_number(positions, surface.triangles, unit(p));
}

std::vector<std::uint32_t> points_outside(const Surface& cage, std::span<const Point> positions,
                                          base::WorkerPool* pool, base::Progress* progress) {
  std::vector<std::uint32_t> found(positions.size());
  std::iota(found.begin(), found.end(), 0u);
  if (cage.triangles.empty()) return found;
  const ToUnit unit(cage);
  std::vector<Point> corners;
  for (const Point& p : cage.positions) corners.push_back(unit(p));
  const TriangleTree tree(corners, cage.triangles);
  const auto is_outside = [&](const Point& at) {
    constexpr double doubt = 0.25;  // larger than the error of the tree's winding number
    const Point p = unit(at);
    double number = std::abs(tree.winding_number(p));
    if (std::abs(number - 0.5) < doubt) number = std::abs(winding_number(corners, cage.triangles, p));
    return number < 0.5 && tree.nearest(p).squared_distance > 1e-18;
  };
  std::vector<char> outside(positions.size(), 0);
  const auto decide = [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      if (progress && i % 256 == 0)
        progress->report(static_cast<double>(i) / static_cast<double>(positions.size()));
      outside[i] = is_outside(positions[i]);
    }
  };
  if (pool) {
    pool->for_blocks(positions.size(), 256, decide);
  } else {
    decide(0, positions.size());
  }
  std::erase_if(found, [&](std::uint32_t i) { return !outside[i]; });
  return found;
}

}  // namespace viete::mesh
