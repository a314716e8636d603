#include "mesh/surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/encoding.h"

namespace viete::mesh {

std::vector<std::uint32_t> first_numbers(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

std::span<const Triangle> clipped_of(const Surface& surface, std::size_t polygon) {
  const auto first = [](const Triangle& t) { return t[0]; };
  const auto begin = std::ranges::lower_bound(surface.clipped, surface.polygon_starts[polygon], {}, first);
  return {begin, std::ranges::lower_bound(surface.clipped, surface.polygon_starts[polygon + 1], {}, first)};
}

bool same_faces(const Surface& a, const Surface& b) {
  return a.triangles == b.triangles || (a.corners == b.corners && a.polygon_starts == b.polygon_starts);
}

Surface from_triangles(std::vector<Point> positions, const std::vector<Triangle>& triangles) {
  Surface surface;
  surface.positions = std::move(positions);
  surface.triangles = triangles;
  surface.corners.reserve(3 * triangles.size());
  surface.polygon_starts.reserve(triangles.size() + 1);
  surface.polygon_starts.push_back(0);
  for (const Triangle& t : triangles) {
    surface.corners.insert(surface.corners.end(), t.begin(), t.end());
    surface.polygon_starts.push_back(static_cast<std::uint32_t>(surface.corners.size()));
  }
  surface.triangle_polygon = first_numbers(triangles.size());
  return surface;
}

Point Bounds::center() const {
  return {0.5 * low[0] + 0.5 * high[0], 0.5 * low[1] + 0.5 * high[1], 0.5 * low[2] + 0.5 * high[2]};
}

double Bounds::diagonal() const {
  return std::hypot(high[0] - low[0], high[1] - low[1], high[2] - low[2]);
}

Bounds bounds(std::span<const Point> positions) {
  if (positions.empty()) return {};
  Bounds box{positions[0], positions[0]};
  for (const Point& p : positions) extend(box, p);
  return box;
}

Bounds bounds(std::span<const Point> positions, std::span<const std::uint32_t> some) {
  if (some.empty()) return {};
  Bounds box{positions[some[0]], positions[some[0]]};
  for (const std::uint32_t v : some) extend(box, positions[v]);
  return box;
}

Bounds used_bounds(const Surface& surface) {
  return surface.corners.empty() ? bounds(surface.positions) : bounds(surface.positions, surface.corners);
}

namespace {

// Returns the area centroid. Scales lengths by `unit`, because coordinates can be up to largest_coordinate.
Point area_center(const Surface& surface, const Point& origin, double unit) {
  Vec3 sum{0, 0, 0};
  double total = 0;
  for (const auto& [a, b, c] : surface.triangles) {
    const auto at = [&](std::uint32_t v) { return (1 / unit) * (surface.positions[v] - origin); };
    const double area = norm(cross(at(b) - at(a), at(c) - at(a)));
    sum = sum + (area / 3) * (at(a) + at(b) + at(c));
    total += area;
  }
  return total > 0 ? origin + (unit / total) * sum : origin;
}

Point mean_of(std::span<const Point> positions, const std::vector<std::uint32_t>& some, const Point& origin) {
  Vec3 sum{0, 0, 0};
  for (const auto v : some) sum = sum + (1.0 / static_cast<double>(some.size())) * (positions[v] - origin);
  return origin + sum;
}

}  // namespace

double used_size(const Surface& surface) {
  const Bounds box = used_bounds(surface);
  const double unit = box.diagonal();
  if (!(unit > 0)) return 0;
  std::vector<bool> is_used(surface.positions.size(), surface.corners.empty());
  for (const auto v : surface.corners) is_used[v] = true;
  std::vector<std::uint32_t> used = first_numbers(is_used.size());
  std::erase_if(used, [&](std::uint32_t v) { return !is_used[v]; });
  const Point center = area_center(surface, mean_of(surface.positions, used, box.center()), unit);
  double farthest = 0;
  for (const auto v : used) farthest = std::max(farthest, norm(surface.positions[v] - center));
  return 2 * farthest;
}

std::uint64_t content_key(const Surface& surface) {
  base::Checksum sum;
  sum.add(surface.positions.data(), surface.positions.size() * sizeof(Point));
  sum.add(surface.triangles.data(), surface.triangles.size() * sizeof(Triangle));
  return sum.value();
}

}  // namespace viete::mesh
