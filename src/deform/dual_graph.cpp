#include "deform/dual_graph.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace viete::deform {

namespace {

using Pair = std::array<std::uint32_t, 2>;
constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t exact_center_limit = 4096;

// For each vertex the lowest one at the same place.
std::vector<std::uint32_t> welded(const std::vector<mesh::Point>& positions) {
  std::vector<std::uint32_t> order(positions.size()), first(positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](auto i, auto j) {
    return positions[i] != positions[j] ? positions[i] < positions[j] : i < j;
  });
  for (std::size_t n = 0; n < order.size(); ++n) {
    const bool same = n > 0 && positions[order[n]] == positions[order[n - 1]];
    first[order[n]] = same ? first[order[n - 1]] : order[n];
  }
  return first;
}

struct HalfEdge {
  std::uint32_t low, high, element;
  bool forward;  // the element runs from low to high

  bool same_edge(const HalfEdge& other) const { return low == other.low && high == other.high; }
};

std::vector<HalfEdge> half_edges(const mesh::Surface& surface) {
  const auto vertex = welded(surface.positions);
  std::vector<HalfEdge> all;
  for (std::uint32_t e = 0; e < surface.triangles.size(); ++e) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = vertex[surface.triangles[e][i]], b = vertex[surface.triangles[e][(i + 1) % 3]];
      if (a != b) all.push_back({std::min(a, b), std::max(a, b), e, a < b});
    }
  }
  std::sort(all.begin(), all.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.low, a.high, a.element) < std::tie(b.low, b.high, b.element);
  });
  return all;
}

bool is_fin(std::span<const HalfEdge> edge, std::span<const std::uint8_t> skip) {
  if (edge.size() < 3 || edge.size() % 2 == 0) return false;
  return std::none_of(edge.begin(), edge.end(), [&](const HalfEdge& h) { return skip[h.element]; });
}

void sort_unique(std::vector<Pair>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

// Takes skipped elements out: the neighbours of each cluster of them are joined in a chain.
std::vector<Pair> without_skipped(std::vector<Pair> pairs, std::span<const std::uint8_t> skip) {
  std::vector<std::uint32_t> cluster(skip.size());
  std::iota(cluster.begin(), cluster.end(), 0u);
  for (const auto& [i, j] : pairs) {
    if (skip[i] && skip[j]) cluster[find(cluster, i)] = find(cluster, j);
  }
  std::vector<Pair> kept, rim;  // rim: cluster and neighbour
  for (const auto& [i, j] : pairs) {
    if (!skip[i] && !skip[j]) kept.push_back({i, j});
    if (skip[i] != skip[j]) rim.push_back({find(cluster, skip[i] ? i : j), skip[i] ? j : i});
  }
  sort_unique(rim);
  for (std::size_t n = 1; n < rim.size(); ++n) {
    if (rim[n][0] == rim[n - 1][0]) kept.push_back({rim[n - 1][1], rim[n][1]});
  }
  sort_unique(kept);
  return kept;
}

// Breadth first from `start` over its part: the order of visits, and how far each is.
struct Sweep {
  std::vector<std::uint32_t> order, distance, parent;

  explicit Sweep(std::size_t nodes) : distance(nodes, unseen), parent(nodes, unseen) {}

  void run(const Adjacency& graph, std::uint32_t start) {
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

std::uint32_t exact_center(const Adjacency& graph, std::vector<std::uint32_t> part, Sweep& sweep) {
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

std::uint32_t middle_of_longest_path(const Adjacency& graph, Sweep& sweep) {
  sweep.run(graph, sweep.order.back());
  const std::uint32_t half = sweep.eccentricity() / 2;
  std::uint32_t i = sweep.order.back();
  while (sweep.distance[i] > half) i = sweep.parent[i];
  return i;
}

}  // namespace

std::uint32_t find(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

Adjacency adjacency(std::size_t nodes, std::span<const Pair> edges) {
  Adjacency graph{std::vector<std::uint32_t>(nodes + 1, 0), std::vector<std::uint32_t>(2 * edges.size())};
  for (const auto& [i, j] : edges) {
    ++graph.starts[i + 1];
    ++graph.starts[j + 1];
  }
  std::partial_sum(graph.starts.begin(), graph.starts.end(), graph.starts.begin());
  std::vector<std::uint32_t> next(graph.starts.begin(), graph.starts.end() - 1);
  for (const auto& [i, j] : edges) {
    graph.targets[next[i]++] = j;
    graph.targets[next[j]++] = i;
  }
  return graph;
}

DualGraph dual_graph(const mesh::Surface& surface, std::span<const std::uint8_t> skip) {
  const auto all = half_edges(surface);
  DualGraph graph;
  std::vector<Pair> pairs;
  for (std::size_t begin = 0, end = 0; begin < all.size(); begin = end) {
    while (end < all.size() && all[end].same_edge(all[begin])) ++end;
    for (std::size_t n = begin + 1; n < end; ++n) {
      if (all[n - 1].element != all[n].element) pairs.push_back({all[n - 1].element, all[n].element});
    }
    if (end - begin == 1) ++graph.open;
    if (end - begin > 2) ++graph.nonmanifold;
    if (is_fin(std::span(all).subspan(begin, end - begin), skip)) {
      graph.fins.push_back({all[begin].low, all[begin].high});
    }
    if (end - begin == 2 && all[begin].forward == all[begin + 1].forward) ++graph.misoriented;
  }
  graph.edges = without_skipped(std::move(pairs), skip);
  return graph;
}

std::vector<std::uint32_t> graph_centers(std::size_t elements, std::span<const Pair> edges,
                                         std::span<const std::uint8_t> skip) {
  const Adjacency graph = adjacency(elements, edges);
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

std::vector<std::uint32_t> graph_parts(std::size_t elements, std::span<const Pair> edges,
                                       std::span<const std::uint32_t> centers) {
  const Adjacency graph = adjacency(elements, edges);
  std::vector<std::uint32_t> parts(elements, static_cast<std::uint32_t>(centers.size()));
  Sweep sweep(elements);
  for (std::uint32_t p = 0; p < centers.size(); ++p) {
    sweep.run(graph, centers[p]);
    for (const auto i : sweep.order) parts[i] = p;
  }
  return parts;
}

}  // namespace viete::deform
