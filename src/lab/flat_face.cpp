#include "lab/flat_face.h"

#include <algorithm>
#include <cmath>

#include "mesh/triangle.h"

namespace viete::lab {

using mesh::Point;

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

// The larger from the trace of J^T J and its discriminant, the smaller from the area.
Stretches stretches(const PlaneMap& map) {
  const double xx = mesh::squared_norm(map.x), yy = mesh::squared_norm(map.y);
  const double larger = std::sqrt((xx + yy + std::hypot(xx - yy, 2 * mesh::dot(map.x, map.y))) / 2);
  const double area = mesh::norm(mesh::cross(map.x, map.y));
  return {larger, larger > 0 ? std::min(larger, area / larger) : 0};
}

}  // namespace viete::lab
