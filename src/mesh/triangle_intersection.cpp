#include "mesh/triangle_intersection.h"

#include <algorithm>
#include <limits>

#include "mesh/orientation.h"
#include "mesh/triangle.h"

namespace viete::mesh {

namespace {

Point2 without(const Point& p, int axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

// The axis along which the triangle is seen with area; -1 if it has none.
int visible_axis(const Corners& t) {
  for (int axis = 0; axis < 3; ++axis) {
    if (orientation(without(t[0], axis), without(t[1], axis), without(t[2], axis)) != 0) return axis;
  }
  return -1;
}

// An edge of s has t wholly on its outer side, or on it.
bool edge_separates(const Corners& s, const Corners& t, int axis) {
  for (int i = 0; i < 3; ++i) {
    const Point2 a = without(s[i], axis), b = without(s[(i + 1) % 3], axis);
    const int inner = orientation(a, b, without(s[(i + 2) % 3], axis));
    const auto outside = [&](const Point& p) { return orientation(a, b, without(p, axis)) * inner <= 0; };
    if (std::all_of(t.begin(), t.end(), outside)) return true;
  }
  return false;
}

// Two of equal sign, or one and zeros.
bool same_side(int a, int b, int c) {
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// An edge of s goes through t: its ends lie on both sides of the plane, and its line meets the triangle.
bool edge_crosses(const Corners& s, const Corners& t, const std::array<int, 3>& sides) {
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    if (sides[i] * sides[j] >= 0) continue;
    if (same_side(orientation(s[i], s[j], t[0], t[1]), orientation(s[i], s[j], t[1], t[2]),
                  orientation(s[i], s[j], t[2], t[0]))) {
      return true;
    }
  }
  return false;
}

std::array<int, 3> sides_of(const Corners& s, const Corners& t) {
  return {orientation(t[0], t[1], t[2], s[0]), orientation(t[0], t[1], t[2], s[1]),
          orientation(t[0], t[1], t[2], s[2])};
}

bool some_edge_crosses(const Corners& s, const Corners& t) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (crosses(s[i], s[(i + 1) % 3], t)) return true;
  }
  return false;
}

// Of the segments from p along d and from q along e. After C. Ericson, Real-Time Collision Detection (2005),
// 5.1.9.
double squared_distance(const Point& p, const Vec3& d, const Point& q, const Vec3& e) {
  const Vec3 r = p - q;
  const double a = squared_norm(d), b = dot(d, e), c = dot(d, r), g = squared_norm(e), f = dot(e, r);
  const double parallel = a * g - b * b;
  double s = parallel > 0 ? std::clamp((b * f - c * g) / parallel, 0.0, 1.0) : 0;
  double t = g > 0 ? (b * s + f) / g : 0;
  if (t < 0 || t > 1) {
    t = std::clamp(t, 0.0, 1.0);
    s = a > 0 ? std::clamp((b * t - c) / a, 0.0, 1.0) : 0;
  }
  return squared_norm(r + s * d - t * e);
}

}  // namespace

bool crosses(const Point& p, const Point& q, const Corners& t) {
  const int p_side = orientation(t[0], t[1], t[2], p), q_side = orientation(t[0], t[1], t[2], q);
  return p_side * q_side < 0 && same_side(orientation(p, q, t[0], t[1]), orientation(p, q, t[1], t[2]),
                                          orientation(p, q, t[2], t[0]));
}

bool has_plane(const Corners& t) {
  return visible_axis(t) >= 0;
}

bool intersect(const Corners& s, const Corners& t) {
  const auto of_s = sides_of(s, t);
  if (of_s == std::array{0, 0, 0}) {
    const int axis = visible_axis(s);
    return !edge_separates(s, t, axis) && !edge_separates(t, s, axis);
  }
  if (of_s[0] * of_s[1] > 0 && of_s[1] * of_s[2] > 0) return false;
  return edge_crosses(s, t, of_s) || edge_crosses(t, s, sides_of(t, s));
}

bool cut(const Corners& s, const Corners& t) {
  if (!has_plane(t)) return has_plane(s) && some_edge_crosses(t, s);
  return has_plane(s) ? intersect(s, t) : some_edge_crosses(s, t);
}

double squared_distance(const Corners& s, const Corners& t) {
  if (cut(s, t)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < 3; ++i) {
    least = std::min(least, closest_on_triangle(s[i], t[0], t[1], t[2]).squared_distance);
    least = std::min(least, closest_on_triangle(t[i], s[0], s[1], s[2]).squared_distance);
    for (std::size_t j = 0; j < 3; ++j)
      least = std::min(least, squared_distance(s[i], s[(i + 1) % 3] - s[i], t[j], t[(j + 1) % 3] - t[j]));
  }
  return least;
}

}  // namespace viete::mesh
