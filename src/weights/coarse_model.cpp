#include "weights/coarse_model.h"

#include <algorithm>
#include <cmath>

#include "base/memory.h"
#include "mesh/point_tree.h"
#include "mesh/triangle.h"
#include "pose/cage_state.h"

namespace viete::weights {

static constexpr std::size_t vertices_per_block = 512, clusters_per_block = 64;

bool needs_coarse_model(const mesh::Surface& model) {
  return model.positions.size() > most_solved_vertices &&
         std::ranges::any_of(model.triangles,
                             [&](const auto& t) { return mesh::area(model.positions, t) > 0; });
}

bool stitches_coarse_model(const mesh::Surface& model) {
  return model.triangles.empty() || needs_coarse_model(model);
}

CoarseModel coarse_model_of(const mesh::Surface& model, const pose::Cage& cage, base::WorkerPool& pool,
                            base::Progress* progress) {
  if (model.triangles.empty()) return {Lattice(cage, pool), model.positions, pool};
  return CoarseModel(model, pool, progress);
}

// Calls find(vertex, terms) for each vertex, with empty terms. It must add the vertex's terms, if any.
template <class Find>
void CoarseModel::find_terms(std::size_t vertices, base::WorkerPool& pool, const Find& find) {
  base::require_memory({200.0 * static_cast<double>(vertices),
                        "a coarse copy of " + std::to_string(vertices) + " vertices takes",
                        "use a coarser model", ""});
  blocks_.resize((vertices + vertices_per_block - 1) / vertices_per_block);
  pool.for_blocks(vertices, vertices_per_block, [&](std::size_t begin, std::size_t end) {
    Block& block = blocks_[begin / vertices_per_block];
    std::vector<SurfaceProxy::Term> terms;
    for (std::size_t v = begin; v < end; ++v) {
      terms.clear();
      find(static_cast<std::uint32_t>(v), terms);
      block.starts.push_back(static_cast<std::uint32_t>(block.terms.size()));
      for (const auto& [cluster, factor] : terms)
        block.terms.push_back({cluster, static_cast<float>(factor)});
    }
    block.starts.push_back(static_cast<std::uint32_t>(block.terms.size()));
    block.terms.shrink_to_fit();
  });
}

CoarseModel::CoarseModel(const SurfaceProxy& proxy, std::size_t vertices, base::WorkerPool& pool)
    : surface_(proxy.surface()), members_(proxy.members()) {
  find_terms(vertices, pool, [&](std::uint32_t v, std::vector<SurfaceProxy::Term>& terms) {
    if (proxy.has_cluster(v)) proxy.terms(v, terms);
  });
}

CoarseModel::CoarseModel(const Lattice& lattice, std::span<const mesh::Point> positions,
                         base::WorkerPool& pool)
    : surface_(lattice.surface()), is_lattice_(true) {
  const mesh::PointTree tree(surface_.positions, mesh::first_numbers(surface_.positions.size()));
  std::vector<std::uint32_t> nearest(positions.size());
  find_terms(positions.size(), pool, [&](std::uint32_t v, std::vector<SurfaceProxy::Term>& terms) {
    nearest[v] = tree.nearest(positions[v]);
    lattice.terms(positions[v], terms);
    if (terms.empty()) terms.push_back({nearest[v], 1});
  });
  members_ = mesh::make_adjacency(surface_.positions.size(), [&](const auto& add) {
    for (std::uint32_t v = 0; v < nearest.size(); ++v) add(nearest[v], v);
  });
}

std::span<const CoarseModel::Term> CoarseModel::terms(std::size_t vertex) const {
  const Block& block = blocks_[vertex / vertices_per_block];
  const auto* starts = block.starts.data() + vertex % vertices_per_block;
  return std::span(block.terms).subspan(starts[0], starts[1] - starts[0]);
}

std::size_t CoarseModel::adopt_clusters() {
  const auto& p = surface_.positions;
  std::vector<bool> has_area(p.size(), false);
  for (const auto& [a, b, c] : surface_.triangles)
    if (mesh::has_area(p[a], p[b], p[c])) has_area[a] = has_area[b] = has_area[c] = true;
  std::vector<std::uint32_t> others;
  for (std::uint32_t c = 0; c < p.size(); ++c)
    if (has_area[c]) others.push_back(c);
  std::size_t count = 0;
  if (others.empty() || others.size() == p.size()) return count;
  const mesh::PointTree tree(p, std::move(others));
  for (Block& block : blocks_)
    for (Term& term : block.terms) {
      if (has_area[term.cluster]) continue;
      term.cluster = tree.nearest(p[term.cluster]);
      ++count;
    }
  return count;
}

std::vector<Vec3> CoarseModel::means(std::span<const Vec3> of_vertices, base::WorkerPool& pool) const {
  std::vector<Vec3> means(of_vertices.empty() ? 0 : surface_.positions.size(), Vec3{0, 0, 0});
  pool.for_blocks(means.size(), clusters_per_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      if (members_.of(c).empty()) continue;
      for (const auto v : members_.of(c)) means[c] = means[c] + of_vertices[v];
      means[c] = (1 / static_cast<double>(members_.of(c).size())) * means[c];
    }
  });
  return means;
}

