#include "deform/mean_value.h"

#include <limits>

#include "mesh/triangle.h"

namespace viete::deform {

namespace {

constexpr double in_plane = 1e-8;  // sine of the angle below which p may count as lying in a triangle's plane
constexpr double negligible = 1e-14;  // of a mean vector, off that plane
constexpr double vanishing = 1e-9;    // of the sum of absolute weights

// A triangle seen from p: directions to its corners, and the cross products of opposite pairs.
struct View {
  Vec3 u[3];       // unit directions
  double d[3];     // distances
  Vec3 c[3];       // c[i] = u[i+1] x u[i+2]
  double sine[3];  // |c[i]|
};

View view_of(const mesh::Point& p, const Cage& cage, const mesh::Triangle& t) {
  View view;
  for (int i = 0; i < 3; ++i) {
    const Vec3 q = cage.surface.positions[t[i]] - p;
    view.d[i] = norm(q);
    view.u[i] = (1 / view.d[i]) * q;
  }
  for (int i = 0; i < 3; ++i) {
    view.c[i] = cross(view.u[(i + 1) % 3], view.u[(i + 2) % 3]);
    view.sine[i] = norm(view.c[i]);
  }
  return view;
}

// Integral of the unit vectors over the spherical triangle: half the sum of its edges' angles times their
// normals. Both triangles of an edge get the same bits with opposite signs.
Vec3 mean_vector(const View& v) {
  Vec3 m{0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const double cosine = dot(v.u[(i + 1) % 3], v.u[(i + 2) % 3]);
    const double ratio = v.sine[i] > 0 ? std::atan2(v.sine[i], cosine) / v.sine[i] : 1.0;
    m = m + (0.5 * ratio) * v.c[i];
  }
  return m;
}

// The corner whose opposite edge is seen widest.
int widest(const View& v) {
  const int i = v.sine[0] >= v.sine[1] ? 0 : 1;
  return v.sine[i] >= v.sine[2] ? i : 2;
}

// Coefficients of m along u[0], u[1], u[2]. Seen edge-on from outside the three are nearly dependent, and m
// lies in their plane up to a term of second order: then the two most independent ones are used, or the
// answer would be noise.
Vec3 along_corners(const View& v, const Vec3& m) {
  const int i = widest(v), a = (i + 1) % 3, b = (i + 2) % 3;
  if (!(v.sine[i] > std::numeric_limits<double>::min())) return {0, 0, 0};
  const Vec3 n = (1 / v.sine[i]) * v.c[i];
  const double volume = dot(v.u[0], v.c[0]);
  const bool edge_on = std::abs(volume) <= in_plane * v.sine[i] * std::max(v.sine[a], v.sine[b]);
  if (volume != 0 && !(edge_on && std::abs(dot(n, m)) <= negligible)) {
    return {dot(v.c[0], m) / volume, dot(v.c[1], m) / volume, dot(v.c[2], m) / volume};
  }
  Vec3 result{0, 0, 0};
  result[a] = dot(n, cross(m, v.u[b])) / v.sine[i];
  result[b] = dot(n, cross(v.u[a], m)) / v.sine[i];
  return result;
}

bool touches_plane(const mesh::Point& p, const mesh::Point& a, const mesh::Point& b, const mesh::Point& c,
                   double distance) {
  const Vec3 n = cross(b - a, c - a);
  return std::abs(dot(n, p - a)) <= distance * norm(n) + std::numeric_limits<double>::min();
}

void set_corners(std::span<double> weights, const mesh::Triangle& t, const Vec3& barycentric) {
  std::fill(weights.begin(), weights.end(), 0.0);
  for (int i = 0; i < 3; ++i) weights[t[i]] += barycentric[i];
}

bool weights_on_cage(const Cage& cage, const mesh::Point& p, std::span<double> weights) {
  const auto& x = cage.surface.positions;
  for (const auto& t : cage.surface.triangles) {
    if (!touches_plane(p, x[t[0]], x[t[1]], x[t[2]], 2 * cage.contact)) continue;
    const mesh::Closest closest = mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]);
    if (closest.squared_distance > cage.contact * cage.contact) continue;
    set_corners(weights, t, closest.barycentric);
    return true;
  }
  return false;
}

void weights_of_closest_point(const Cage& cage, const mesh::Point& p, std::span<double> weights) {
  const auto& x = cage.surface.positions;
  mesh::Closest best{std::numeric_limits<double>::infinity(), {1, 0, 0}};
  const mesh::Triangle* nearest = &cage.surface.triangles.front();
  for (const auto& t : cage.surface.triangles) {
    const mesh::Closest closest = mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]);
    if (closest.squared_distance >= best.squared_distance) continue;
    best = closest;
    nearest = &t;
  }
  set_corners(weights, *nearest, best.barycentric);
}

}  // namespace

bool mean_value_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights) {
  if (weights_on_cage(cage, p, weights)) return true;
  std::fill(weights.begin(), weights.end(), 0.0);
  for (const auto& t : cage.sides.triangles) {
    const View view = view_of(p, cage, t);
    const Vec3 w = along_corners(view, mean_vector(view));
    for (int i = 0; i < 3; ++i) weights[t[i]] += w[i] * (cage.diagonal / view.d[i]);
  }
  double sum = 0, size = 0;
  for (const double w : weights) {
    sum += w;
    size += std::abs(w);
  }
  if (std::isfinite(size) && std::abs(sum) > vanishing * size) {
    for (double& w : weights) w /= sum;
    return true;
  }
  weights_of_closest_point(cage, p, weights);
  return false;
}

}  // namespace viete::deform
