#include "cages/quads.h"

#include <algorithm>
#include <cmath>

#include "mesh/half_edges.h"
#include "mesh/triangulation.h"

namespace viete::cages {

namespace {

using Quad = std::array<std::uint32_t, 4>;

// From one end of the shared edge around both triangles; its diagonal is from the first to the third.
Quad quad_of(const mesh::Triangle& s, const mesh::Triangle& t) {
  std::size_t i = 0;  // the corner of s that t does not have
  while (std::ranges::find(t, s[i]) != t.end()) ++i;
  std::size_t j = 0;
  while (std::ranges::find(s, t[j]) != s.end()) ++j;
  return {s[(i + 1) % 3], t[j], s[(i + 2) % 3], s[i]};
}

// 0 for a flat rectangle; above 1 where it should not be a quad.
double badness(const Shell& shell, const Quad& quad) {
  const auto at = [&](std::size_t i) { return shell.positions[quad[i % 4]]; };
  const Vec3 n = mesh::cross(at(1) - at(0), at(2) - at(0)), m = mesh::cross(at(2) - at(0), at(3) - at(0));
  const double bend = (1 - mesh::cosine(n, m)) / 0.3;  // 1 where the halves are 45 degrees apart
  double worst = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 before = at(i + 3) - at(i), after = at(i + 1) - at(i);
    if (mesh::dot(mesh::cross(after, before), n + m) <= 0) return 2;  // not convex
    worst = std::max(worst, std::abs(mesh::cosine(before, after)) / 0.9);
  }
  return std::max(bend, worst);
}

}  // namespace

std::vector<TrianglePair> quad_pairs(const Shell& shell) {
  struct Option {
    double badness;
    TrianglePair pair;
  };
  std::vector<Option> options;
  const mesh::HalfEdges edges = mesh::half_edges(shell.positions.size(), shell.triangles);
  for (std::size_t e = 0; e < edges.edges.size(); ++e) {
    const auto sides = edges.of(e);
    if (sides.size() != 2) continue;
    const TrianglePair pair = {sides[0].triangle, sides[1].triangle};
    const double bad = badness(shell, quad_of(shell.triangles[pair[0]], shell.triangles[pair[1]]));
    if (bad <= 1) options.push_back({bad, pair});
  }
  std::ranges::stable_sort(options, {}, &Option::badness);
  std::vector<std::uint8_t> taken(shell.triangles.size(), 0);
  std::vector<TrianglePair> pairs;
  for (const auto& [bad, pair] : options) {
    if (taken[pair[0]] || taken[pair[1]]) continue;
    taken[pair[0]] = taken[pair[1]] = 1;
    pairs.push_back(pair);
  }
  return pairs;
}

mesh::Surface with_quads(const Shell& shell, std::span<const TrianglePair> pairs) {
  mesh::Surface surface;
  surface.positions = shell.positions;
  surface.polygon_starts.push_back(0);
  const auto add = [&](const auto& polygon) {
    surface.corners.insert(surface.corners.end(), polygon.begin(), polygon.end());
    surface.polygon_starts.push_back(static_cast<std::uint32_t>(surface.corners.size()));
  };
  std::vector<std::uint8_t> paired(shell.triangles.size(), 0);
  for (const auto& [s, t] : pairs) {
    paired[s] = paired[t] = 1;
    add(quad_of(shell.triangles[s], shell.triangles[t]));
  }
  for (std::size_t t = 0; t < shell.triangles.size(); ++t) {
    if (!paired[t]) add(shell.triangles[t]);
  }
  mesh::triangulate(surface);
  return surface;
}

}  // namespace viete::cages
