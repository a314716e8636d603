#include "mesh/normals.h"

#include <algorithm>
#include <cmath>

#include "mesh/attributes.h"

namespace viete::mesh {

namespace {

// Squares leave the range of double long before lengths do: then the largest component is taken out first.
Point unit(Point sum) {
  double squared = squared_norm(sum);
  if (!(squared > 1e-280 && squared < 1e280)) {
    const double largest = largest_abs(sum);
    if (!(largest > 0 && std::isfinite(largest))) return {0, 0, 1};
    for (double& x : sum) x /= largest;
    squared = squared_norm(sum);
  }
  const double length = std::sqrt(squared);
  return {sum[0] / length, sum[1] / length, sum[2] / length};
}

// Two edges of a triangle, their unit normal, and the dual basis of the edges in its plane.
struct TriangleAxes {
  Point edge[2], normal, dual[2];
  double area = 0;  // twice the triangle's

  TriangleAxes(std::span<const Point> p, const Triangle& t) : edge{p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]} {
    const Point n = cross(edge[0], edge[1]);
    area = stable_norm(n);
    if (!(area > 0)) return;
    normal = (1 / area) * n;
    dual[0] = (1 / area) * cross(edge[1], normal);
    dual[1] = (1 / area) * cross(normal, edge[0]);
  }
};

// The triangle's map takes its edges along, and its normal by the factor that areas have in one direction.
struct TriangleMap {
  TriangleAxes from, to;
  double thickness = 1;

  TriangleMap(const Triangle& t, std::span<const Point> rest, std::span<const Point> posed)
      : from(rest, t), to(posed, t) {
    if (usable()) thickness = std::sqrt(to.area / from.area);
  }

  bool usable() const { return from.area > 0 && to.area > 0 && std::isfinite(to.area); }

  // Cofactors of the map, times the area at rest.
  Point of_normal(const Point& n) const {
    const Point in_plane = dot(n, from.edge[0]) * to.dual[0] + dot(n, from.edge[1]) * to.dual[1];
    return to.area * (dot(n, from.normal) * to.normal + thickness * in_plane);
  }

  Point of_tangent(const Point& t) const {
    const Point in_plane = dot(t, from.dual[0]) * to.edge[0] + dot(t, from.dual[1]) * to.edge[1];
    return to.area * (in_plane + thickness * dot(t, from.normal) * to.normal);
  }
};

bool has_moved(const Triangle& t, std::span<const Point> rest, std::span<const Point> posed) {
  return rest[t[0]] != posed[t[0]] || rest[t[1]] != posed[t[1]] || rest[t[2]] != posed[t[2]];
}

template <class Move>
std::vector<Vec3> carried(const Surface& rest, std::span<const Point> positions,
                          std::span<const Vec3> vectors, std::span<const std::uint32_t> of_corner,
                          const Move& move) {
  std::vector<Vec3> sums(vectors.size(), Vec3{0, 0, 0});
  std::vector<char> moved(vectors.size(), 0);
  for_each_triangle(rest, [&](const Triangle& triangle, const Triangle& corners) {
    const TriangleMap map(triangle, rest.positions, positions);
    const bool moves = has_moved(triangle, rest.positions, positions);
    for (const std::uint32_t c : corners) {
      const std::uint32_t i = of_corner[c];
      if (i == none) continue;
      moved[i] |= moves;
      if (map.usable()) sums[i] = sums[i] + move(map, vectors[i]);
    }
  });
  std::vector<Vec3> result(vectors.begin(), vectors.end());
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (moved[i] && squared_norm(sums[i]) > 0) result[i] = unit(sums[i]);
  }
  return result;
}

}  // namespace

Adjacency vertex_triangles(std::size_t vertices, std::span<const Triangle> triangles) {
  return make_adjacency(vertices, [&](const auto& add) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      for (const std::uint32_t v : triangles[t]) add(v, t);
    }
  });
}

void vertex_normals(std::span<const Point> positions, std::span<const Triangle> triangles,
                    const Adjacency& around, std::size_t begin, std::size_t end, std::span<Point> normals) {
  for (std::size_t v = begin; v < end; ++v) {
    Point sum{0, 0, 0};
    for (const std::uint32_t i : around.of(v)) {
      const Triangle& t = triangles[i];
      const Point &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
      sum = sum + cross(b - a, c - a);  // twice the area in length, so that the mean weighs by area
    }
    normals[v] = unit(sum);
  }
}

std::vector<Vec3> deformed_normals(const Surface& rest, std::span<const Point> positions,
                                   std::span<const Vec3> normals,
                                   std::span<const std::uint32_t> corner_normal) {
  return carried(rest, positions, normals, corner_normal, [](const TriangleMap& map, const Vec3& n) {
    return is_direction(n) ? map.of_normal(n) : map.to.area * map.to.normal;
  });
}

std::vector<Vec3> deformed_tangents(const Surface& rest, std::span<const Point> positions,
                                    std::span<const Vec3> tangents,
                                    std::span<const std::uint32_t> corner_tangent) {
  return carried(rest, positions, tangents, corner_tangent,
                 [](const TriangleMap& map, const Vec3& t) { return map.of_tangent(t); });
}

void keep_lengths(std::span<const Vec3> before, std::span<Vec3> now) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i] == before[i]) continue;
    const double length = stable_norm(before[i]);
    if (std::abs(length - 1) > 0.01 && is_direction(before[i])) now[i] = length * now[i];
  }
}

}  // namespace viete::mesh
