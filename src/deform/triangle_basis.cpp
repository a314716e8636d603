#include "deform/triangle_basis.h"

#include <algorithm>
#include <cmath>

namespace viete::deform {

namespace {

// N / sqrt|N|, N = u x v, formed at unit size so that it neither over- nor underflows; 0 without area.
Vec3 scaled_normal(const Vec3& u, const Vec3& v) {
  const double size = std::max(largest_abs(u), largest_abs(v));
  if (!(size > 0)) return {0, 0, 0};
  const Vec3 area = cross((1 / size) * u, (1 / size) * v);
  const double length = norm(area);
  return length > 0 ? (size / std::sqrt(length)) * area : Vec3{0, 0, 0};
}

// The corner between the two shorter edges: their cross product loses the fewest digits.
int best_corner(std::span<const mesh::Point> positions, const mesh::Triangle& t) {
  int best = 0;
  double longest = -1;
  for (int i = 0; i < 3; ++i) {
    const Vec3 opposite = positions[t[(i + 2) % 3]] - positions[t[(i + 1) % 3]];
    if (squared_norm(opposite) > longest) {
      longest = squared_norm(opposite);
      best = i;
    }
  }
  return best;
}

}  // namespace

TriangleBasis triangle_basis(std::span<const mesh::Point> positions, const mesh::Triangle& t, int corner) {
  const mesh::Point& a = positions[t[corner]];
  const Vec3 u = positions[t[(corner + 1) % 3]] - a, v = positions[t[(corner + 2) % 3]] - a;
  return {u, v, scaled_normal(u, v)};
}

RestBasis rest_basis(std::span<const mesh::Point> positions, const mesh::Triangle& t) {
  const int corner = best_corner(positions, t);
  const TriangleBasis f = triangle_basis(positions, t, corner);
  const double s = 1 / std::max(largest_abs(f.u), largest_abs(f.v));
  const Vec3 u = s * f.u, v = s * f.v, area = cross(u, v);
  const double a2 = squared_norm(area);
  return {corner,
          f.u,
          f.v,
          f.n,
          (s / a2) * cross(v, area),
          (s / a2) * cross(area, u),
          (s / (a2 / std::sqrt(std::sqrt(a2)))) * area};
}

Vec3 side_along(const Vec3& area) {
  const double size = largest_abs(area);
  if (!(size > 0)) return {0, 0, 0};
  const Vec3 unit = (1 / size) * area;
  return (std::sqrt(size) / std::sqrt(norm(unit))) * unit;
}

}  // namespace viete::deform
