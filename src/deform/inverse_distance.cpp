#include "deform/inverse_distance.h"

#include <cmath>

#include "mesh/triangle.h"

namespace viete::deform {

namespace {

// From d^-2 in units of the least: where d = R that is the least squared distance over R^2.
void taper(double reach, int exponent, std::span<double> ratios) {
  double third = 0, fourth = 0;
  for (const double r : ratios) {
    third += r * r * r;
    fourth += r * r * (r * r);
  }
  const double end = fourth / third / (reach * reach);
  for (double& r : ratios)
    r = r > end ? (r - end) * (r - end) / r * (exponent == 2 ? 1 : std::pow(r, 0.5 * exponent - 1)) : 0;
}

}  // namespace

void inverse_distance_weights(const Cage& cage, const mesh::Point& p, std::span<double> weights, double reach,
                              Handles handles, int exponent) {
  const auto& x = cage.surface.positions;
  const double contact2 = cage.contact * cage.contact;
  double nearest2 = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < weights.size(); ++e) {
    weights[e] = std::numeric_limits<double>::infinity();
    const auto [t, weighs] = handle_shape(cage, handles, e);
    if (!weighs) continue;
    weights[e] = std::max(contact2, mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance);
    nearest2 = std::min(nearest2, weights[e]);
  }
  for (double& w : weights) w = nearest2 / w;
  if (reach < whole_cage) {
    taper(reach, exponent, weights);
  } else if (exponent != 2) {
    for (double& w : weights) w = std::pow(w, 0.5 * exponent);
  }
  double sum = 0;
  for (const double w : weights) sum += w;
  for (double& w : weights) w /= sum;
}

HandleShape handle_shape(const Cage& cage, Handles handles, std::size_t handle) {
  const auto h = static_cast<std::uint32_t>(handle);
  switch (handles) {
    case Handles::faces:
    case Handles::polygon_faces: return {cage.surface.triangles[h], !cage.degenerate[h]};
    case Handles::edges: {
      const auto& [a, b] = cage.edges[h];
      return {{a, b, b}, cage.surface.positions[a] != cage.surface.positions[b]};
    }
    case Handles::vertices: break;
  }
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
