#include "mesh/half_edges.h"

#include <algorithm>
#include <numeric>

namespace viete::mesh {

namespace {

// A side of a face. Sides are listed by the lower of their two vertex indices; `high` is the higher index.
struct Side {
  std::uint32_t high, face;
  bool forward;
};

// Calls visit(low, sides) for each edge. Sorts the sides by lower index, higher index and face.
// for_each(add) must call add(from, to, face) for each side, in ascending order of the faces.
template <class ForEach, class Visit>
void visit_edges(std::size_t vertices, const ForEach& for_each, const Visit& visit) {
  std::vector<std::uint32_t> starts(vertices + 1, 0);
  for_each([&](std::uint32_t a, std::uint32_t b, std::uint32_t) { ++starts[std::min(a, b) + 1]; });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<Side> all(starts.back());
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for_each([&](std::uint32_t a, std::uint32_t b, std::uint32_t face) {
    all[next[std::min(a, b)]++] = {std::max(a, b), face, a < b};
  });
  for (std::uint32_t v = 0; v < vertices; ++v) {
    const auto sides = std::span(all).subspan(starts[v], starts[v + 1] - starts[v]);
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
      return a.high != b.high ? a.high < b.high : a.face < b.face;
    });
    for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
      while (j < sides.size() && sides[j].high == sides[i].high) ++j;
      visit(v, sides.subspan(i, j - i));
    }
  }
}

}  // namespace

HalfEdges half_edges(std::size_t vertices, std::span<const Triangle> triangles) {
  HalfEdges result;
  result.edges.reserve(3 * triangles.size() / 2);
  result.starts.reserve(3 * triangles.size() / 2 + 1);
  result.starts.push_back(0);
  result.sides.reserve(3 * triangles.size());
  const auto for_each_side = [&](const auto& add) {
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
      const auto& [a, b, c] = triangles[t];
      if (!repeats_corner(triangles[t])) {
        add(a, b, t);
        add(b, c, t);
        add(c, a, t);
      }
    }
  };
  visit_edges(vertices, for_each_side, [&](std::uint32_t low, std::span<const Side> sides) {
    result.edges.push_back({low, sides.front().high});
    for (const Side& side : sides) result.sides.push_back({side.face, side.forward});
    result.starts.push_back(static_cast<std::uint32_t>(result.sides.size()));
  });
  return result;
}

std::vector<Edge> polygon_edges(const Surface& surface) {
  std::vector<Edge> edges;
  edges.reserve(surface.corners.size() / 2);
  const auto for_each_side = [&](const auto& add) {
    for (std::uint32_t p = 0; p < surface.polygon_count(); ++p)
      for_polygon_sides(surface, p, [&](std::uint32_t a, std::uint32_t b) { add(a, b, p); });
  };
  visit_edges(surface.positions.size(), for_each_side, [&](std::uint32_t low, std::span<const Side> sides) {
    edges.push_back({low, sides.front().high});
  });
  return edges;
}

}  // namespace viete::mesh
