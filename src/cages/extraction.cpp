#include "cages/extraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "mesh/half_edges.h"
#include "mesh/triangulation.h"

namespace viete::cages {

namespace {

// A cell edge along `axis` from the corner `low`. Corner c of a cell is at (c & 1, c >> 1 & 1, c >> 2 & 1).
struct Edge {
  int low, axis;
};

constexpr std::array<Edge, 12> edges = [] {
  std::array<Edge, 12> all{};
  int n = 0;
  for (int axis = 0; axis < 3; ++axis)
    for (int corner = 0; corner < 8; ++corner) {
      if ((corner >> axis & 1) == 0) all[static_cast<std::size_t>(n++)] = {corner, axis};
    }
  return all;
}();

constexpr int edge_between(int a, int b) {
  for (int e = 0; e < 12; ++e) {
    const auto& edge = edges[static_cast<std::size_t>(e)];
    if (edge.low == std::min(a, b) && (edge.low | 1 << edge.axis) == std::max(a, b)) return e;
  }
  return -1;
}

// The corners of each face of a cell, counter-clockwise as seen from outside the cell.
constexpr std::array<std::array<int, 4>, 6> faces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

using Next = std::array<std::int8_t, 12>;  // per edge: the next edge of its loop; -1 if the edge is not cut

// Returns the loops of the isosurface in a cell, as cycles of cut edges. Bit c of `above` is set if corner c
// is above the level. Around a face, each run of corners above the level begins and ends at a cut edge. A
// loop connects these two edges.
constexpr Next loops_of(unsigned above) {
  Next next{};
  next.fill(-1);
  for (const auto& face : faces)
    for (int start = 0; start < 4; ++start) {
      const auto is_above = [&](int n) { return (above >> face[static_cast<std::size_t>(n % 4)] & 1U) != 0; };
      if (!is_above(start + 1) || is_above(start)) continue;
      int end = start + 1;
      while (is_above(end + 1)) ++end;
      const auto cut = [&](int n) {
        return edge_between(face[static_cast<std::size_t>(n % 4)],
                            face[static_cast<std::size_t>((n + 1) % 4)]);
      };
      next[static_cast<std::size_t>(cut(start))] = static_cast<std::int8_t>(cut(end));
    }
  return next;
}

constexpr std::array<Next, 256> all_loops = [] {
  std::array<Next, 256> all{};
  for (unsigned above = 0; above < 256; ++above) all[above] = loops_of(above);
  return all;
}();

// True if a face of the cell contains both edges.
constexpr std::array<std::array<bool, 12>, 12> on_one_face = [] {
  std::array<std::array<bool, 12>, 12> all{};
  for (const auto& face : faces)
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < 4; ++j) {
        const auto e = static_cast<std::size_t>(edge_between(face[i], face[(i + 1) % 4]));
        const auto f = static_cast<std::size_t>(edge_between(face[j], face[(j + 1) % 4]));
        all[e][f] = true;
      }
  return all;
}();

class Extraction {
public:
  Extraction(const Clearance& clearance, double level)
      : clearance_(clearance),
        grid_(clearance.grid()),
        level_(static_cast<float>(level)),
        vertices_(3 * grid_.node_count(), unmade) {}

  Shell run() {
    for_box({0, 0, 0}, {grid_.size[0] - 2, grid_.size[1] - 2, grid_.size[2] - 2},
            [this](std::size_t i, std::size_t j, std::size_t k) { cell(i, j, k); });
    return std::move(shell_);
  }

private:
  static constexpr std::uint32_t unmade = std::numeric_limits<std::uint32_t>::max();

  std::size_t corner(std::size_t i, std::size_t j, std::size_t k, int c) const {
    return grid_.index(i + (c & 1), j + (c >> 1 & 1), k + (c >> 2 & 1));
  }

  void cell(std::size_t i, std::size_t j, std::size_t k) {
    unsigned above = 0;
    for (int c = 0; c < 8; ++c) above |= clearance_.at_node(corner(i, j, k, c)) > level_ ? 1U << c : 0U;
    if (above == 0 || above == 255) return;
    Next next = all_loops[above];
    for (std::size_t e = 0; e < next.size(); ++e) {
      if (next[e] < 0) continue;
      loop_.clear();
      cut_.clear();
      for (std::size_t at = e; next[at] >= 0;) {
        loop_.push_back(vertex(i, j, k, edges[at]));
        cut_.push_back(at);
        at = static_cast<std::size_t>(std::exchange(next[at], std::int8_t{-1}));
      }
      close_loop();
    }
  }

