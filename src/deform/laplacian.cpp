#include "deform/laplacian.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "mesh/triangle.h"

namespace viete::deform {

namespace {

// The sides opposite the corners, of a size near 1; all 0 if the corners coincide.
std::array<Vec3, 3> scaled_sides(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c) {
  std::array<Vec3, 3> sides{c - b, a - c, b - a};
  const double largest = std::max({largest_abs(sides[0]), largest_abs(sides[1]), largest_abs(sides[2])});
  const double scale = 1 / largest;
  if (!(largest > 0 && std::isfinite(scale))) return {};
  for (Vec3& side : sides) side = scale * side;
  return sides;
}

double longest_squared(const std::array<Vec3, 3>& sides) {
  return std::max({squared_norm(sides[0]), squared_norm(sides[1]), squared_norm(sides[2])});
}

double doubled_area(const std::array<Vec3, 3>& sides) {
  return norm(cross(sides[0], sides[1]));
}

}  // namespace

bool is_thin(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c) {
  const auto sides = scaled_sides(a, b, c);
  return !(doubled_area(sides) > thin_triangle * longest_squared(sides));
}

// The cotangent between two sides that run from a corner is their product over twice the area.
Vec3 half_cotangents(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c) {
  const auto s = scaled_sides(a, b, c);
  const double counted = std::max(doubled_area(s), thin_triangle * longest_squared(s));
  if (!(counted > 0)) return {0, 0, 0};
  const double scale = -0.5 / counted;
  return {scale * dot(s[1], s[2]), scale * dot(s[2], s[0]), scale * dot(s[0], s[1])};
}

SparseMatrix stiffness_matrix(std::span<const mesh::Point> positions,
                              std::span<const mesh::Triangle> triangles) {
  const auto n = static_cast<std::uint32_t>(positions.size());
  std::vector<MatrixEntry> entries;
  entries.reserve(positions.size() + 12 * triangles.size());
  for (std::uint32_t v = 0; v < n; ++v) entries.push_back({v, v, 0.0});
  for (const mesh::Triangle& t : triangles) {
    if (mesh::repeats_corner(t)) continue;
    const Vec3 half = half_cotangents(positions[t[0]], positions[t[1]], positions[t[2]]);
    for (int k = 0; k < 3; ++k) {
      const auto i = t[(k + 1) % 3], j = t[(k + 2) % 3];
      entries.push_back({i, i, half[k]}), entries.push_back({j, j, half[k]});
      entries.push_back({i, j, -half[k]}), entries.push_back({j, i, -half[k]});
    }
  }
  return sparse_matrix(positions.size(), entries);
}

}  // namespace viete::deform
