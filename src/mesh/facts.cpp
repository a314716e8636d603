#include "mesh/facts.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace viete::mesh {

namespace {

// One side of a triangle, kept at its smaller vertex.
struct KeptSide {
  std::uint32_t other;  // the larger vertex
  bool forward;         // runs from the smaller to the larger
};

// Sides of all triangles, grouped by their smaller vertex (counting sort), then sorted by the larger one.
class SideTable {
public:
  SideTable(std::size_t vertices, const std::vector<Triangle>& triangles) : starts_(vertices + 1, 0) {
    for_each_side(triangles, [&](std::uint32_t a, std::uint32_t b) { ++starts_[std::min(a, b) + 1]; });
    std::partial_sum(starts_.begin(), starts_.end(), starts_.begin());
    sides_.resize(starts_.back());
    std::vector<std::size_t> next(starts_.begin(), starts_.end() - 1);
    for_each_side(triangles, [&](std::uint32_t a, std::uint32_t b) {
      sides_[next[std::min(a, b)]++] = {std::max(a, b), a < b};
    });
    for (std::size_t v = 0; v < vertices; ++v) {
      std::sort(sides_.begin() + static_cast<std::ptrdiff_t>(starts_[v]),
                sides_.begin() + static_cast<std::ptrdiff_t>(starts_[v + 1]),
                [](const KeptSide& a, const KeptSide& b) { return a.other < b.other; });
    }
  }

  /// visit(smaller vertex, first side, one past the last) for each edge.
  template <class Visit>
  void for_each_edge(Visit visit) const {
    for (std::size_t v = 0; v + 1 < starts_.size(); ++v) {
      for (std::size_t i = starts_[v], j = i; i < starts_[v + 1]; i = j) {
        while (j < starts_[v + 1] && sides_[j].other == sides_[i].other) ++j;
        visit(static_cast<std::uint32_t>(v), &sides_[i], &sides_[i] + (j - i));
      }
    }
  }

private:
  template <class Visit>
  static void for_each_side(const std::vector<Triangle>& triangles, Visit visit) {
    for (const Triangle& t : triangles) {
      if (repeats_corner(t)) continue;
      for (int i = 0; i < 3; ++i) visit(t[i], t[(i + 1) % 3]);
    }
  }

  std::vector<std::size_t> starts_;
  std::vector<KeptSide> sides_;
};

void find_edges(const Surface& surface, Facts& facts) {
  const SideTable table(surface.positions.size(), surface.triangles);
  table.for_each_edge([&](std::uint32_t v, const KeptSide* first, const KeptSide* last) {
    const std::array<std::uint32_t, 2> edge = {v, first->other};
    ++facts.edges;
    if (last - first == 1) facts.boundary_edges.push_back(edge);
    if (last - first == 2 && first[0].forward == first[1].forward) facts.misoriented_edges.push_back(edge);
    if (last - first > 2) facts.nonmanifold_edges.push_back(edge);
  });
}

// Union-find with path halving.
std::uint32_t root_of(std::vector<std::uint32_t>& parent, std::uint32_t v) {
  while (parent[v] != v) v = parent[v] = parent[parent[v]];
  return v;
}

void find_parts(const Surface& surface, Facts& facts) {
  std::vector<std::uint32_t> parent(surface.positions.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<bool> used(parent.size(), false);
  for (const Triangle& t : surface.triangles) {
    for (const std::uint32_t v : t) {
      used[v] = true;
      parent[root_of(parent, v)] = root_of(parent, t[0]);
    }
  }
  for (std::uint32_t v = 0; v < parent.size(); ++v) {
    if (!used[v]) facts.unused_vertices.push_back(v);
    if (used[v] && parent[v] == v) ++facts.parts;
  }
}

// Lengths are taken relative to the box, so that no square leaves the range of double; the volume is that of
// the tetrahedra from the box's centre, which loses nothing far from the origin.
void measure(const Surface& surface, Facts& facts) {
  const Bounds box = used_bounds(surface);
  const Point center = box.center();
  const double scale = box.diagonal() > 0 ? box.diagonal() : 1;
  double area = 0, volume = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    std::array<Point, 3> p;
    for (int i = 0; i < 3; ++i) {
      p[i] = surface.positions[surface.triangles[t][i]] - center;
      for (double& x : p[i]) x /= scale;
    }
    const Point u = p[1] - p[0], v = p[2] - p[0], n = cross(u, v);
    const double longest = std::max({stable_norm(u), stable_norm(v), stable_norm(p[2] - p[1])});
    const double doubled = stable_norm(n);
    if (repeats_corner(surface.triangles[t]) || doubled <= 1e-12 * longest * longest) {
      facts.degenerate_triangles.push_back(static_cast<std::uint32_t>(t));
    }
    area += 0.5 * doubled;
    volume += dot(p[0], n) / 6;
  }
  facts.area = area * scale * scale;
  facts.volume = volume * scale * scale * scale;
}

}  // namespace

Facts facts(const Surface& surface) {
  Facts facts;
  facts.vertices = surface.positions.size();
  facts.polygons = surface.polygon_count();
  facts.triangles = surface.triangles.size();
  find_edges(surface, facts);
  find_parts(surface, facts);
  measure(surface, facts);
  return facts;
}

}  // namespace viete::mesh
