#include "deform/surface_weights.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/memory.h"
#include "deform/cage_state.h"
#include "deform/point_weights.h"
#include "deform/sparse/sparse_kernel.h"
#include "mesh/point_index.h"
#include "mesh/point_tree.h"
#include "mesh/repair.h"
#include "mesh/triangle.h"
#include "mesh/triangle_tree.h"

namespace viete::deform {

namespace {

constexpr double factored_part = 0.4;  // fraction of the time before solve()
constexpr double spring_per_handle = 1;
// If a body's area is below this multiple of the mean area per handle, handles own no vertex in the body.
constexpr double least_body = 0.1;
// A handle is near a vertex up to this multiple of the distance from the vertex to its nearest handle.
constexpr double as_near = 4;

std::vector<std::uint32_t> used_vertices(const mesh::Surface& surface) {
  std::vector<bool> is_used(surface.positions.size(), false);
  for (const auto& t : surface.triangles) {
    if (mesh::repeats_corner(t)) continue;
    for (const auto v : t) is_used[v] = true;
  }
  std::vector<std::uint32_t> used;
  for (std::uint32_t v = 0; v < is_used.size(); ++v) {
    if (is_used[v]) used.push_back(v);
  }
  return used;
}

// Returns for each vertex the vertex whose weights it copies: itself, if its part has owned vertices.
std::vector<std::uint32_t> sources(const mesh::Surface& model, const SparseMatrix& stiffness,
                                   const HeldParts& held) {
  const auto n = static_cast<std::uint32_t>(stiffness.size());
  std::vector<std::uint32_t> source = first_numbers(n), some;
  std::copy_if(source.begin(), source.end(), std::back_inserter(some),
               [&](std::uint32_t v) { return held.holds(v); });
  if (some.size() == n) return source;
  mesh::UnionFind parts = connected(stiffness);
  std::vector<Vec3> sums(n, Vec3{0, 0, 0});
  std::vector<std::size_t> counts(n, 0);
  for (std::uint32_t v = 0; v < n; ++v) {
    if (held.holds(v)) continue;
    const auto part = parts.find(v);
    sums[part] = sums[part] + model.positions[v];
    ++counts[part];
  }
  const mesh::PointTree tree(model.positions, std::move(some));
  for (std::uint32_t v = 0; v < n; ++v) {
    if (counts[v] > 0) source[v] = tree.nearest((1 / static_cast<double>(counts[v])) * sums[v]);
  }
  for (std::uint32_t v = 0; v < n; ++v) {
    if (!held.holds(v)) source[v] = source[parts.find(v)];
  }
  return source;
}

}  // namespace

OwnedVertices owned_vertices(const mesh::Surface& model, const Cage& cage, Elements elements,
                             base::WorkerPool& pool) {
  auto used = used_vertices(model);
  if (used.empty()) {
    throw base::Error("", "the model has no triangles; these weights need a surface",
                      "choose the weights \"inverse\", or another model");
  }
  const mesh::PointTree tree(model.positions, std::move(used));
  const auto& x = cage.elements.positions;
  OwnedVertices owned{std::vector<std::uint32_t>(handle_count(cage, elements), OwnedVertices::none),
                      std::vector<std::uint32_t>(model.positions.size(), 0),
                      {}};
  pool.for_blocks(owned.of_handle.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h) {
      const auto [t, share] = handle_shape(cage, elements, h);
      if (share > 0) owned.of_handle[h] = tree.nearest(x[t[0]], x[t[1]], x[t[2]]);
    }
  });
  for (const auto v : owned.of_handle) {
    if (v != OwnedVertices::none) ++owned.owners[v];
  }
  return owned;
}

void own_in_bodies(OwnedVertices& owned, const mesh::Surface& model, const Bodies& bodies, const Cage& cage,
                   Elements elements, base::WorkerPool& pool) {
  const auto& x = cage.elements.positions;
  const std::size_t k = owned.of_handle.size();
  std::vector<HandleShape> shapes;
  std::vector<mesh::Triangle> weighing;
  for (std::size_t h = 0; h < k; ++h) {
    shapes.push_back(handle_shape(cage, elements, h));
    if (shapes[h].share > 0) weighing.push_back(shapes[h].corners);
  }
  if (weighing.empty()) return;
  const mesh::TriangleTree nearest_handle(x, weighing);
  std::vector<std::vector<std::uint32_t>> members(bodies.shares.size()), found(members.size());
  for (const auto v : used_vertices(model)) members[bodies.of_vertex[v]].push_back(v);
  pool.for_blocks(members.size(), 1, [&](std::size_t body, std::size_t) {
    if (members[body].empty() || bodies.shares[body] * static_cast<double>(k) < least_body) return;
    const mesh::PointTree tree(model.positions, members[body]);
    for (const auto& [t, share] : shapes) {
      found[body].push_back(OwnedVertices::none);
      if (share == 0) continue;
      const auto v = tree.nearest(x[t[0]], x[t[1]], x[t[2]]);
      const mesh::Point& p = model.positions[v];
      const double square = mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance;
      if (square <= as_near * as_near * nearest_handle.nearest(p).squared_distance) found[body].back() = v;
    }
  });
  owned.elsewhere.resize(k);
  for (std::size_t h = 0; h < k; ++h) {
    for (const auto& of_body : found) {
      if (of_body.empty() || of_body[h] == OwnedVertices::none || of_body[h] == owned.of_handle[h]) continue;
      owned.elsewhere[h].push_back(of_body[h]);
      ++owned.owners[of_body[h]];
    }
  }
}

SurfaceSystem::SurfaceSystem(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
                             base::WorkerPool& pool, base::Progress* progress)
    : SurfaceSystem(model, mesh::welded(model), cage, weighting, pool, progress) {}

