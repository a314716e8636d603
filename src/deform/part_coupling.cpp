#include "deform/part_coupling.h"

#include <algorithm>
#include <limits>
#include <optional>

#include "mesh/point_tree.h"
#include "mesh/union_find.h"

namespace viete::deform {

namespace {

constexpr double reach = 0.015, touching = 0.001, way_around = 0.01;  // of the size
constexpr double farther = 4;                                         // than the nearest part
constexpr std::size_t most_parts = 6;
// Chosen by how far models of 2 to 30,000 parts come apart in bends, drags and twists (bench modes, torn).
constexpr double of_filled_gap = 2;

using Neighbour = mesh::PointTree::Near;

/// Which vertices lie near a vertex and are not joined to it.
class Neighbours {
public:
  Neighbours(const mesh::Surface& surface, const mesh::EdgePaths& paths, std::vector<std::uint32_t> used)
      : positions_(surface.positions),
        paths_(paths),
        size_(mesh::used_size(surface)),
        has_parts_(has_parts(used)),
        tree_(positions_, std::move(used), paths.parts()) {}

  // The nearest of each part.
  std::vector<Neighbour> of(std::uint32_t a) const {
    std::vector<Neighbour> found;
    if (has_parts_) found = tree_.nearest_of_groups(positions_[a], reach * size_, paths_.part(a));
    if (const auto fold = nearest_fold(a)) found.push_back(*fold);
    std::ranges::sort(found, [](const Neighbour& x, const Neighbour& y) { return x.nearer_than(y); });
    found.resize(std::min(found.size(), most_parts));
    std::erase_if(found, [&](const Neighbour& n) {
      return n.squared_distance > farther * farther * found[0].squared_distance;
    });
    return found;
  }

private:
  bool has_parts(const std::vector<std::uint32_t>& used) const {
    return std::ranges::any_of(used, [&](auto v) { return paths_.part(v) != paths_.part(used[0]); });
  }
  // Of its own part, where no short path leads.
  std::optional<Neighbour> nearest_fold(std::uint32_t a) const {
    std::optional<Neighbour> nearest;
    tree_.for_within(positions_[a], touching * size_, [&](std::uint32_t b) {
      if (b == a || paths_.part(b) != paths_.part(a)) return;
      const Neighbour other{paths_.part(b), b, squared_norm(positions_[a] - positions_[b])};
      if (nearest && !other.nearer_than(*nearest)) return;
      if (!paths_.joined(a, b, way_around * size_)) nearest = other;
    });
    return nearest;
  }

  std::span<const mesh::Point> positions_;
  const mesh::EdgePaths& paths_;
  double size_;
  bool has_parts_;
  mesh::PointTree tree_;
};

double area_of(const mesh::Surface& surface) {
  const auto& p = surface.positions;
  double doubled = 0;
  for (const auto& [a, b, c] : surface.triangles) doubled += norm(cross(p[b] - p[a], p[c] - p[a]));
  return doubled / 2;
}

}  // namespace

std::vector<Coupling> part_couplings(const mesh::Surface& surface, const mesh::EdgePaths& paths,
                                     std::span<const double> masses, base::WorkerPool& pool) {
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < masses.size(); ++v) {
    if (masses[v] > 0) used.push_back(v);
  }
  if (used.empty()) return {};
  const double filled = of_filled_gap * area_of(surface);
  const Neighbours neighbours(surface, paths, used);
  std::vector<std::vector<Neighbour>> found(used.size());
  pool.for_blocks(used.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) found[i] = neighbours.of(used[i]);
  });
  std::vector<Coupling> couplings;
  for (std::size_t i = 0; i < used.size(); ++i) {
    for (const auto& [part, b, square] : found[i]) {
      const double strength = filled * std::min(masses[used[i]], masses[b]) / square;
      couplings.push_back({used[i], b, std::min(strength, most_strength)});
    }
  }
  return couplings;
}

SparseMatrix with_couplings(const SparseMatrix& stiffness, std::span<const Coupling> couplings) {
  if (couplings.empty()) return stiffness;
  std::vector<MatrixEntry> entries;
  for (std::uint32_t v = 0; v < stiffness.size(); ++v)
    for_column(stiffness, v, [&](std::uint32_t row, double value) { entries.push_back({row, v, value}); });
  for (const auto& [a, b, c] : couplings) {
    entries.push_back({a, a, c}), entries.push_back({b, b, c});
    entries.push_back({a, b, -c}), entries.push_back({b, a, -c});
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
  for (const auto& [a, b, strength] : couplings) {
    const auto one = paths.part(a), other = paths.part(b);
    if (std::min(share[one], share[other]) < small && norm(p[a] - p[b]) <= near) sets.join(one, other);
  }
  Bodies result;
  std::vector<std::uint32_t> number(n, none);
  for (std::uint32_t v = 0; v < n; ++v) {
    auto& body = number[sets.find(paths.part(v))];
    if (body == none) body = static_cast<std::uint32_t>(result.shares.size()), result.shares.push_back(0);
    result.of_vertex.push_back(body);
    result.shares[body] += masses[v];
  }
  return result;
}

}  // namespace viete::deform
