#include "weights/part_coupling.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>
#include <utility>

#include "mesh/half_edges.h"
#include "mesh/point_tree.h"
#include "mesh/repair.h"
#include "mesh/triangle.h"
#include "mesh/triangle_tree.h"
#include "mesh/triangulation.h"
#include "mesh/union_find.h"

namespace viete::weights {

namespace {

constexpr double reach = 0.02, touching = 0.001, way_around = 0.01;  // see part_couplings(); in model sizes
constexpr double farther = 4;  // limit for other parts, relative to the distance of the nearest other part
constexpr std::size_t most_parts = 6;
constexpr double corner_will_do = 0.003;  // relative to the size
// Ratios of a coupling's strength, within a part and between parts, to the strength of solid material in the
// gap. Chosen by tests. Stronger couplings keep vertices at the chords of large triangles that bend.
constexpr double of_fold = 2, of_parts = 0.6;

struct Neighbour {
  mesh::Triangle triangle;
  Vec3 shares;
  double squared_distance;
};

/// Finds points that are near a vertex in space but not along edges, see part_couplings().
class Neighbours {
public:
  Neighbours(const mesh::Surface& surface, const mesh::EdgePaths& paths, std::vector<std::uint32_t> used)
      : positions_(surface.positions),
        paths_(paths),
        size_(mesh::used_size(surface)),
        triangles_(mesh::proper_triangles(surface)),
        vertex_tree_(positions_, std::move(used)) {
    const auto first = paths.part(triangles_[0][0]);
    if (std::ranges::any_of(triangles_, [&](const auto& t) { return paths.part(t[0]) != first; }))
      triangle_tree_.emplace(positions_, triangles_, nullptr, paths.parts());
  }

  std::vector<Neighbour> of(std::uint32_t vertex) const {
    std::vector<Neighbour> found;
    if (triangle_tree_) found = in_other_parts(vertex);
    if (const auto fold = nearest_fold(vertex)) found.push_back(*fold);
    return found;
  }

private:
  // Returns the nearest point of each other part within reach, sorted by distance.
  std::vector<Neighbour> in_other_parts(std::uint32_t vertex) const {
    const mesh::Point& p = positions_[vertex];
    std::vector<Neighbour> found;
    for (const auto& near :
         triangle_tree_->nearest_of_groups(p, reach * size_, farther, paths_.part(vertex))) {
      const mesh::Triangle& t = triangles_[near.triangle];
      const auto closest = mesh::closest_on_triangle(p, positions_[t[0]], positions_[t[1]], positions_[t[2]]);
      found.push_back({t, closest.barycentric, closest.squared_distance});
      take_corner(found.back());
    }
    std::ranges::sort(found, {},
                      [](const Neighbour& n) { return std::pair(n.squared_distance, n.triangle); });
    found.resize(std::min(found.size(), most_parts));
    std::erase_if(found, [&](const Neighbour& n) {
      return n.squared_distance > farther * farther * found[0].squared_distance;
    });
    return found;
  }
  // Moves the point to a near corner. The matrix is then sparser, and layers couple at matching vertices.
  void take_corner(Neighbour& n) const {
    const auto& [a, b, c] = n.triangle;
    const mesh::Point point =
        n.shares[0] * positions_[a] + n.shares[1] * positions_[b] + n.shares[2] * positions_[c];
    const double most = std::max(corner_will_do * corner_will_do * size_ * size_, 0.25 * n.squared_distance);
    const auto k = static_cast<std::size_t>(std::ranges::max_element(n.shares) - n.shares.begin());
    if (squared_norm(point - positions_[n.triangle[k]]) > most) return;
    n.shares = {0, 0, 0};
    n.shares[k] = 1;
  }
  // Returns the nearest touching vertex of the same part to which no short path leads.
  std::optional<Neighbour> nearest_fold(std::uint32_t vertex) const {
    std::optional<Neighbour> nearest;
    vertex_tree_.for_within(positions_[vertex], touching * size_, [&](std::uint32_t b) {
      if (b == vertex || paths_.part(b) != paths_.part(vertex)) return;
      const double square = squared_norm(positions_[vertex] - positions_[b]);
      if (nearest && std::pair(square, b) > std::pair(nearest->squared_distance, nearest->triangle[0]))
        return;
      if (!paths_.joined(vertex, b, way_around * size_)) nearest = Neighbour{{b, b, b}, {1, 0, 0}, square};
    });
    return nearest;
  }

