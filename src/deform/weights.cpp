#include "deform/weights.h"

#include <limits>

#include "deform/closest.h"

namespace viete::deform {

void inverse_distance_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights) {
  const auto& x = cage.surface.positions;
  const double contact2 = cage.contact * cage.contact;
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < weights.size(); ++e) {
    weights[e] = std::numeric_limits<double>::infinity();
    if (cage.degenerate[e]) continue;
    const auto& t = cage.surface.triangles[e];
    weights[e] = std::max(contact2, closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance);
    nearest2 = std::min(nearest2, weights[e]);
  }
  double sum = 0;
  for (double& w : weights) sum += w = nearest2 / w;
  for (double& w : weights) w /= sum;
}

}  // namespace viete::deform
