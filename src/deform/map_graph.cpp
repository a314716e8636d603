#include "deform/map_graph.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "deform/dual_graph.h"
#include "mesh/repair.h"

namespace viete::deform {

namespace {

// A component follows the first part it has maps of; a part is told by the first component that has its maps.
void assign_parts(MapGraph& graph, std::size_t parts,
                  const std::function<std::uint32_t(std::uint32_t)>& part_of) {
  const auto none = static_cast<std::uint32_t>(parts);
  graph.part_of.assign(graph.roots.size(), none);
  graph.component_of.assign(parts, static_cast<std::uint32_t>(graph.roots.size()));
  for (std::uint32_t m = 0; m < graph.count(); ++m) {
    const std::uint32_t component = graph.component[m], part = part_of(m);
    if (component >= graph.roots.size() || part >= parts) continue;
    graph.part_of[component] = std::min(graph.part_of[component], part);
    graph.component_of[part] = std::min(graph.component_of[part], component);
  }
}

constexpr std::size_t most_corners = 16;  // of a polygon all of whose corners are neighbours

void add_pair(std::vector<mesh::Edge>& pairs, std::uint32_t a, std::uint32_t b) {
  if (a != b) pairs.push_back({std::min(a, b), std::max(a, b)});
}

void add_neighbours(std::span<const std::uint32_t> polygon, std::vector<mesh::Edge>& pairs) {
  const std::size_t n = polygon.size(), reach = n > most_corners ? 1 : n / 2;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 1; k <= reach; ++k) add_pair(pairs, polygon[i], polygon[(i + k) % n]);
  }
}

// The lowest part of the triangles around each vertex.
std::vector<std::uint32_t> parts_of_vertices(const Cage& cage) {
  std::vector<std::uint32_t> parts(cage.surface.positions.size(),
                                   static_cast<std::uint32_t>(cage.roots.size()));
  for (std::size_t e = 0; e < cage.element_count(); ++e) {
    for (const auto v : cage.surface.triangles[e]) parts[v] = std::min(parts[v], cage.parts[e]);
  }
  return parts;
}

}  // namespace

MapGraph vertex_graph(const Cage& cage) {
  const mesh::Surface& surface = cage.surface;
  const mesh::Surface welded = mesh::welded(surface);
  std::vector<mesh::Edge> pairs;
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    const std::size_t first = surface.polygon_starts[p], count = surface.polygon_starts[p + 1] - first;
    add_neighbours(std::span(welded.corners).subspan(first, count), pairs);
  }
  for (std::size_t c = 0; c < surface.corners.size(); ++c)
    add_pair(pairs, surface.corners[c], welded.corners[c]);
  return map_graph(cage, std::move(pairs), cage.unused,
                   [parts = parts_of_vertices(cage)](std::uint32_t v) { return parts[v]; });
}

MapGraph face_graph(const Cage& cage) {
  MapGraph graph{cage.dual_edges, cage.degenerate, cage.roots, cage.parts, {}, {}};
  graph.part_of.resize(cage.roots.size());
  std::iota(graph.part_of.begin(), graph.part_of.end(), 0u);
  graph.component_of = graph.part_of;
  return graph;
}

MapGraph map_graph(const Cage& cage, std::vector<mesh::Edge> pairs, std::vector<std::uint8_t> skipped,
                   const std::function<std::uint32_t(std::uint32_t)>& part_of) {
  MapGraph graph;
  graph.edges = without_skipped(std::move(pairs), skipped);
  graph.skipped = std::move(skipped);
  graph.roots = graph_centers(graph.count(), graph.edges, graph.skipped);
  graph.component = graph_parts(graph.count(), graph.edges, graph.roots);
  assign_parts(graph, cage.roots.size(), part_of);
  return graph;
}

}  // namespace viete::deform