  std::span<const mesh::Point> positions_;
  const mesh::EdgePaths& paths_;
  double size_;
  std::vector<mesh::Triangle> triangles_;
  mesh::PointTree vertex_tree_;
  std::optional<mesh::TriangleTree> triangle_tree_;  // empty if there is only one part
};

double area_of(const mesh::Surface& surface) {
  double sum = 0;
  for (const auto& t : surface.triangles) sum += mesh::area(surface.positions, t);
  return sum;
}

}  // namespace

std::vector<Coupling> part_couplings(const mesh::Surface& surface, const mesh::EdgePaths& paths,
                                     std::span<const double> masses, base::WorkerPool& pool) {
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < masses.size(); ++v) {
    if (masses[v] > 0) used.push_back(v);
  }
  if (used.empty()) return {};
  const double area = area_of(surface);
  const Neighbours neighbours(surface, paths, used);
  std::vector<std::vector<Neighbour>> found(used.size());
  pool.for_blocks(used.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) found[i] = neighbours.of(used[i]);
  });
  std::vector<Coupling> couplings;
  for (std::size_t i = 0; i < used.size(); ++i)
    for (const auto& [triangle, shares, square] : found[i]) {
      const auto& [a, b, c] = triangle;
      const double beside = shares[0] * masses[a] + shares[1] * masses[b] + shares[2] * masses[c];
      const double filled = area * std::min(masses[used[i]], beside) / square;
      const double strength = filled * (paths.part(a) == paths.part(used[i]) ? of_fold : of_parts);
      couplings.push_back({used[i], triangle, shares, std::min(strength, most_strength)});
    }
  return couplings;
}

PartedSurface parted_surface(const mesh::Surface& polygons, std::vector<double> masses) {
  const mesh::Surface surface = mesh::split_unsettled(polygons, 0).surface;  // from any first corners
  PartedSurface parted{surface, std::move(masses), {}};
  const auto table = mesh::half_edges(surface.positions.size(), surface.triangles);
  mesh::UnionFind sets(surface.triangles.size());
  for (std::size_t e = 0; e < table.edges.size(); ++e)
    for (const auto& side : table.of(e)) sets.join(side.triangle, table.of(e)[0].triangle);
  // For each vertex, its copies as pairs of part and vertex. The first is the vertex itself.
  std::vector<std::vector<std::pair<std::uint32_t, std::uint32_t>>> copies(surface.positions.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    if (mesh::repeats_corner(surface.triangles[t])) continue;
    const auto part = sets.find(t);
    for (auto& v : parted.surface.triangles[t]) {
      auto& of_vertex = copies[v];
      auto copy = std::ranges::find(of_vertex, part, &std::pair<std::uint32_t, std::uint32_t>::first);
      if (copy == of_vertex.end()) {
        const bool first = of_vertex.empty();
        of_vertex.push_back({part, first ? v : static_cast<std::uint32_t>(parted.masses.size())});
        copy = of_vertex.end() - 1;
        if (!first) {
          parted.origins.push_back(v);
          parted.surface.positions.push_back(surface.positions[v]);
          parted.masses.push_back(parted.masses[v]);
        }
      }
      v = copy->second;
    }
  }
  if (!parted.origins.empty())
    parted.surface = mesh::from_triangles(std::move(parted.surface.positions), parted.surface.triangles);
  return parted;
}

