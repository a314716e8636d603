#include "mesh/distance.h"

#include <algorithm>

namespace viete::mesh {

namespace {

double squared_distance_to_segment(const Point& p, const Point& a, const Point& b) {
  const Point u = b - a, w = p - a;
  const double length2 = dot(u, u);
  const double t = length2 > 0 ? std::clamp(dot(w, u) / length2, 0.0, 1.0) : 0.0;
  return squared_norm(w - t * u);
}

}  // namespace

double squared_distance(const Point& p, const Point& a, const Point& b, const Point& c) {
  const Point n = cross(b - a, c - a);
  const Point pa = a - p, pb = b - p, pc = c - p;
  const double n2 = dot(n, n);
  const bool above = dot(cross(pa, pb), n) >= 0 && dot(cross(pb, pc), n) >= 0 && dot(cross(pc, pa), n) >= 0;
  if (n2 > 0 && above) {
    const double height = dot(pa, n);
    return height / n2 * height;
  }
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

}  // namespace viete::mesh
