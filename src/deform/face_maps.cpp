#include "deform/face_maps.h"

namespace viete::deform {

namespace {

struct Basis {
  Vec3 u, v, n;
};

// N / sqrt|N|, N = u x v, formed at unit size so that it neither over- nor underflows; 0 without area.
Vec3 scaled_normal(const Vec3& u, const Vec3& v) {
  const double size = std::max(largest_abs(u), largest_abs(v));
  if (!(size > 0)) return {0, 0, 0};
  const Vec3 area = cross((1 / size) * u, (1 / size) * v);
  const double length = norm(area);
  return length > 0 ? (size / std::sqrt(length)) * area : Vec3{0, 0, 0};
}

Basis basis(std::span<const mesh::Point> positions, const mesh::Triangle& t, int corner) {
  const mesh::Point& a = positions[t[corner]];
  const Vec3 u = positions[t[(corner + 1) % 3]] - a, v = positions[t[(corner + 2) % 3]] - a;
  return {u, v, scaled_normal(u, v)};
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

double longest_side(const mesh::Bounds& box) {
  return largest_abs(box.high - box.low);
}

}  // namespace

Vec3 middle(std::span<const mesh::Point> positions) {
  return mesh::bounds(positions).center();
}

Vec3 pose_origin(const Cage& cage, std::span<const mesh::Point> posed) {
  const mesh::Bounds rest = mesh::bounds(cage.surface.positions), pose = mesh::bounds(posed);
  const double size = std::min(longest_side(rest), longest_side(pose));
  const double step = size > 0 ? std::exp2(std::floor(std::log2(size))) : 0;
  Vec3 origin = rest.center();
  const Vec3 way = pose.center() - origin;
  for (int i = 0; i < 3; ++i) origin[i] += step * std::round(way[i] / step);
  return std::isfinite(squared_norm(origin)) ? origin : pose.center();
}

RestBasis rest_basis(std::span<const mesh::Point> positions, const mesh::Triangle& t) {
  const int corner = best_corner(positions, t);
  const Basis f = basis(positions, t, corner);
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

Vec3 posed_normal(const Cage& cage, std::size_t element, std::span<const mesh::Point> positions) {
  return basis(positions, cage.surface.triangles[element], cage.bases[element].corner).n;
}

Vec3 element_center(const Cage& cage, std::size_t element, std::span<const mesh::Point> positions,
                    const Vec3& origin) {
  const auto& [a, b, c] = cage.surface.triangles[element];
  return (1.0 / 3) * ((positions[a] - origin) + (positions[b] - origin) + (positions[c] - origin));
}

Vec3 side_along(const Vec3& area) {
  const double size = largest_abs(area);
  if (!(size > 0)) return {0, 0, 0};
  const Vec3 unit = (1 / size) * area;
  return (std::sqrt(size) / std::sqrt(norm(unit))) * unit;
}

sym3::Mat3<double> linear_map(const RestBasis& rest, const Vec3& u, const Vec3& v, const Vec3& n) {
  const Vec3 way_u = u - rest.u, way_v = v - rest.v, way_n = n - rest.n;
  const bool near =
      squared_norm(way_u) + squared_norm(way_v) < 0.25 * (squared_norm(rest.u) + squared_norm(rest.v));
  const Vec3 &a = near ? way_u : u, &b = near ? way_v : v, &c = near ? way_n : n;
  sym3::Mat3<double> m{};
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      m[3 * i + j] = (near && i == j ? 1.0 : 0.0) +
                     (a[i] * rest.dual_u[j] + b[i] * rest.dual_v[j] + c[i] * rest.dual_n[j]);
    }
  }
  return m;
}

void face_maps(const Cage& cage, std::span<const mesh::Point> posed, const Vec3& origin,
               std::span<const std::uint32_t> elements, std::span<AffineMap> maps) {
  for (const auto e : elements) {
    const auto& t = cage.surface.triangles[e];
    maps[e] = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, element_center(cage, e, posed, origin)};
    if (cage.degenerate[e]) continue;
    const auto [u, v, n] = basis(posed, t, cage.bases[e].corner);
    maps[e].linear = linear_map(cage.bases[e], u, v, n);
  }
}

}  // namespace viete::deform