std::vector<Coupling> PartedSurface::joined(std::vector<Coupling> couplings) const {
  const std::size_t first = masses.size() - origins.size();
  const auto origin = [&](std::uint32_t v) { return v < first ? v : origins[v - first]; };
  for (Coupling& c : couplings) {
    c.vertex = origin(c.vertex);
    for (auto& v : c.triangle) v = origin(v);
  }
  std::erase_if(couplings, [](const Coupling& c) {
    return std::ranges::find(c.triangle, c.vertex) != c.triangle.end();
  });
  return couplings;
}

std::vector<Coupling> by_corners(std::span<const Coupling> couplings) {
  std::vector<Coupling> result;
  for (const auto& [vertex, t, shares, strength] : couplings)
    for (std::size_t k = 0; k < 3; ++k) {
      if (shares[k] > 0) result.push_back({vertex, {t[k], t[k], t[k]}, {1, 0, 0}, shares[k] * strength});
    }
  return result;
}

std::vector<Coupling> surface_couplings(const mesh::Surface& surface, base::WorkerPool& pool) {
  const mesh::Surface joined = mesh::welded(surface);
  const PartedSurface parted = parted_surface(joined, intrinsic_laplacian(joined).masses);
  const mesh::EdgePaths paths(parted.surface);
  return parted.joined(part_couplings(parted.surface, paths, parted.masses, pool));
}

std::vector<Coupling> vertex_couplings(const mesh::Surface& surface, base::WorkerPool& pool) {
  return by_corners(surface_couplings(surface, pool));
}

sparse::SparseMatrix with_couplings(const sparse::SparseMatrix& stiffness,
                                    std::span<const Coupling> couplings) {
  if (couplings.empty()) return stiffness;
  std::vector<sparse::MatrixEntry> entries;
  for (std::uint32_t v = 0; v < stiffness.size(); ++v)
    for_column(stiffness, v, [&](std::uint32_t row, double value) { entries.push_back({row, v, value}); });
  for (const auto& [vertex, t, shares, strength] : couplings) {
    const std::array difference = {std::pair(vertex, 1.0), std::pair(t[0], -shares[0]),
                                   std::pair(t[1], -shares[1]), std::pair(t[2], -shares[2])};
    for (const auto& [i, by_i] : difference)
      for (const auto& [j, by_j] : difference) {
        if (by_i != 0 && by_j != 0) entries.push_back({i, j, strength * by_i * by_j});
      }
  }
  return sparse_matrix(stiffness.size(), entries);
}

Bodies bodies(const mesh::Surface& surface, const mesh::EdgePaths& paths, std::span<const Coupling> couplings,
              std::span<const double> masses, double small) {
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  const auto& p = surface.positions;
  const auto n = static_cast<std::uint32_t>(p.size());
  const double near = touching * mesh::used_size(surface);
  std::vector<double> share(n, 0);
  for (std::uint32_t v = 0; v < n; ++v) share[paths.part(v)] += masses[v];
  mesh::UnionFind sets(n);
  for (const auto& [vertex, t, shares, strength] : couplings) {
    const auto one = paths.part(vertex), other = paths.part(t[0]);
    const mesh::Point point = shares[0] * p[t[0]] + shares[1] * p[t[1]] + shares[2] * p[t[2]];
    if (std::min(share[one], share[other]) < small && norm(p[vertex] - point) <= near) sets.join(one, other);
  }
  Bodies result;
  std::vector<std::uint32_t> number(n, none);
  for (std::uint32_t v = 0; v < n; ++v) {
    auto& body = number[sets.find(paths.part(v))];
    if (body == none) {
      body = static_cast<std::uint32_t>(result.shares.size());
      result.shares.push_back(0);
    }
    result.of_vertex.push_back(body);
    result.shares[body] += masses[v];
  }
  return result;
}

}  // namespace viete::weights
