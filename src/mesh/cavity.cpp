#include "mesh/cavity.h"

#include <algorithm>
#include <cmath>

#include "mesh/adjacency.h"

namespace viete::mesh {

namespace {

// Lists each end of an inner edge twice.
Adjacency neighbours(std::span<const Triangle> triangles, std::size_t vertices) {
  return make_adjacency(vertices, [&](const auto& add) {
    for (const auto& [a, b, c] : triangles) add(a, b), add(a, c), add(b, c), add(b, a), add(c, a), add(c, b);
  });
}

// In float, relative to the first point: the precision of a shade of grey is enough.
Vec3f rounded(const Point& a) {
  return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
}

template <class Get>
float mean_around(const Adjacency& around, std::size_t v, Get get) {
  float sum = 0;
  for (const std::uint32_t other : around.of(v)) sum += get(other);
  const auto count = static_cast<float>(around.of(v).size());
  return count > 0 ? sum / count : sum;
}

/// Mean sine of the angle by which the neighbours rise over the tangent plane: > 0 in a hollow.
float hollowness(const Adjacency& around, std::span<const Vec3f> points, std::size_t v, const Vec3f& normal) {
  return mean_around(around, v, [&](std::uint32_t other) {
    const Vec3f edge = points[other] - points[v];
    const float length = norm(edge);
    return length > 0 ? dot(edge, normal) / length : 0.0F;
  });
}

/// One step of averaging with the neighbours.
void smooth(const Adjacency& around, std::vector<float>& values, std::vector<float>& scratch) {
  scratch = values;
  for (std::size_t v = 0; v < values.size(); ++v) {
    if (around.of(v).empty()) continue;
    const float mean = mean_around(around, v, [&](std::uint32_t other) { return scratch[other]; });
    values[v] = 0.5F * scratch[v] + 0.5F * mean;
  }
}

std::vector<Vec3f> relative_points(std::span<const Point> positions) {
  std::vector<Vec3f> points(positions.size());
  for (std::size_t v = 0; v < points.size(); ++v) points[v] = rounded(positions[v] - positions[0]);
  return points;
}

}  // namespace

std::vector<float> bake_cavity(std::span<const Point> positions, std::span<const Point> normals,
                               std::span<const Triangle> triangles, int levels) {
  const Adjacency around = neighbours(triangles, positions.size());
  const std::vector<Vec3f> points = relative_points(positions);

  std::vector<float> hollow(positions.size()), scratch;
  for (std::size_t v = 0; v < points.size(); ++v)
    hollow[v] = hollowness(around, points, v, rounded(normals[v]));
  std::vector<float> sum(positions.size(), 0.0F);
  for (int level = 0; level < levels; ++level) {
    for (int step = 0; step < 1 << level; ++step) smooth(around, hollow, scratch);
    for (std::size_t v = 0; v < sum.size(); ++v) sum[v] += hollow[v];
  }
  for (float& value : sum) value = 1 - std::clamp(2.0F * value, 0.0F, 1.0F);
  return sum;
}

}  // namespace viete::mesh
