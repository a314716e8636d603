#include "lab/facing.h"

#include <array>
#include <cmath>
#include <map>
#include <vector>

namespace viete::lab {

namespace {

constexpr double cosine = 0.5;  // as far as 60 degrees from straight ahead, and back

using Cell = std::array<long, 3>;

Cell cell_of(const mesh::Point& p, double size) {
  return {std::lround(std::floor(p[0] / size)), std::lround(std::floor(p[1] / size)),
          std::lround(std::floor(p[2] / size))};
}

}  // namespace

std::vector<std::uint32_t> facing_vertices(std::span<const mesh::Point> positions,
                                           std::span<const mesh::Vec3> normals, double distance) {
  std::vector<std::uint32_t> partners(positions.size(), no_partner);
  if (!(distance > 0)) return partners;
  std::map<Cell, std::vector<std::uint32_t>> cells;
  for (std::uint32_t v = 0; v < positions.size(); ++v) cells[cell_of(positions[v], distance)].push_back(v);
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const Cell at = cell_of(positions[v], distance);
    double nearest = distance;
    for (int n = 0; n < 27; ++n) {
      const auto found = cells.find({at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1});
      if (found == cells.end()) continue;
      for (const std::uint32_t other : found->second) {
        const mesh::Vec3 way = positions[other] - positions[v];
        const double far = mesh::norm(way), ahead = cosine * far;
        if (!(far > 0 && far < nearest) || mesh::dot(way, normals[v]) < ahead) continue;
        if (mesh::dot(way, normals[other]) > -ahead) continue;
        nearest = far, partners[v] = other;
      }
    }
  }
  return partners;
}

}  // namespace viete::lab
