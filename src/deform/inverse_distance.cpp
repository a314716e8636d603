#include "deform/inverse_distance.h"

#include <algorithm>
#include <limits>

#include "mesh/triangle.h"

namespace viete::deform {

void inverse_distance_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights,
                              Elements elements) {
  const auto& x = cage.surface.positions;
  const double contact2 = cage.contact * cage.contact;
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < weights.size(); ++e) {
    weights[e] = std::numeric_limits<double>::infinity();
    const auto [t, weighs] = handle_shape(cage, elements, e);
    if (!weighs) continue;
    weights[e] = std::max(contact2, mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance);
    nearest2 = std::min(nearest2, weights[e]);
  }
  for (double& w : weights) w = nearest2 / w;
  double sum = 0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w /= sum;
}

HandleShape handle_shape(const Cage& cage, Elements elements, std::size_t handle) {
  const auto h = static_cast<std::uint32_t>(handle);
  if (elements == Elements::face) return {cage.surface.triangles[h], !cage.degenerate[h]};
  return {{h, h, h}, !cage.unused[h]};
}

Vec3 rest_offset(const Cage& cage, std::span<const Vec3> handles, const Vec3& x,
                 std::span<const double> weights) {
  Vec3 sum{0, 0, 0};
  for (std::size_t j = 0; j < handles.size(); ++j) sum = sum + weights[j] * handles[j];
  const Vec3 left = x - sum;
  return largest_abs(left) > 4e-15 * cage.diagonal ? left : Vec3{0, 0, 0};
}

}  // namespace viete::deform
