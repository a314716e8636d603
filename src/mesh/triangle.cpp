#include "mesh/triangle.h"

#include <algorithm>
#include <functional>
#include <iterator>

namespace viete::mesh {

namespace {

Closest at(const Vec3& ap, const Vec3& ab, const Vec3& ac, double s, double t) {
  return {squared_norm(ap - (s * ab + t * ac)), {1 - s - t, s, t}};
}

// Parameter of the point of segment (0, d) closest to p.
double along(const Vec3& p, const Vec3& d) {
  const double length2 = squared_norm(d);
  return length2 > 0 ? std::clamp(dot(p, d) / length2, 0.0, 1.0) : 0.0;
}

Closest closest_on_edges(const Vec3& ap, const Vec3& ab, const Vec3& ac) {
  const double r = along(ap - ab, ac - ab);
  Closest best = at(ap, ab, ac, along(ap, ab), 0);
  for (const Closest& edge : {at(ap, ab, ac, 0, along(ap, ac)), at(ap, ab, ac, 1 - r, r)}) {
    if (edge.squared_distance < best.squared_distance) best = edge;
  }
  return best;
}

}  // namespace

std::vector<Triangle> proper_triangles(const Surface& surface) {
  std::vector<Triangle> proper;
  std::ranges::copy_if(surface.triangles, std::back_inserter(proper), std::not_fn(repeats_corner));
  return proper;
}

bool has_area(const Point& a, const Point& b, const Point& c) {
  constexpr double least = 1e-12;  // far above rounding, far below what anyone models
  const Vec3 u = b - a, v = c - a;
  const double longest = std::max({largest_abs(u), largest_abs(v), largest_abs(c - b)});
  const double scale = 1 / longest;  // sides of a size near 1, whose products are in range
  return longest > 0 && std::isfinite(scale) && norm(cross(scale * u, scale * v)) > least;
}

Closest closest_on_triangle(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = dot(ab, ap), d2 = dot(ac, ap);
  if (d1 <= 0 && d2 <= 0) return at(ap, ab, ac, 0, 0);
  const Vec3 bp = p - b;
  const double d3 = dot(ab, bp), d4 = dot(ac, bp);
  if (d3 >= 0 && d4 <= d3) return at(ap, ab, ac, 1, 0);
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0 && d1 >= 0 && d3 <= 0 && d1 > d3) return at(ap, ab, ac, d1 / (d1 - d3), 0);
  const Vec3 cp = p - c;
  const double d5 = dot(ab, cp), d6 = dot(ac, cp);
  if (d6 >= 0 && d5 <= d6) return at(ap, ab, ac, 0, 1);
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0 && d2 >= 0 && d6 <= 0 && d2 > d6) return at(ap, ab, ac, 0, d2 / (d2 - d6));
  const double va = d3 * d6 - d5 * d4, e1 = d4 - d3, e2 = d5 - d6;
  if (va <= 0 && e1 >= 0 && e2 >= 0 && e1 + e2 > 0) return at(ap, ab, ac, e2 / (e1 + e2), e1 / (e1 + e2));
  if (!(va > 0 && vb > 0 && vc > 0)) return closest_on_edges(ap, ab, ac);
  const double sum = va + vb + vc;
  return at(ap, ab, ac, vb / sum, vc / sum);
}

double half_solid_angle(const Point& a, const Point& b, const Point& c) {
  const double la = norm(a), lb = norm(b), lc = norm(c);
  const double up = dot(a, cross(b, c));
  return std::atan2(up, la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
}

}  // namespace viete::mesh
