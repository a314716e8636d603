#include "mesh/edge_paths.h"

#include <functional>
#include <queue>
#include <unordered_set>

#include "mesh/half_edges.h"
#include "mesh/union_find.h"

namespace viete::mesh {

EdgePaths::EdgePaths(const Surface& surface) : positions_(surface.positions) {
  const auto edges = polygon_edges(surface);
  neighbours_ = adjacency(positions_.size(), edges);
  UnionFind sets(positions_.size());
  for (const auto& [a, b] : edges) sets.join(a, b);
  for (std::uint32_t v = 0; v < positions_.size(); ++v) parts_.push_back(sets.find(v));
}

// Uses A* search. The heuristic is the straight distance to b.
bool EdgePaths::joined(std::uint32_t a, std::uint32_t b, double longest) const {
  struct Reached {
    double least, length;
    std::uint32_t vertex;
    bool operator>(const Reached& other) const { return least > other.least; }
  };
  std::priority_queue<Reached, std::vector<Reached>, std::greater<>> open;
  std::unordered_set<std::uint32_t> done;
  const auto reach = [&](std::uint32_t v, double length) {
    const double least = length + norm(positions_[b] - positions_[v]);
    if (least <= longest) open.push({least, length, v});
  };
  for (reach(a, 0); !open.empty();) {
    const auto [least, length, v] = open.top();
    open.pop();
    if (v == b) return true;
    if (!done.insert(v).second) continue;
    for (const auto next : neighbours_.of(v)) reach(next, length + norm(positions_[next] - positions_[v]));
  }
  return false;
}

}  // namespace viete::mesh
