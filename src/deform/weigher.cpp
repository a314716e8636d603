#include "deform/weigher.h"

#include "deform/face_maps.h"
#include "deform/mean_value.h"
#include "deform/vec3.h"

namespace viete::deform {

namespace {

void copy(const Vec3& v, double* out) {
  for (int i = 0; i < 3; ++i) out[i] = v[i];
}

DistanceTriangle distance_triangle(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c, bool degenerate) {
  DistanceTriangle t{};
  const Vec3 corners[] = {a, b, c}, edges[] = {b - a, c - b, a - c};
  const double size = std::max({largest_abs(edges[0]), largest_abs(edges[1]), largest_abs(edges[2])});
  const double unit = size > 0 ? 1 / size : 0;
  const Vec3 area = cross(unit * edges[0], unit * edges[1]);
  const bool has_area = norm(area) > 0;
  const Vec3 normal = has_area ? (1 / norm(area)) * area : Vec3{0, 0, 0};
  for (int i = 0; i < 3; ++i) {
    copy(corners[i], t.corner[i]);
    copy(edges[i], t.edge[i]);
    const double squared = squared_norm(edges[i]);
    t.inverse[i] = squared > 0 ? 1 / squared : 0;
    copy(cross(normal, unit * edges[i]), t.inward[i]);
  }
  copy(normal, t.normal);
  t.outside = has_area ? 0 : 1;  // without area `inward` is 0, and nothing is 1 inside
  t.degenerate = degenerate ? 1 : 0;
  return t;
}

}  // namespace

Weigher::Weigher(const Cage& cage, Coordinates coordinates, const sym3::Kernel& kernel)
    : cage_(cage),
      coordinates_(coordinates),
      kernel_(bind_kernel(kernel)),
      origin_(pose_origin(cage.surface.positions)) {
  const auto& x = cage.surface.positions;
  for (const Vec3& h : coordinates == Coordinates::mean_value ? x : cage.centers) handles_.push_back(h - origin_);
  if (coordinates == Coordinates::mean_value) return;
  for (std::size_t e = 0; e < cage.element_count(); ++e) {
    const auto& t = cage.surface.triangles[e];
    triangles_.push_back(distance_triangle(x[t[0]], x[t[1]], x[t[2]], cage.degenerate[e]));
  }
}

unsigned Weigher::weigh(const std::array<mesh::Point, bind_lanes>& points, std::span<double> weights) const {
  if (coordinates_ == Coordinates::mean_value) {
    unsigned failed = 0;
    std::vector<double> row(handles());
    for (std::size_t l = 0; l < bind_lanes; ++l) {
      if (!mean_value_weights(cage_, points[l], row)) failed |= 1u << l;
      for (std::size_t j = 0; j < row.size(); ++j) weights[j * bind_lanes + l] = row[j];
    }
    return failed;
  }
  double lanes[3 * bind_lanes];
  for (std::size_t l = 0; l < bind_lanes; ++l) {
    for (int i = 0; i < 3; ++i) lanes[i * bind_lanes + l] = points[l][i];
  }
  kernel_.inverse_distance({triangles_.data(), triangles_.size(), cage_.contact * cage_.contact, lanes},
                           weights.data());
  return 0;
}

unsigned Weigher::weigh_rows(const std::array<mesh::Point, bind_lanes>& points, std::span<double> scratch, float* rows,
                             double* sums) const {
  static_assert(sizeof(Vec3) == 3 * sizeof(double));
  const unsigned failed = weigh(points, scratch);
  const auto* positions = reinterpret_cast<const double(*)[3]>(handles_.data());
  kernel_.to_rows({scratch.data(), positions, handles(), rows, sums});
  return failed;
}

}  // namespace viete::deform