SurfaceSystem::SurfaceSystem(const mesh::Surface& model, const mesh::Surface& joined, const Cage& cage,
                             const Weighting& weighting, base::WorkerPool& pool, base::Progress* progress)
    : owned_(owned_vertices(joined, cage, weighting.elements, pool)),
      laplacian_(intrinsic_laplacian(joined)) {
  if (progress) progress->report(0);
  std::vector<double> springs(joined.positions.size(), spring_per_handle * static_cast<double>(handles()));
  couple_parts(joined, cage, weighting, springs, pool);
  std::vector<bool> is_owned(owned_.owners.size());
  for (std::size_t v = 0; v < is_owned.size(); ++v) is_owned[v] = owned_.owners[v] > 0;
  const HeldParts held = held_parts(laplacian_.stiffness, is_owned);
  if (weighting.weights == Weights::biharmonic) {
    const base::ProgressPart part(progress, 0, factored_part);
    plate_.emplace(laplacian_, held, is_owned, std::move(springs), loads(), pool, progress);
  } else {
    std::vector<bool> free(is_owned.size());
    for (std::uint32_t v = 0; v < free.size(); ++v) free[v] = held.holds(v) && !is_owned[v];
    solver_.emplace(grounded(laplacian_.stiffness, free), pool, told(progress, 0, factored_part));
  }
  const auto source = sources(joined, laplacian_.stiffness, held);
  for (const auto v : mesh::lowest_in_place(model.positions)) offsets_.push_back(solver().place(source[v]));
  if (progress) progress->report(factored_part);
}

// Couples parts that are near to each other. In bodies with many owners per area, weakens the springs.
void SurfaceSystem::couple_parts(const mesh::Surface& joined, const Cage& cage, const Weighting& weighting,
                                 std::vector<double>& springs, base::WorkerPool& pool) {
  const PartedSurface parted = parted_surface(joined, laplacian_.masses);
  const mesh::EdgePaths paths(parted.surface);
  const auto found_couplings = part_couplings(parted.surface, paths, parted.masses, pool);
  const auto couplings = parted.joined(found_couplings);
  const bool plate = weighting.weights == Weights::biharmonic;
  laplacian_.stiffness = with_couplings(laplacian_.stiffness, plate ? couplings : by_corners(couplings));
  const double k = static_cast<double>(handles());
  const Bodies found = bodies(parted.surface, paths, found_couplings, parted.masses, 1 / k);
  if (found.shares.size() == 1) return;
  own_in_bodies(owned_, joined, found, cage, weighting.elements, pool);
  std::vector<double> owners(found.shares.size(), 0);
  for (std::size_t v = 0; v < springs.size(); ++v) owners[found.of_vertex[v]] += owned_.owners[v];
  for (std::size_t v = 0; v < springs.size(); ++v) {
    const auto body = found.of_vertex[v];
    if (owned_.owners[v] > 0) springs[v] *= std::min(1.0, found.shares[body] * k / owners[body]);
  }
}

const BlockSolver& SurfaceSystem::solver() const {
  return plate_ ? plate_->solver() : *solver_;
}

std::vector<ThinPlate::Load> SurfaceSystem::loads() const {
  std::vector<ThinPlate::Load> loads;
  for (std::size_t h = 0; h < handles(); ++h) {
    loads.emplace_back();
    const auto add = [&](std::uint32_t v) { loads.back().push_back({v, 1.0 / owned_.owners[v]}); };
    if (owned_.of_handle[h] != OwnedVertices::none) add(owned_.of_handle[h]);
    if (!owned_.elsewhere.empty()) std::ranges::for_each(owned_.elsewhere[h], add);
  }
  return loads;
}

void SurfaceSystem::set_right_hand_side(std::size_t handle, std::size_t column,
                                        std::span<double> block) const {
  const auto set = [&](std::uint32_t v) {
    const double value = 1.0 / owned_.owners[v];
    block[solver_->place(v) + column] = value;
    for_column(laplacian_.stiffness, v, [&](std::uint32_t other, double entry) {
      if (owned_.owners[other] == 0) block[solver_->place(other) + column] -= entry * value;
    });
  };
  if (owned_.of_handle[handle] != OwnedVertices::none) set(owned_.of_handle[handle]);
  if (!owned_.elsewhere.empty()) std::ranges::for_each(owned_.elsewhere[handle], set);
}

void SurfaceSystem::solve_block(std::size_t begin, std::size_t end, std::span<double> block) const {
  if (plate_) return plate_->solve(begin, end, block);
  for (std::size_t h = begin; h < end; ++h) set_right_hand_side(h, h - begin, block);
  solver_->solve(block, sparse_kernel(sym3::kernel()));
}

void SurfaceSystem::solve(const std::function<void(const Solved&)>& store, base::WorkerPool& pool,
                          base::Progress* progress) const {
  solver().for_blocks(handles(), pool, told(progress, factored_part, 1),
                      [&](auto begin, auto end, auto block) {
                        solve_block(begin, end, block);
                        store({begin, end - begin, block, offsets_});
                      });
}

double surface_system_bytes(std::size_t vertices) {
  // Bytes per vertex of the solved system (measured: 800 to 1500), and per vertex of a model with a proxy.
  constexpr double solved = 1600, clustered = 150;
  return solved * static_cast<double>(std::min(vertices, most_solved_vertices)) +
         (vertices > most_solved_vertices ? clustered * static_cast<double>(vertices) : 0);
}

void normalise(std::span<double> weights, bool clamp) {
  if (clamp) {
    for (double& w : weights) w = std::max(w, 0.0);
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w /= sum;
}

}  // namespace viete::deform
