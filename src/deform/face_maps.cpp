#include "deform/face_maps.h"

namespace viete::deform {

namespace {

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

Vec3 element_center(const Cage& cage, std::size_t element, std::span<const mesh::Point> positions,
                    const Vec3& origin) {
  const auto& [a, b, c] = cage.surface.triangles[element];
  return (1.0 / 3) * ((positions[a] - origin) + (positions[b] - origin) + (positions[c] - origin));
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
    const auto [u, v, n] = triangle_basis(posed, t, cage.bases[e].corner);
    maps[e].linear = linear_map(cage.bases[e], u, v, n);
  }
}

}  // namespace viete::deform
