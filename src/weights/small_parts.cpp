#include "weights/small_parts.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "mesh/point_tree.h"
#include "mesh/triangle.h"
#include "mesh/union_find.h"
#include "pose/cage_state.h"

namespace viete::weights {

namespace {

// Parts are small below this many mean clusters' area, if there are many of them.
constexpr std::size_t clusters_of_part = 16;
constexpr std::size_t joints_per_point = 8;  // each point is joined to so many others

// Returns a number of each vertex's cell.
std::vector<std::uint64_t> keys_of(const mesh::Surface& model, std::span<const std::uint32_t> vertices,
                                   const mesh::Point& low, double cell) {
  std::vector<std::uint64_t> keys;
  for (const auto v : vertices) {
    std::uint64_t key = 0;
    for (std::size_t i = 0; i < 3; ++i)
      key = mixed(key + static_cast<std::uint64_t>(std::min((model.positions[v][i] - low[i]) / cell, 1e15)));
    keys.push_back(key);
  }
  return keys;
}

}  // namespace

std::uint64_t mixed(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

std::vector<bool> in_small_parts(const mesh::Surface& model, std::span<const mesh::Triangle> triangles,
                                 std::size_t target) {
  auto sets = mesh::parts_by_triangles(model.positions.size(), triangles);
  std::vector<double> areas(model.positions.size(), 0);
  double all = 0;
  for (const auto& t : triangles) {
    const double area = mesh::area(model.positions, t);
    areas[sets.find(t[0])] += area;
    all += area;
  }
  const double small = clusters_of_part * all / static_cast<double>(target);
  std::vector<bool> result(areas.size(), false), counted(areas.size(), false);
  std::size_t count = 0;
  for (const auto& t : triangles) {
    const auto set = sets.find(t[0]);
    if (!(areas[set] < small)) continue;
    count += !counted[set];
    counted[set] = result[t[0]] = result[t[1]] = result[t[2]] = true;
  }
  if (count * clusters_of_part <= target) result.assign(result.size(), false);
  return result;
}

Cells cells_of(const mesh::Surface& model, std::span<const std::uint32_t> vertices, std::size_t most) {
  const mesh::Bounds box = mesh::used_bounds(model);
  std::vector<std::uint64_t> keys, occupied;
  Cells cells{box.diagonal() / 128, 0, {}};
  const auto divide = [&](double by) {
    cells.size /= by;
    keys = keys_of(model, vertices, box.low, cells.size);
    occupied.clear();
    std::ranges::unique_copy(keys, std::back_inserter(occupied));  // files often list near vertices in a row
    std::ranges::sort(occupied);
    occupied.erase(std::unique(occupied.begin(), occupied.end()), occupied.end());
  };
  divide(1);
  for (int tries = 0; tries < 8 && occupied.size() < std::min(most / 16, vertices.size() / 8); ++tries)
    divide(4);
  while (occupied.size() > most)
    divide(0.95 * std::cbrt(static_cast<double>(most) / static_cast<double>(occupied.size())));
  for (const auto key : keys)
    cells.of_vertex.push_back(
        static_cast<std::uint32_t>(std::ranges::lower_bound(occupied, key) - occupied.begin()));
  cells.count = static_cast<std::uint32_t>(occupied.size());
  return cells;
}

std::vector<mesh::Triangle> joints(std::span<const mesh::Point> p, std::uint32_t first, double cell) {
  std::vector<mesh::Triangle> joints;
  if (first == p.size() || p.size() < 3) return joints;
  const mesh::PointTree tree(p, mesh::first_numbers(p.size()));
  std::vector<std::pair<double, std::uint32_t>> near;
  for (std::uint32_t c = first; c < p.size(); ++c) {
    for (double radius = 1.5 * cell; near.size() < 3 && std::isfinite(radius); radius *= 2) {
      near.clear();
      tree.for_within(p[c], radius, [&](std::uint32_t other) {
        if (other != c) near.push_back({squared_norm(p[other] - p[c]), other});
      });
      if (near.size() + 1 == p.size()) break;
    }
    std::ranges::sort(near);
    near.resize(std::min(near.size(), joints_per_point));
    for (const auto& [square, i] : near) {
      const auto cosine = [&, i = i, square = square](const auto& other) {
        return std::abs(dot(p[i] - p[c], p[other.second] - p[c])) / std::sqrt(square * other.first + 1e-300);
      };
      const auto other = std::ranges::min_element(near, {}, cosine)->second;
      if (other != i) joints.push_back({c, i, other});
    }
    near.clear();
  }
  return joints;
}

}  // namespace viete::weights
