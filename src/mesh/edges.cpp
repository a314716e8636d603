#include "mesh/edges.h"

#include <algorithm>

namespace viete::mesh {

std::vector<Edge> polygon_edges(const Surface& surface) {
  std::vector<Edge> edges;
  edges.reserve(surface.corners.size());
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    const auto begin = surface.polygon_starts[p], end = surface.polygon_starts[p + 1];
    for (auto i = begin; i < end; ++i) {
      const auto a = surface.corners[i], b = surface.corners[i + 1 < end ? i + 1 : begin];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

}  // namespace viete::mesh
