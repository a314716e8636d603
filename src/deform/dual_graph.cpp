#include "deform/dual_graph.h"

#include <algorithm>
#include <limits>

#include "mesh/adjacency.h"
#include "mesh/repair.h"
#include "mesh/union_find.h"

namespace viete::deform {

namespace {

constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t exact_center_limit = 4096;

bool is_fin(std::span<const mesh::HalfEdge> sides, std::span<const std::uint8_t> skip) {
  if (sides.size() < 3 || sides.size() % 2 == 0) return false;
  return std::none_of(sides.begin(), sides.end(), [&](const mesh::HalfEdge& h) { return skip[h.triangle]; });
}

void sort_unique(std::vector<mesh::Edge>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

// Breadth first from `start` over its part: the order of visits, and how far each is.
struct Sweep {
  std::vector<std::uint32_t> order, distance, parent;

  explicit Sweep(std::size_t nodes) : distance(nodes, unseen), parent(nodes, unseen) {}

  void run(const mesh::Adjacency& graph, std::uint32_t start) {
    for (const auto i : order) distance[i] = unseen;
    order.assign(1, start);
    distance[start] = 0;
    parent[start] = start;
    for (std::size_t n = 0; n < order.size(); ++n) {
      for (const auto j : graph.of(order[n])) {
        if (distance[j] != unseen) continue;
        distance[j] = distance[order[n]] + 1;
        parent[j] = order[n];
        order.push_back(j);
      }
    }
  }

  std::uint32_t eccentricity() const { return distance[order.back()]; }
};

std::uint32_t exact_center(const mesh::Adjacency& graph, std::vector<std::uint32_t> part, Sweep& sweep) {
  std::sort(part.begin(), part.end());
  std::uint32_t best = part.front(), least = unseen;
  for (const auto i : part) {
    sweep.run(graph, i);
    if (sweep.eccentricity() < least) {
      least = sweep.eccentricity();
      best = i;
    }
  }
  return best;
}

std::uint32_t middle_of_longest_path(const mesh::Adjacency& graph, Sweep& sweep) {
  sweep.run(graph, sweep.order.back());
  const std::uint32_t half = sweep.eccentricity() / 2;
  std::uint32_t i = sweep.order.back();
  while (sweep.distance[i] > half) i = sweep.parent[i];
  return i;
}

}  // namespace

std::vector<mesh::Edge> without_skipped(std::vector<mesh::Edge> pairs, std::span<const std::uint8_t> skip) {
  mesh::UnionFind clusters(skip.size());
  for (const auto& [i, j] : pairs) {
    if (skip[i] && skip[j]) clusters.join(i, j);
  }
  std::vector<mesh::Edge> kept, rim;  // rim: cluster and neighbour
  for (const auto& [i, j] : pairs) {
    if (!skip[i] && !skip[j]) kept.push_back({i, j});
    if (skip[i] != skip[j]) rim.push_back({clusters.find(skip[i] ? i : j), skip[i] ? j : i});
  }
  sort_unique(rim);
  for (std::size_t n = 1; n < rim.size(); ++n) {
    if (rim[n][0] == rim[n - 1][0]) kept.push_back({rim[n - 1][1], rim[n][1]});
  }
  sort_unique(kept);
  return kept;
}

DualGraph dual_graph(const mesh::Surface& surface, std::span<const std::uint8_t> skip) {
  const auto table = mesh::half_edges(surface.positions.size(), mesh::welded(surface).triangles);
  DualGraph graph;
  std::vector<mesh::Edge> pairs;
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto sides = table.of(e);
    for (std::size_t n = 1; n < sides.size(); ++n)
      pairs.push_back({sides[n - 1].triangle, sides[n].triangle});
    graph.open += sides.size() == 1;
    graph.nonmanifold += sides.size() > 2;
    graph.misoriented += sides.size() == 2 && sides[0].forward == sides[1].forward;
    if (is_fin(sides, skip)) graph.fins.push_back(table.edges[e]);
  }
  graph.edges = without_skipped(std::move(pairs), skip);
  return graph;
}

std::vector<std::uint32_t> graph_centers(std::size_t elements, std::span<const mesh::Edge> edges,
                                         std::span<const std::uint8_t> skip) {
  const mesh::Adjacency graph = mesh::adjacency(elements, edges);
  std::vector<std::uint8_t> seen(skip.begin(), skip.end());
  std::vector<std::uint32_t> centers;
  Sweep sweep(elements);
  for (std::uint32_t i = 0; i < elements; ++i) {
    if (seen[i]) continue;
    sweep.run(graph, i);
    for (const auto j : sweep.order) seen[j] = 1;
    centers.push_back(sweep.order.size() <= exact_center_limit ? exact_center(graph, sweep.order, sweep)
                                                               : middle_of_longest_path(graph, sweep));
  }
  return centers;
}

std::vector<std::uint32_t> graph_parts(std::size_t elements, std::span<const mesh::Edge> edges,
                                       std::span<const std::uint32_t> centers) {
  const mesh::Adjacency graph = mesh::adjacency(elements, edges);
  std::vector<std::uint32_t> parts(elements, static_cast<std::uint32_t>(centers.size()));
  Sweep sweep(elements);
  for (std::uint32_t p = 0; p < centers.size(); ++p) {
    sweep.run(graph, centers[p]);
    for (const auto i : sweep.order) parts[i] = p;
  }
  return parts;
}

}  // namespace viete::deform
