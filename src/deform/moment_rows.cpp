#include "deform/moment_rows.h"

#include <algorithm>
#include <cmath>

namespace viete::deform {

namespace {

constexpr double cloud_radius = 0.1;  // of the cage's edges

}  // namespace

double moment_length(const Cage& cage) {
  const auto& p = cage.surface.positions;
  double sum = 0;
  for (const auto& [a, b] : cage.edges) sum += squared_norm(p[b] - p[a]);
  return cloud_radius * std::sqrt(sum / static_cast<double>(cage.edges.size()));
}

void write_moment_row(const AffineMap& map, const Vec3& rest_center, double length, std::span<double> row) {
  for (int i = 0; i < 3; ++i) row[i] = rest_center[i] / length;
  for (int i = 0; i < 9; ++i) row[3 + i] = length * map.linear[i];
  std::ranges::copy(map.center, row.begin() + 12);
}

}  // namespace viete::deform
