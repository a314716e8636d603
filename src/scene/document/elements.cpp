#include "scene/document/elements.h"

#include <algorithm>
#include <vector>

#include "cages/extraction.h"
#include "mesh/union_find.h"

namespace viete::scene {

namespace {

// One byte per vertex: faster to write than vector<bool>.
using Marks = std::vector<std::uint8_t>;

Marks marks_of(const deform::Cage& cage, const Selection& selection) {
  Marks marks(cage.surface.positions.size(), 0);
  for (const auto v : selected_vertices(cage, selection)) marks[v] = 1;
  return marks;
}

Selection within(const deform::Cage& cage, ElementKind kind, const Marks& marks) {
  std::vector<std::uint32_t> inside;
  for (std::uint32_t i = 0; i < element_count(cage, kind); ++i) {
    const auto vertices = element_vertices(cage, kind, i);
    if (std::all_of(vertices.begin(), vertices.end(), [&](auto v) { return marks[v] != 0; }))
      inside.push_back(i);
  }
  return Selection(kind, inside);
}

}  // namespace

std::size_t element_count(const deform::Cage& cage, ElementKind kind) {
  switch (kind) {
    case ElementKind::vertex: return cage.surface.positions.size();
    case ElementKind::edge: return cage.edges.size();
    case ElementKind::probe: return 0;
    case ElementKind::face: break;
  }
  return cage.surface.polygon_count();
}

std::size_t element_count(const Document& document, ElementKind kind) {
  if (kind == ElementKind::probe) return document.probes.all.size();
  return document.has_cage() ? element_count(*document.cage, kind) : 0;
}

std::vector<std::uint32_t> element_vertices(const deform::Cage& cage, ElementKind kind, std::uint32_t index) {
  if (kind == ElementKind::probe) return {};
  if (kind == ElementKind::vertex) return {index};
  if (kind == ElementKind::edge) return {cage.edges[index].begin(), cage.edges[index].end()};
  const auto& corners = cage.surface.corners;
  const auto& starts = cage.surface.polygon_starts;
  return {corners.begin() + starts[index], corners.begin() + starts[index + 1]};
}

mesh::Point element_middle(const Document& document, ElementKind kind, std::uint32_t index) {
  if (kind == ElementKind::probe) return probe_center(document, index);
  const auto vertices = element_vertices(*document.cage, kind, index);
  mesh::Point sum{0, 0, 0};
  const double share = 1 / static_cast<double>(vertices.size());
  for (const auto v : vertices) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += share * document.pose.positions[v][k];
  }
  return sum;
}

std::vector<std::uint32_t> selected_vertices(const deform::Cage& cage, const Selection& selection) {
  if (selection.kind() == ElementKind::vertex) return selection.indices();
  std::vector<std::uint32_t> vertices;
  for (const auto i : selection.indices()) {
    const auto own = element_vertices(cage, selection.kind(), i);
    vertices.insert(vertices.end(), own.begin(), own.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

Selection converted(const deform::Cage& cage, const Selection& selection, ElementKind kind) {
  return kind == selection.kind() ? selection : within(cage, kind, marks_of(cage, selection));
}

Selection linked(const deform::Cage& cage, const Selection& selection) {
  mesh::UnionFind parts(cage.surface.positions.size());
  for (const auto& [a, b] : cage.edges) parts.join(a, b);
  Marks reached(cage.surface.positions.size(), 0), marks = reached;
  for (const auto v : selected_vertices(cage, selection)) reached[parts.find(v)] = 1;
  for (std::uint32_t v = 0; v < marks.size(); ++v) marks[v] = reached[parts.find(v)];
  return within(cage, selection.kind(), marks);
}

std::string element_name(ElementKind kind) {
  switch (kind) {
    case ElementKind::vertex: return "vertex";
    case ElementKind::edge: return "edge";
    case ElementKind::probe: return "probe";
    case ElementKind::face: break;
  }
  return "face";
}

std::string counted(ElementKind kind, std::size_t count) {
  if (count == 1) return (kind == ElementKind::edge ? "an " : "a ") + element_name(kind);
  return std::to_string(count) + ' ' + (kind == ElementKind::vertex ? "vertices" : element_name(kind) + "s");
}

namespace {

// Opposite sides of a quad are in one set: each set is an edge ring.
class Rings {
public:
  explicit Rings(const deform::Cage& cage) : edges_(cage.edges), sets_(cage.edges.size()) {
    join_quads_of(cage.surface);
    cages::Shell triangles{cage.surface.positions, {}};
    for (std::size_t t = 0; t < cage.surface.triangles.size(); ++t) {
      const auto polygon = cage.surface.triangle_polygon[t];
      const auto& starts = cage.surface.polygon_starts;
      if (starts[polygon + 1] - starts[polygon] == 3)
        triangles.triangles.push_back(cage.surface.triangles[t]);
    }
    join_quads_of(cages::with_quads(triangles, cages::quad_pairs(triangles)));
  }

  std::uint32_t of(std::uint32_t edge) { return sets_.find(edge); }

private:
  void join_quads_of(const mesh::Surface& surface) {
    for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
      const std::uint32_t first = surface.polygon_starts[p];
      if (surface.polygon_starts[p + 1] - first != 4) continue;
      const auto corner = [&](std::uint32_t i) { return surface.corners[first + i % 4]; };
      for (const std::uint32_t i : {0u, 1u}) join(corner(i), corner(i + 1), corner(i + 2), corner(i + 3));
    }
  }
  void join(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
    const auto one = edge_of(a, b), other = edge_of(c, d);
    if (one < edges_.size() && other < edges_.size()) sets_.join(one, other);
  }
  // The number of edges if there is no such edge.
  std::uint32_t edge_of(std::uint32_t a, std::uint32_t b) const {
    const mesh::Edge edge{std::min(a, b), std::max(a, b)};
    const auto found = std::ranges::lower_bound(edges_, edge);
    const bool known = found != edges_.end() && *found == edge;
    return static_cast<std::uint32_t>((known ? found : edges_.end()) - edges_.begin());
  }

  const std::vector<mesh::Edge>& edges_;  // sorted
  mesh::UnionFind sets_;
};

}  // namespace

Selection ringed(const deform::Cage& cage, const Selection& selection) {
  const ElementKind kind = selection.kind();
  if (kind != ElementKind::vertex && kind != ElementKind::edge) return selection;
  Rings rings(cage);
  std::vector<std::uint8_t> wanted(cage.edges.size(), 0);
  const Selection seeds = converted(cage, selection, ElementKind::edge);
  for (const auto e : seeds.indices()) wanted[rings.of(e)] = 1;
  std::vector<std::uint32_t> found;
  for (std::uint32_t e = 0; e < cage.edges.size(); ++e) {
    if (wanted[rings.of(e)]) found.push_back(e);
  }
  const Selection edges(ElementKind::edge, found);
  Selection all = selection;
  all.apply(kind == ElementKind::edge ? edges.indices() : selected_vertices(cage, edges), SelectMode::add);
  return all;
}

}  // namespace viete::scene