std::vector<Vec3> CoarseModel::shape_of(std::span<const Vec3> shape, std::span<const Vec3> rest,
                                        base::WorkerPool& pool) const {
  if (!is_lattice_) return means(shape, pool);
  std::vector<Vec3> moves(shape.begin(), shape.end());
  for (std::size_t v = 0; v < moves.size(); ++v) moves[v] = moves[v] - rest[v];
  moves = means(moves, pool);
  for (std::size_t c = 0; c < moves.size(); ++c) moves[c] = surface_.positions[c] + moves[c];
  return moves;
}

Mask CoarseModel::means(const Mask& mask) const {
  if (!mask || is_lattice_) return nullptr;
  std::vector<float> means;
  for (std::size_t c = 0; c < surface_.positions.size(); ++c) {
    float sum = 0;
    for (const auto v : members_.of(c)) sum += (*mask)[v];
    means.push_back(sum / static_cast<float>(members_.of(c).size()));
  }
  return std::make_shared<const std::vector<float>>(std::move(means));
}

void CoarseModel::move(std::span<const Vec3> moves, const Mask& mask, std::span<Vec3> positions,
                       base::WorkerPool& pool) const {
  const bool masks = mask && is_lattice_;
  pool.for_blocks(positions.size(), vertices_per_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      const Vec3 move = blended(moves, v);
      positions[v] = positions[v] + (masks ? static_cast<double>((*mask)[v]) * move : move);
    }
  });
}

Vec3 CoarseModel::blended(std::span<const Vec3> moves, std::size_t vertex) const {
  Vec3 sum{0, 0, 0};
  for (const auto& [cluster, factor] : terms(vertex))
    sum = sum + static_cast<double>(factor) * moves[cluster];
  return sum;
}

