#include "cages/soundness.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cages/frame.h"
#include "mesh/defects.h"
#include "mesh/summary.h"
#include "mesh/union_find.h"
#include "mesh/winding_number.h"

namespace viete::cages {

namespace {

std::vector<std::uint32_t> one_vertex_a_part(std::size_t vertices,
                                             std::span<const mesh::Triangle> triangles) {
  mesh::UnionFind parts(vertices);
  for (const auto& t : triangles) {
    parts.join(t[0], t[1]);
    parts.join(t[1], t[2]);
  }
  std::vector<std::uint8_t> taken(vertices, 0);
  std::vector<std::uint32_t> firsts;
  for (const auto& t : triangles) {
    if (!std::exchange(taken[parts.find(t[0])], std::uint8_t{1})) firsts.push_back(t[0]);
  }
  return firsts;
}

// Those that a quick look does not find within the cage: an exact one takes as long as the cage has
// triangles, and a soup has as many parts as triangles.
std::vector<std::uint32_t> in_doubt(const mesh::Surface& cage, std::span<const mesh::Point> positions,
                                    const std::vector<std::uint32_t>& vertices, base::WorkerPool& pool) {
  constexpr double certain = 0.75;  // the quick look is a few hundredths off
  if (cage.triangles.empty()) return vertices;
  const mesh::TriangleTree tree(cage.positions, cage.triangles);
  std::vector<char> doubt(vertices.size(), 0);
  pool.for_blocks(vertices.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      doubt[i] = !(std::abs(tree.winding_number(positions[vertices[i]])) > certain);
  });
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    if (doubt[i]) some.push_back(vertices[i]);
  }
  return some;
}

}  // namespace

Soundness soundness(const mesh::Surface& cage, std::span<const mesh::Point> positions,
                    std::span<const mesh::Triangle> triangles, const mesh::TriangleTree& tree,
                    base::WorkerPool& pool, base::Progress* progress) {
  Soundness found;
  const mesh::Summary summary = mesh::summarize(cage);
  found.open_edges =
      summary.boundary_edges.size() + summary.nonmanifold_edges.size() + summary.misoriented_edges.size();
  found.pinched_vertices = mesh::nonmanifold_vertices(cage).size();
  found.crossing = mesh::self_intersecting_triangles(cage, progress);
  for (std::uint32_t t = 0; t < cage.triangles.size(); ++t) {
    if (progress) progress->report(1);
    const auto& corners = cage.triangles[t];
    const mesh::Corners here = {cage.positions[corners[0]], cage.positions[corners[1]],
                                cage.positions[corners[2]]};
    if (mesh::has_plane(here) && tree.is_near(here)) found.cutting.push_back(t);
  }
  const auto firsts = in_doubt(cage, positions, one_vertex_a_part(positions.size(), triangles), pool);
  std::vector<mesh::Point> places(firsts.size());
  std::ranges::transform(firsts, places.begin(), [&](std::uint32_t v) { return positions[v]; });
  for (const auto i : mesh::points_outside(cage, places, &pool)) found.outside.push_back(firsts[i]);
  return found;
}

Soundness soundness(const mesh::Surface& cage, const mesh::Surface& model, base::WorkerPool& pool) {
  const Frame frame = frame_of(model, std::nullopt);
  const FramedModel framed = model_in(frame, model);
  mesh::Surface around = cage;
  for (mesh::Point& p : around.positions) p = frame.into(p);
  const mesh::TriangleTree tree(framed.positions, framed.triangles);
  return soundness(around, framed.positions, framed.triangles, tree, pool);
}

}  // namespace viete::cages
