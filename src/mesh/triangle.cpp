#include "mesh/triangle.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <limits>

namespace viete::mesh {

namespace {

Closest at(const Vec3& ap, const Vec3& ab, const Vec3& ac, double s, double t) {
  return {squared_norm(ap - (s * ab + t * ac)), {1 - s - t, s, t}};
}

// Returns the parameter, in [0, 1], of the point nearest to p on the segment from 0 to d.
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
  constexpr double least = 1e-12;
  const Vec3 u = b - a, v = c - a;
  const double longest = std::max({largest_abs(u), largest_abs(v), largest_abs(c - b)});
  const double scale = 1 / longest;  // keeps the products in the range of double
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

namespace {

constexpr double roundoff = 0x1p-53;  // the largest relative rounding error

int sign(double x) {
  return (x > 0) - (x < 0);
}

// The rounding error of product = x * y, by Dekker's algorithm (1971). Some C libraries compute fma()
// inexactly. The factors must be smaller than 2^996.
double product_error(double x, double y, double product) {
  constexpr double splitter = 0x1p27 + 1;
  const double xs = splitter * x, ys = splitter * y;
  const double xh = xs - (xs - x), xl = x - xh, yh = ys - (ys - y), yl = y - yh;
  return ((xh * yh - product) + xh * yl + xl * yh) + xl * yl;
}

// An exact sum of doubles. It is stored as an expansion (Shewchuk 1997): parts of ascending size.
class ExactSum {
public:
  void add(double x) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < size_; ++i) {
      const double sum = x + parts_[i], rest = sum - x;
      const double lost = (x - (sum - rest)) + (parts_[i] - rest);
      if (lost != 0) parts_[kept++] = lost;
      x = sum;
    }
    if (x != 0) parts_[kept++] = x;
    size_ = kept;
  }

  // Adds the exact product x * y * z. The product x * y is exactly head + tail.
  void add_product(double x, double y, double z) {
    const double head = x * y, tail = product_error(x, y, head);
    for (const double part : {tail, head}) {
      const double product = part * z;
      add(product_error(part, z, product));
      add(product);
    }
  }

  void add_determinant(const Point& p, const Point& q, const Point& r, double factor) {
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      add_product(factor * p[i], q[j], r[k]);
      add_product(-factor * p[i], q[k], r[j]);
    }
  }

  int sign() const { return size_ == 0 ? 0 : mesh::sign(parts_[size_ - 1]); }

private:
  std::array<double, 128> parts_;  // a determinant needs at most 96 parts
  std::size_t size_ = 0;
};

// Returns the sign of det(u, v, w). The vectors may have rounding errors. If these errors could change the
// sign, calls exact(), which must return the exact determinant as an ExactSum.
template <class Exact>
int sign_of(const Vec3& u, const Vec3& v, const Vec3& w, const Exact& exact) {
  double determinant = 0, permanent = 0;
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3, k = (i + 2) % 3;
    determinant += w[i] * (u[j] * v[k] - u[k] * v[j]);
    permanent += std::abs(w[i]) * (std::abs(u[j] * v[k]) + std::abs(u[k] * v[j]));
  }
  if (permanent == 0) return 0;
  if (std::abs(determinant) > (7 + 56 * roundoff) * roundoff * permanent) return sign(determinant);
  return exact().sign();
}

}  // namespace

int orientation(const Point& a, const Point& b, const Point& c, const Point& d) {
  return sign_of(b - a, c - a, d - a, [&] {
    ExactSum sum;
    sum.add_determinant(b, c, d, 1);
    sum.add_determinant(a, c, d, -1);
    sum.add_determinant(a, b, d, 1);
    sum.add_determinant(a, b, c, -1);
    return sum;
  });
}

int orientation_along(const Vec3& normal, const Point& a, const Point& b, const Point& c) {
  return sign_of(b - a, c - a, normal, [&] {
    ExactSum sum;
    for (const auto& [p, q] : {std::array{&a, &b}, std::array{&b, &c}, std::array{&c, &a}})
      sum.add_determinant(*p, *q, normal, 1);
    return sum;
  });
}

int orientation(const Point2& a, const Point2& b, const Point2& c) {
  const double left = (b[0] - a[0]) * (c[1] - a[1]), right = (b[1] - a[1]) * (c[0] - a[0]);
  if (std::abs(left - right) > (3 + 16 * roundoff) * roundoff * (std::abs(left) + std::abs(right))) {
    return sign(left - right);
  }
  ExactSum sum;
  for (const auto& [p, q] : {std::array{&a, &b}, std::array{&b, &c}, std::array{&c, &a}}) {
    sum.add_product((*p)[0], (*q)[1], 1);
    sum.add_product(-(*p)[1], (*q)[0], 1);
  }
  return sum.sign();
}

namespace {

Point2 without(const Point& p, int axis) {
  return {p[(axis + 1) % 3], p[(axis + 2) % 3]};
}

// Returns an axis along which the projection of the triangle has area, or -1 if there is none.
int visible_axis(const Corners& t) {
  for (int axis = 0; axis < 3; ++axis) {
    if (orientation(without(t[0], axis), without(t[1], axis), without(t[2], axis)) != 0) return axis;
  }
  return -1;
}

// True if, in the projection along the axis, the line through an edge of s separates the triangles.
bool edge_separates(const Corners& s, const Corners& t, int axis) {
  for (int i = 0; i < 3; ++i) {
    const Point2 a = without(s[i], axis), b = without(s[(i + 1) % 3], axis);
    const int inner = orientation(a, b, without(s[(i + 2) % 3], axis));
    const auto outside = [&](const Point& p) { return orientation(a, b, without(p, axis)) * inner <= 0; };
    if (std::all_of(t.begin(), t.end(), outside)) return true;
  }
  return false;
}

// True if the signs do not contain both 1 and -1.
bool same_side(int a, int b, int c) {
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

// True if an edge of s passes through t. `sides` has, for each corner of s, its side of t's plane (-1, 0, 1).
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

// Returns the squared distance between two segments: from p to p + d, and from q to q + e. Source: C.
// Ericson, Real-Time Collision Detection (2005), 5.1.9.
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
