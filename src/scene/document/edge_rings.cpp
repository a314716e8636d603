#include "scene/document/edge_rings.h"

#include <algorithm>
#include <vector>

#include "cages/extraction.h"
#include "mesh/union_find.h"
#include "scene/document/elements.h"

namespace viete::scene {

namespace {

// Sides that lie opposite of each other in a quad are in one set: a ring is a set.
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
  // As many as there are where it is none.
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
