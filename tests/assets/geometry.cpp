#include "geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace viete::test {
namespace {

using mesh::cross, mesh::dot, mesh::norm, mesh::Point;
using mesh::Surface;
using mesh::Triangle;

std::array<Point, 3> corners(const Surface& surface, const Triangle& triangle) {
  return {surface.positions[triangle[0]], surface.positions[triangle[1]], surface.positions[triangle[2]]};
}

double distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point edge = b - a, from = p - a;
  const double t = std::clamp(dot(from, edge) / dot(edge, edge), 0.0, 1.0);
  return norm(from - t * edge);
}

/// Is the foot of p's perpendicular inside all three edges?
bool above(const Point& p, const std::array<Point, 3>& c, const Point& normal) {
  for (int k = 0; k < 3; ++k) {
    if (dot(normal, cross(c[(k + 1) % 3] - c[k], p - c[k])) < 0) return false;
  }
  return true;
}

double distance_to_triangle(const Point& p, const std::array<Point, 3>& c) {
  const Point normal = cross(c[1] - c[0], c[2] - c[0]);
  if (above(p, c, normal)) return std::abs(dot(normal, p - c[0])) / norm(normal);
  return std::min({distance_to_segment(p, c[0], c[1]), distance_to_segment(p, c[1], c[2]),
                   distance_to_segment(p, c[2], c[0])});
}

/// Does the segment from a to b pass through the triangle?
bool passes(const Point& a, const Point& b, const std::array<Point, 3>& c) {
  const Point normal = cross(c[1] - c[0], c[2] - c[0]);
  const double from = dot(normal, a - c[0]), to = dot(normal, b - c[0]);
  if ((from > 0) == (to > 0)) return false;
  return above(a + (from / (from - to)) * (b - a), c, normal);
}

bool share_corner(const Triangle& a, const Triangle& b) {
  return std::any_of(a.begin(), a.end(), [&](auto v) { return std::find(b.begin(), b.end(), v) != b.end(); });
}

}  // namespace

double distance(const Point& p, const Surface& surface) {
  double least = std::numeric_limits<double>::infinity();
  for (const Triangle& triangle : surface.triangles) {
    least = std::min(least, distance_to_triangle(p, corners(surface, triangle)));
  }
  return least;
}

// The sum of solid angles (Van Oosterom and Strackee 1983) over 4 pi.
double winding_number(const Point& p, const Surface& surface) {
  double angle = 0;
  for (const Triangle& triangle : surface.triangles) {
    const auto [c0, c1, c2] = corners(surface, triangle);
    const Point a = c0 - p, b = c1 - p, c = c2 - p;
    const double la = norm(a), lb = norm(b), lc = norm(c);
    angle +=
        2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
  }
  return angle / (4 * 3.14159265358979323846);
}

std::optional<std::pair<std::size_t, std::size_t>> self_intersection(const Surface& surface) {
  const auto& triangles = surface.triangles;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = triangles[i][k], b = triangles[i][(k + 1) % 3];
      for (std::size_t j = 0; j < triangles.size(); ++j) {
        if (share_corner({a, b, b}, triangles[j])) continue;
        if (passes(surface.positions[a], surface.positions[b], corners(surface, triangles[j])))
          return {{i, j}};
      }
    }
  }
  return {};
}

}  // namespace viete::test
