#include "weights/point_weights.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "mesh/triangle.h"

namespace viete::weights {

namespace {

constexpr double least_near = 1.0 / 512;  // lower limit of sqrt(DistanceTriangle::near), in cage diagonals

// Returns v without its component along `unit`, normalised. If only rounding errors remain, returns 0.
Vec3 unit_across(const Vec3& v, const Vec3& unit) {
  const Vec3 across = v - dot(v, unit) * unit;
  if (!(largest_abs(across) > 1e-14 * largest_abs(v))) return {0, 0, 0};
  const Vec3 once = (1 / largest_abs(across)) * across;
  const Vec3 twice = once - dot(once, unit) * unit;
  return (1 / norm(twice)) * twice;
}

Vec3 any_across(const Vec3& unit) {
  const int least = std::abs(unit[0]) <= std::abs(unit[1]) ? (std::abs(unit[0]) <= std::abs(unit[2]) ? 0 : 2)
                                                           : (std::abs(unit[1]) <= std::abs(unit[2]) ? 1 : 2);
  Vec3 axis{0, 0, 0};
  axis[least] = 1;
  return unit_across(axis, unit);
}

// Sets along, inward and length (see DistanceTriangle) of the edge from (x, y) to (x + dx, y + dy).
void set_edge(double x, double y, double dx, double dy, double* along, double* inward, double& length) {
  const double size = std::max(std::abs(dx), std::abs(dy));
  length = size > 0 ? size * mesh::norm({dx / size, dy / size, 0}) : 0;
  const double ux = length > 0 ? dx / length : 1, uy = length > 0 ? dy / length : 0;
  const double to_along[] = {ux, uy, -(ux * x + uy * y)}, to_inward[] = {-uy, ux, uy * x - ux * y};
  std::copy_n(to_along, 3, along);
  std::copy_n(to_inward, 3, inward);
}

// Returns the triangle in its own coordinates, see DistanceTriangle. The edge from a to b is the longest.
DistanceTriangle<double> in_own_axes(const Vec3& a, const Vec3& b, const Vec3& c) {
  DistanceTriangle<double> t{};
  const double size = largest_abs(b - a);
  const Vec3 direction = size > 0 ? (1 / size) * (b - a) : Vec3{1, 0, 0};
  const Vec3 x = (1 / norm(direction)) * direction;
  Vec3 y = unit_across(c - a, x);
  const bool has_area = largest_abs(y) > 0;
  if (!has_area) y = any_across(x);
  const Vec3 z = cross(x, y);
  const Vec3 axes[] = {x, y, z};
  for (int i = 0; i < 3; ++i) std::copy(axes[i].begin(), axes[i].end(), t.axes[i]);
  const double bx = dot(b - a, x), cx = dot(c - a, x), cy = has_area ? dot(c - a, y) : 0;
  t.length[0] = bx;
  set_edge(bx, 0, cx - bx, cy, t.along[0], t.inward[0], t.length[1]);
  set_edge(cx, cy, -cx, -cy, t.along[1], t.inward[1], t.length[2]);
  t.outside = has_area ? 0 : std::numeric_limits<double>::infinity();
  const double near = std::max(bx / 16, least_near);
  t.near = near * near;
  return t;
}

// Returns the corner where the longest edge begins. The caller uses this corner as origin.
int first_corner(const std::array<Vec3, 3>& p) {
  const double ab = norm(p[1] - p[0]), bc = norm(p[2] - p[1]), ca = norm(p[0] - p[2]);
  return ab >= bc ? (ab >= ca ? 0 : 2) : (bc >= ca ? 1 : 2);
}

}  // namespace

DistanceTriangle<double> distance_triangle(const std::array<Vec3, 3>& corners, Vec3& origin) {
  const int first = first_corner(corners);
  origin = corners[first];
  return in_own_axes(corners[first], corners[(first + 1) % 3], corners[(first + 2) % 3]);
}

DistanceTriangle<float> in_float(const DistanceTriangle<double>& t) {
  DistanceTriangle<float> f{};
  const auto convert = [](const auto& from, auto& to) {
    std::transform(std::begin(from), std::end(from), std::begin(to),
                   [](double v) { return static_cast<float>(v); });
  };
  for (int i = 0; i < 3; ++i) convert(t.axes[i], f.axes[i]);
  for (int i = 0; i < 2; ++i) {
    convert(t.along[i], f.along[i]);
    convert(t.inward[i], f.inward[i]);
  }
  convert(t.length, f.length);
  f.outside = static_cast<float>(t.outside);
  f.near = static_cast<float>(t.near);
  f.share = static_cast<float>(t.share);
  return f;
}

Vec3 shift_of(const DistanceTriangle<double>& triangle, const Vec3& origin) {
  const auto along = [&](const double* axis) {
    return axis[0] * origin[0] + axis[1] * origin[1] + axis[2] * origin[2];
  };
  return {along(triangle.axes[0]), along(triangle.axes[1]), along(triangle.axes[2])};
}

HandleShape handle_shape(const pose::Cage& cage, pose::Elements elements, std::size_t handle) {
  const auto h = static_cast<std::uint32_t>(handle);
  if (elements == pose::Elements::point) return {{h, h, h}, cage.unused[h] ? 0.0 : 1.0};
  const mesh::Triangle& corners = cage.elements.triangles[h];
  if (cage.degenerate[h]) return {corners, 0};
  if (corners[0] < cage.surface.positions.size()) return {corners, 1};
  const auto n = static_cast<double>(cage.surface.polygon(cage.polygon_of(h)).size());
  return {corners, (n - 2) / n};
}

Vec3 rest_offset(const pose::Cage& cage, std::span<const Vec3> handles, const Vec3& x,
                 std::span<const double> weights) {
  Vec3 sum{0, 0, 0};
  for (std::size_t j = 0; j < handles.size(); ++j) sum = sum + weights[j] * handles[j];
  const Vec3 left = x - sum;
  return largest_abs(left) > 4e-15 * cage.diagonal ? left : Vec3{0, 0, 0};
}

namespace {

constexpr double in_plane = 1e-8;     // limit of |dot(u[0], c[0])| / (largest product of two sines)
constexpr double negligible = 1e-14;  // limit of |dot(mean vector, the plane's normal)|
constexpr double vanishing = 1e-9;    // limit of |sum of weights| / (sum of |weights|)

// A triangle seen from p. Indices are corners, modulo 3.
struct View {
  Vec3 u[3];       // unit directions from p to the corners
  double d[3];     // distances from p to the corners
  Vec3 c[3];       // c[i] = u[i+1] x u[i+2]
  double sine[3];  // |c[i]|
};

View view_of(const mesh::Point& p, const pose::Cage& cage, const mesh::Triangle& t) {
  View view;
  for (int i = 0; i < 3; ++i) {
    const Vec3 q = cage.elements.positions[t[i]] - p;
    view.d[i] = norm(q);
    view.u[i] = (1 / view.d[i]) * q;
  }
  for (int i = 0; i < 3; ++i) {
    view.c[i] = cross(view.u[(i + 1) % 3], view.u[(i + 2) % 3]);
    view.sine[i] = norm(view.c[i]);
  }
  return view;
}

// Returns the integral of the unit vectors over the spherical triangle: half the sum of angle * normal over
// the edges. An edge adds equal bits with opposite signs to its two triangles.
Vec3 mean_vector(const View& v) {
  Vec3 m{0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    const double cosine = dot(v.u[(i + 1) % 3], v.u[(i + 2) % 3]);
    const double ratio = v.sine[i] > 0 ? std::atan2(v.sine[i], cosine) / v.sine[i] : 1.0;
    m = m + (0.5 * ratio) * v.c[i];
  }
  return m;
}

// Returns the corner opposite to the edge with the largest sine, see View. This edge's ends are the best
// basis of the plane. An edge that is seen at a wider angle, near 180 degrees, would give large rounding
// errors.
int largest_sine(const View& v) {
  const int i = v.sine[0] >= v.sine[1] ? 0 : 1;
  return v.sine[i] >= v.sine[2] ? i : 2;
}

// Returns the coefficients of m along u[0], u[1] and u[2]. If p and m are almost in the triangle's plane, the
// three directions are nearly dependent. Then uses only the two ends of the edge with the largest sine.
Vec3 along_corners(const View& v, const Vec3& m) {
  const int i = largest_sine(v), a = (i + 1) % 3, b = (i + 2) % 3;
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

bool weights_on_cage(const pose::Cage& cage, const mesh::Point& p, std::span<double> weights) {
  const auto& x = cage.elements.positions;
  for (const auto& t : cage.elements.triangles) {
    if (!touches_plane(p, x[t[0]], x[t[1]], x[t[2]], 2 * cage.contact)) continue;
    const mesh::Closest closest = mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]);
    if (closest.squared_distance > cage.contact * cage.contact) continue;
    set_corners(weights, t, closest.barycentric);
    return true;
  }
  return false;
}

void weights_of_closest_point(const pose::Cage& cage, const mesh::Point& p, std::span<double> weights) {
  const auto& x = cage.elements.positions;
  mesh::Closest best{std::numeric_limits<double>::infinity(), {1, 0, 0}};
  const mesh::Triangle* nearest = &cage.elements.triangles.front();
  for (const auto& t : cage.elements.triangles) {
    const mesh::Closest closest = mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]);
    if (closest.squared_distance >= best.squared_distance) continue;
    best = closest;
    nearest = &t;
  }
  set_corners(weights, *nearest, best.barycentric);
}

bool weights_of_elements(const pose::Cage& cage, const mesh::Point& p, std::span<double> weights) {
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

}  // namespace

bool mean_value_weights(const pose::Cage& cage, const mesh::Point& p, std::span<double> weights) {
  std::vector<double> all(cage.elements.positions.size());
  const bool exist = weights_of_elements(cage, p, all);
  share_centers(cage, all.data(), 1);
  std::copy_n(all.begin(), weights.size(), weights.begin());
  return exist;
}

void share_centers(const pose::Cage& cage, double* weights, std::size_t lanes) {
  for (std::size_t i = 0; i < cage.split.size(); ++i) {
    const double* of_center = weights + (cage.surface.positions.size() + i) * lanes;
    const auto corners = cage.surface.polygon(cage.split[i]);
    for (const auto v : corners)
      for (std::size_t l = 0; l < lanes; ++l)
        weights[v * lanes + l] += of_center[l] / static_cast<double>(corners.size());
  }
}

}  // namespace viete::weights