  // Triangulates the loop as a fan. No inner edge of the fan may be on a face of the cell, because it could
  // coincide with an edge in the next cell. If no such fan exists, connects all vertices with the center.
  void close_loop() {
    const std::size_t n = loop_.size();
    for (std::size_t first = 0; first < n; ++first) {
      bool is_inside = true;
      for (std::size_t i = 2; i + 1 < n; ++i)
        is_inside = is_inside && !on_one_face[cut_[first]][cut_[(first + i) % n]];
      if (!is_inside) continue;
      for (std::size_t i = 1; i + 1 < n; ++i)
        shell_.triangles.push_back({loop_[first], loop_[(first + i + 1) % n], loop_[(first + i) % n]});
      return;
    }
    Point middle{0, 0, 0};
    for (const auto v : loop_) middle = middle + (1 / static_cast<double>(n)) * shell_.positions[v];
    const auto center = static_cast<std::uint32_t>(shell_.positions.size());
    shell_.positions.push_back(middle);
    for (std::size_t i = 0; i < n; ++i) shell_.triangles.push_back({center, loop_[(i + 1) % n], loop_[i]});
  }

  std::uint32_t vertex(std::size_t i, std::size_t j, std::size_t k, const Edge& edge) {
    const std::size_t from = corner(i, j, k, edge.low), to = corner(i, j, k, edge.low | 1 << edge.axis);
    std::uint32_t& made = vertices_[3 * from + static_cast<std::size_t>(edge.axis)];
    if (made != unmade) return made;
    made = static_cast<std::uint32_t>(shell_.positions.size());
    const double a = clearance_.at_node(from), b = clearance_.at_node(to);
    // The limits keep the vertices apart, so that every triangle has area.
    const double t = std::clamp((level_ - a) / (b - a), 0.05, 0.95);
    Point p = grid_.place(i + (edge.low & 1), j + (edge.low >> 1 & 1), k + (edge.low >> 2 & 1));
    p[static_cast<std::size_t>(edge.axis)] += t * grid_.step;
    shell_.positions.push_back(p);
    return made;
  }

  const Clearance& clearance_;
  const Grid& grid_;
  float level_;
  std::vector<std::uint32_t> vertices_;  // three per node: the vertices on the edges along x, y and z
  std::vector<std::uint32_t> loop_;      // the vertices of one loop
  std::vector<std::size_t> cut_;         // the cell edges of the vertices in loop_
  Shell shell_;
};

using Quad = std::array<std::uint32_t, 4>;

// Returns a quad of two triangles. Their common edge connects the quad's first and third corner.
Quad quad_of(const mesh::Triangle& s, const mesh::Triangle& t) {
  std::size_t i = 0;
  while (std::ranges::find(t, s[i]) != t.end()) ++i;
  std::size_t j = 0;
  while (std::ranges::find(s, t[j]) != s.end()) ++j;
  return {s[(i + 1) % 3], t[j], s[(i + 2) % 3], s[i]};
}

// Returns 0 for a flat rectangle. Returns more than 1 if the quad is unsuitable.
double badness(const Shell& shell, const Quad& quad) {
  const auto at = [&](std::size_t i) { return shell.positions[quad[i % 4]]; };
  const Vec3 n = mesh::cross(at(1) - at(0), at(2) - at(0)), m = mesh::cross(at(2) - at(0), at(3) - at(0));
  const double bend = (1 - mesh::cosine(n, m)) / 0.3;  // 1 for an angle of 45 degrees between the halves
  double worst = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 before = at(i + 3) - at(i), after = at(i + 1) - at(i);
    if (mesh::dot(mesh::cross(after, before), n + m) <= 0) return 2;
    worst = std::max(worst, std::abs(mesh::cosine(before, after)) / 0.9);
  }
  return std::max(bend, worst);
}

// True if all triangles of the quad fit, see mesh::CenterSplit.
bool fit(const Shell& shell, const Quad& quad, const TriangleTest& fits) {
  const auto at = [&](std::size_t i) { return shell.positions[quad[i % 4]]; };
  const Point center = 0.25 * ((at(0) + at(1)) + (at(2) + at(3)));
  for (std::size_t i = 0; i < 4; ++i)
    if (!fits({center, at(i), at(i + 1)})) return false;
  return true;
}

}  // namespace

Shell extract(const Clearance& clearance, double level) {
  return Extraction(clearance, level).run();
}

std::vector<TrianglePair> quad_pairs(const Shell& shell, const TriangleTest& fits) {
  struct Option {
    double badness;
    TrianglePair pair;
  };
  std::vector<Option> options;
  const mesh::HalfEdges edges = mesh::half_edges(shell.positions.size(), shell.triangles);
  mesh::for_inner_edges(edges, [&](std::size_t, const mesh::HalfEdge& s, const mesh::HalfEdge& t) {
    const TrianglePair pair = {s.triangle, t.triangle};
    const Quad quad = quad_of(shell.triangles[pair[0]], shell.triangles[pair[1]]);
    const double bad = badness(shell, quad);
    if (bad <= 1 && (!fits || fit(shell, quad, fits))) options.push_back({bad, pair});
  });
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
