#include "deform/map_rows.h"

#include <algorithm>
#include <cmath>

namespace viete::deform {

namespace {

constexpr double cloud_radius = 0.1;  // of the cage's edges

}  // namespace

bool has_moments(RowForm form) {
  return form == RowForm::affine_moments || form == RowForm::similar_moments ||
         form == RowForm::rigid_moments;
}

void write_map_row(const AffineMap& map, const Vec3& rest_center, std::span<double> row) {
  for (int r = 0; r < 3; ++r) {
    double from_center = 0;
    for (int c = 0; c < 3; ++c) {
      row[3 * r + c] = map.linear[3 * r + c] - (r == c ? 1.0 : 0.0);
      from_center += row[3 * r + c] * rest_center[c];
    }
    row[map_shape.first_length + r] = (map.center[r] - rest_center[r]) - from_center;
  }
}

void write_log_row(const MapLog& log, std::span<double> row) {
  std::ranges::copy(numbers(log), row.begin());
  std::ranges::copy(log.center, row.begin() + log_shape.first_length);
}

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