RigidMotion CoarseModel::blended(std::span<const RigidMotion> motions, std::size_t vertex) const {
  if (terms(vertex).empty()) return {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  RigidMotion sum{};
  double total = 0;
  for (const auto& [cluster, factor] : terms(vertex)) {
    const auto& [rotation, shift] = motions[cluster];
    const double share = factor;
    for (std::size_t k = 0; k < 9; ++k) sum.rotation[k] += share * rotation[k];
    for (std::size_t k = 0; k < 3; ++k) sum.shift[k] += share * shift[k];
    total += share;
  }
  for (double& entry : sum.rotation) entry /= total;
  return {sum.rotation, (1 / total) * sum.shift};
}

namespace {

using mesh::none, mesh::Point;

constexpr double wanted_points = 6000;
constexpr double first_cells = 24, most_cells = 200;  // along the diagonal of the cage's box
constexpr int tries = 4;
// Points up to this number of cells from the cage are kept. Then a point in the cage has a kept neighbour.
constexpr double margin = 0.87;

}  // namespace

Lattice::Lattice(const pose::Cage& cage, base::WorkerPool& pool) {
  const auto& x = cage.elements.positions;
  const mesh::TriangleTree tree(x, cage.elements.triangles);
  const mesh::Bounds box = mesh::bounds(x);
  double next = box.diagonal() / first_cells;
  for (int i = 0; i < tries && std::abs(next - cell_) > 0.05 * cell_; ++i) {
    cell_ = next;
    for (std::size_t k = 0; k < 3; ++k) {
      const double half = std::ceil(0.5 * (box.high[k] - box.low[k]) / cell_ + margin) + 1;
      size_[k] = 2 * static_cast<std::size_t>(half) + 1;
      low_[k] = box.center()[k] - half * cell_;
    }
    const auto count = static_cast<double>(keep(tree, pool));
    next = std::max(cell_ * std::cbrt(count / wanted_points), box.diagonal() / most_cells);
  }
}

std::size_t Lattice::keep(const mesh::TriangleTree& cage, base::WorkerPool& pool) {
  number_.assign(size_[0] * size_[1] * size_[2], none);
  const double square = margin * cell_ * margin * cell_;
  pool.for_blocks(number_.size(), 256, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point p = point(i);
      if (cage.nearest(p, square).triangle != none || std::abs(cage.winding_number(p)) >= 0.5) number_[i] = 0;
    }
  });
  std::uint32_t count = 0;
  for (auto& number : number_)
    if (number != none) number = count++;
  return count;
}

Point Lattice::point(std::size_t place) const {
  Point p = low_;
  for (std::size_t k = 0; k < 3; ++k) p[k] += cell_ * static_cast<double>(coordinate(place, k));
  return p;
}

mesh::Surface Lattice::surface() const {
  std::vector<Point> points;
  std::vector<mesh::Triangle> triangles;
  for (std::size_t i = 0; i < number_.size(); ++i) {
    if (number_[i] == none) continue;
    points.push_back(point(i));
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t u = (k + 1) % 3, v = (k + 2) % 3;
      if (coordinate(i, u) + 1 == size_[u] || coordinate(i, v) + 1 == size_[v]) continue;
      const std::uint32_t a = number_[i], b = number_[i + step(u)], c = number_[i + step(u) + step(v)],
                          d = number_[i + step(v)];
      if (b == none || c == none || d == none) continue;
      triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}, {a, b, d}, {b, c, d}});
    }
  }
  return mesh::from_triangles(std::move(points), triangles);
}

void Lattice::terms(const Point& p, std::vector<Term>& terms) const {
  terms.clear();
  std::array<std::size_t, 3> first;                // of the three points that have an effect
  std::array<std::array<double, 3>, 3> factors{};  // [axis][point]
  for (std::size_t k = 0; k < 3; ++k) {
    const double x = (p[k] - low_[k]) / cell_, nearest = std::round(x), t = x - nearest;
    if (!(nearest >= 1 && nearest + 2 <= static_cast<double>(size_[k]))) return;
    first[k] = static_cast<std::size_t>(nearest) - 1;
    factors[k] = {0.5 * (0.5 - t) * (0.5 - t), 0.75 - t * t, 0.5 * (0.5 + t) * (0.5 + t)};
  }
  double sum = 0;
  for (std::size_t i = 0; i < 27; ++i) {
    const std::array<std::size_t, 3> at{i % 3, i / 3 % 3, i / 9};
    std::size_t place = 0;
    double factor = 1;
    for (std::size_t k = 0; k < 3; ++k) {
      place += (first[k] + at[k]) * step(k);
      factor *= factors[k][at[k]];
    }
    if (number_[place] == none || factor == 0) continue;
    terms.push_back({number_[place], factor});
    sum += factor;
  }
  for (Term& term : terms) term.factor /= sum;
}

}  // namespace viete::weights
