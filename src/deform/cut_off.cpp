#include "deform/cut_off.h"

#include <algorithm>
#include <cmath>

#include "deform/inverse_distance.h"
#include "mesh/triangle.h"

namespace viete::deform {

double cut_off_weights(const Cage& cage, const mesh::Point& p, const Weighting& weighting,
                       std::span<double> weights) {
  const auto& x = cage.surface.positions;
  const double radius = weighting.radius * cage.size;
  double total = 0;
  for (std::size_t h = 0; h < weights.size(); ++h) {
    const auto [t, weighs] = handle_shape(cage, weighting.elements, h);
    weights[h] = 0;
    if (!weighs) continue;
    const double d2 = mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance;
    const double left = std::max(0.0, 1 - std::sqrt(d2) / radius);
    weights[h] = left * left;
    total += weights[h];
  }
  if (total > 0) {
    for (double& w : weights) w /= total;
  }
  return total;
}

}  // namespace viete::deform
