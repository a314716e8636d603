#include "bench/torn.h"

#include <algorithm>
#include <cmath>

#include "mesh/edge_paths.h"
#include "mesh/point_tree.h"
#include "mesh/repair.h"

namespace viete::bench {

namespace {

using mesh::norm;

constexpr double nearby = 0.01, touching = 0.001;  // of the diagonal
constexpr std::size_t most_starts = 20000;

}  // namespace

std::vector<mesh::Edge> near_pairs(const mesh::Surface& model, base::WorkerPool& pool) {
  const mesh::Surface welded = mesh::welded(model);
  const double diagonal = mesh::used_bounds(welded).diagonal();
  std::vector<std::uint32_t> used = welded.corners;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  if (used.empty()) return {};
  const mesh::EdgePaths paths(welded);
  const auto& p = welded.positions;
  const mesh::PointTree tree(p, used);
  const std::size_t step = (used.size() + most_starts - 1) / most_starts;
  std::vector<std::vector<mesh::Edge>> found((used.size() + step - 1) / step);
  pool.for_blocks(found.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t a = used[i * step];
      tree.for_within(p[a], nearby * diagonal, [&](std::uint32_t b) {
        const bool touches = a != b && norm(p[a] - p[b]) <= touching * diagonal;
        if (paths.part(a) != paths.part(b) || (touches && !paths.joined(a, b, nearby * diagonal)))
          found[i].push_back({std::min(a, b), std::max(a, b)});
      });
    }
  });
  std::vector<mesh::Edge> pairs;
  for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  return pairs;
}

double torn(std::span<const mesh::Edge> pairs, std::span<const mesh::Point> rest,
            std::span<const mesh::Point> positions) {
  double largest = 0;
  for (const auto& [a, b] : pairs) {
    const double change = std::abs(norm(positions[a] - positions[b]) - norm(rest[a] - rest[b]));
    if (std::isnan(change)) return change;
    largest = std::max(largest, change);
  }
  return largest / mesh::bounds(rest).diagonal();
}

}  // namespace viete::bench
