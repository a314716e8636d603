#include "analysis/strain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "mesh/triangle.h"
#include "sym3/polar.h"
#include "sym3/rotation.h"
#include "sym3/small_matrices.h"

namespace viete::analysis {

using mesh::cross, mesh::dot, mesh::norm, mesh::Point, mesh::Vec3;

std::optional<FlatFace> flat_face(std::span<const Point> rest, const mesh::Triangle& t) {
  if (!mesh::has_area(rest[t[0]], rest[t[1]], rest[t[2]])) return std::nullopt;
  const Point u = rest[t[1]] - rest[t[0]], v = rest[t[2]] - rest[t[0]];
  const double length = mesh::norm(u);
  return FlatFace{t, length, mesh::dot(u, v) / length, mesh::norm(mesh::cross(u, v)) / length};
}

PlaneMap plane_map(const FlatFace& face, std::span<const Point> positions) {
  const auto& [a, b, c] = face.corners;
  const Point x = (1 / face.length) * (positions[b] - positions[a]);
  return {x, (1 / face.across) * (positions[c] - positions[a] - face.along * x)};
}

// `larger` is the square root of the larger eigenvalue of (x, y)^T (x, y). larger * smaller is the area.
Stretches stretches(const PlaneMap& map) {
  const double xx = mesh::squared_norm(map.x), yy = mesh::squared_norm(map.y);
  const double larger = std::sqrt((xx + yy + std::hypot(xx - yy, 2 * mesh::dot(map.x, map.y))) / 2);
  const double area = mesh::norm(mesh::cross(map.x, map.y));
  return {larger, larger > 0 ? std::min(larger, area / larger) : 0};
}

namespace {

constexpr std::size_t at_once = 4096;

Vec3 unit(const Vec3& v) {
  const double length = norm(v);
  return length > 0 ? (1 / length) * v : Vec3{0, 0, 0};
}

void add_product(const Vec3& a, const Vec3& b, double share, sym3::Mat3<double>& sum) {
  for (std::size_t k = 0; k < 9; ++k) sum[k] += share * a[k / 3] * b[k % 3];
}

// Returns f(0), f(1), ... f(count - 1).
template <class F>
auto values_of(std::size_t count, base::WorkerPool& pool, const F& f) {
  std::vector<decltype(f(0))> values(count);
  pool.for_blocks(count, at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) values[i] = f(i);
  });
  return values;
}

// Returns the axes of a face at rest: along the first side, across this side in the plane, and the normal.
std::array<Vec3, 3> axes(const FlatFace& face, std::span<const Point> rest) {
  const auto& [a, b, c] = face.corners;
  const Vec3 x = unit(rest[b] - rest[a]), n = unit(cross(rest[b] - rest[a], rest[c] - rest[a]));
  return {x, cross(n, x), n};
}

}  // namespace

Strain::Strain(const mesh::Surface& rest)
    : rest_(rest.positions), diagonal_(mesh::bounds(rest.positions).diagonal()) {
  for (const mesh::Triangle& t : rest.triangles)
    if (const std::optional<FlatFace> face = flat_face(rest_, t)) faces_.push_back(*face);
  around_ = mesh::make_adjacency(rest_.size(), [&](const auto& add) {
    for (std::uint32_t f = 0; f < faces_.size(); ++f)
      for (const std::uint32_t v : faces_[f].corners) add(v, f);
  });
}

std::vector<double> Strain::means(std::span<const Point> deformed, double (*of)(const Stretches&),
                                  base::WorkerPool& pool) const {
  const auto of_faces = values_of(
      faces_.size(), pool, [&](std::size_t f) { return of(stretches(plane_map(faces_[f], deformed))); });
  return values_of(rest_.size(), pool, [&](std::size_t v) {
    double sum = 0, area = 0;
    for (const std::uint32_t f : around_.of(v)) {
      sum += faces_[f].area() * of_faces[f];
      area += faces_[f].area();
    }
    return area > 0 ? sum / area : 0;
  });
}

std::vector<double> Strain::turns(std::span<const Point> deformed, base::WorkerPool& pool) const {
  const auto of_faces = values_of(faces_.size(), pool, [&](std::size_t f) {
    const auto [x, y, n] = axes(faces_[f], rest_);
    const PlaneMap map = plane_map(faces_[f], deformed);
    sym3::Mat3<double> product{};
    add_product(map.x, x, faces_[f].area(), product);
    add_product(map.y, y, faces_[f].area(), product);
    add_product(unit(cross(map.x, map.y)), n, faces_[f].area(), product);
    return product;
  });
  return values_of(rest_.size(), pool, [&](std::size_t v) {
    sym3::Mat3<double> sum{};
    for (const std::uint32_t f : around_.of(v)) sum = sym3::plus(sum, 1.0, of_faces[f]);
    return sym3::norm(sym3::log_rotation(sym3::polar(sum).rotation)) * 180 / std::numbers::pi;
  });
}

Vec3 Strain::normal(std::span<const Point> deformed, std::size_t vertex) const {
  Vec3 sum{0, 0, 0};
  for (const std::uint32_t f : around_.of(vertex)) {
    const auto& [a, b, c] = faces_[f].corners;
    sum = sum + cross(deformed[b] - deformed[a], deformed[c] - deformed[a]);
  }
  return unit(sum);
}

std::vector<double> Strain::along_normals(std::span<const Point> from, std::span<const Point> to,
                                          base::WorkerPool& pool) const {
  return values_of(rest_.size(), pool, [&](std::size_t v) { return dot(normal(from, v), to[v] - from[v]); });
}

}  // namespace viete::analysis
