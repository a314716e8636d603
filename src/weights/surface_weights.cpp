#include "weights/surface_weights.h"

#include <algorithm>
#include <numeric>

#include "base/error.h"
#include "base/memory.h"
#include "mesh/point_index.h"
#include "mesh/point_tree.h"
#include "mesh/repair.h"
#include "mesh/triangle.h"
#include "mesh/triangle_tree.h"
#include "pose/cage_state.h"
#include "sparse/sparse_kernel.h"
#include "weights/point_weights.h"

namespace viete::weights {

namespace {

constexpr double factored_part = 0.4;  // fraction of the time before solve()
// If a body's area is below this multiple of the mean area per handle, handles own no vertex in the body.
constexpr double least_body = 0.1;
// A handle is near a vertex up to this multiple of the distance from the vertex to its nearest handle.
constexpr double as_near = 4;
// Distances are equal if they differ by less than this multiple of the cage's diagonal. Files often have only
// seven digits.
constexpr double equally_near = 1e-6;
// A handle owns only the first of more equally near vertices than this, for example on a circle, because
// ThinPlate factors a dense matrix of all owned vertices.
constexpr std::size_t most_shared = 64;

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
std::vector<std::uint32_t> sources(const mesh::Surface& model, const sparse::SparseMatrix& stiffness,
                                   const HeldParts& held) {
  const auto n = static_cast<std::uint32_t>(stiffness.size());
  std::vector<std::uint32_t> source = mesh::first_numbers(n), some;
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

// Returns the number of handles. Those of a polygon with a center count as n - 2, because all of them follow
// the same n corners.
double count_of_handles(const pose::Cage& cage, pose::Elements elements) {
  double count = 0;
  for (std::size_t h = 0; h < pose::handle_count(cage, elements); ++h)
    count += handle_shape(cage, elements, h).share;
  return count;
}

// Returns the vertices that a handle owns, see OwnedVertices. Its distance decides, then its center.
std::vector<OwnedVertices::Owned> nearest_to_handle(const mesh::Surface& model, const mesh::PointTree& tree,
                                                    const pose::Cage& cage, pose::Elements elements,
                                                    std::size_t handle) {
  const auto [t, share] = handle_shape(cage, elements, handle);
  if (share == 0) return {};
  const auto& x = cage.elements.positions;
  const double slack = equally_near * cage.diagonal;
  const auto near = tree.all_nearest(x[t[0]], x[t[1]], x[t[2]], slack);
  const mesh::Point center = handle_centers(cage, elements)[handle];
  double least = std::numeric_limits<double>::infinity();
  for (const auto v : near) least = std::min(least, norm(model.positions[v] - center));
  std::vector<OwnedVertices::Owned> owned;
  for (const auto v : near)
    if (norm(model.positions[v] - center) <= least + slack) owned.push_back({v, 1});
  if (owned.size() > most_shared) owned.resize(1);
  for (auto& one : owned) one.part = share / static_cast<double>(owned.size());
  return owned;
}

}  // namespace

OwnedVertices owned_vertices(const mesh::Surface& model, const pose::Cage& cage, pose::Elements elements,
                             base::WorkerPool& pool) {
  auto used = used_vertices(model);
  if (used.empty()) {
    throw base::Error("", "the model has no triangles; these weights need a surface",
                      "choose the weights \"inverse\", or another model");
  }
  const mesh::PointTree tree(model.positions, std::move(used));
  OwnedVertices owned{std::vector<std::vector<OwnedVertices::Owned>>(handle_count(cage, elements)),
                      std::vector<double>(model.positions.size(), 0)};
  pool.for_blocks(owned.of_handle.size(), 16, [&](std::size_t begin, std::size_t end) {
    for (std::size_t h = begin; h < end; ++h)
      owned.of_handle[h] = nearest_to_handle(model, tree, cage, elements, h);
  });
  for (const auto& of_one : owned.of_handle)
    for (const auto& [v, part] : of_one) owned.owners[v] += part;
  return owned;
}

void own_in_bodies(OwnedVertices& owned, const mesh::Surface& model, const Bodies& bodies,
                   const pose::Cage& cage, pose::Elements elements, base::WorkerPool& pool) {
  const auto& x = cage.elements.positions;
  const std::size_t k = owned.of_handle.size();
  std::vector<mesh::Triangle> weighing;
  for (std::size_t h = 0; h < k; ++h) {
    const auto [t, share] = handle_shape(cage, elements, h);
    if (share > 0) weighing.push_back(t);
  }
  if (weighing.empty()) return;
  const double count = count_of_handles(cage, elements);
  const mesh::TriangleTree nearest_handle(x, weighing);
  std::vector<std::vector<std::uint32_t>> members(bodies.shares.size());
  std::vector<std::vector<std::vector<OwnedVertices::Owned>>> found(members.size());
  for (const auto v : used_vertices(model)) {
    const auto body = bodies.of_vertex[v];
    if (bodies.shares[body] * count >= least_body) members[body].push_back(v);
  }
  pool.for_blocks(members.size(), 1, [&](std::size_t body, std::size_t) {
    if (members[body].empty()) return;
    const mesh::PointTree tree(model.positions, members[body]);
    for (std::size_t h = 0; h < k; ++h) {
      auto& near = found[body].emplace_back(nearest_to_handle(model, tree, cage, elements, h));
      std::erase_if(near, [&, t = handle_shape(cage, elements, h).corners](const auto& one) {
        const mesh::Point& p = model.positions[one.vertex];
        const double square = mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance;
        return square > as_near * as_near * nearest_handle.nearest(p).squared_distance;
      });
    }
  });
  for (const auto& of_body : found)
    for (std::size_t h = 0; h < of_body.size(); ++h)
      for (const auto& one : of_body[h]) {
        if (std::ranges::count(owned.of_handle[h], one.vertex, &OwnedVertices::Owned::vertex)) continue;
        owned.of_handle[h].push_back(one);
        owned.owners[one.vertex] += one.part;
      }
}

SurfaceSystem::SurfaceSystem(const mesh::Surface& model, const pose::Cage& cage,
                             const pose::Weighting& weighting, base::WorkerPool& pool,
                             base::Progress* progress)
    : SurfaceSystem(model, mesh::welded(model), cage, weighting, pool, progress) {}

SurfaceSystem::SurfaceSystem(const mesh::Surface& model, const mesh::Surface& joined, const pose::Cage& cage,
                             const pose::Weighting& weighting, base::WorkerPool& pool,
                             base::Progress* progress)
    : owned_(owned_vertices(joined, cage, weighting.elements, pool)),
      laplacian_(intrinsic_laplacian(joined)) {
  if (progress) progress->report(0);
  std::vector<double> springs(joined.positions.size(), count_of_handles(cage, weighting.elements));
  couple_parts(joined, cage, weighting, springs, pool);
  // The springs of equally near vertices are together as strong as that of a single vertex.
  for (std::size_t v = 0; v < springs.size(); ++v)
    if (owned_.owners[v] > 0) springs[v] *= std::min(1.0, owned_.owners[v]);
  std::vector<bool> is_owned(owned_.owners.size());
  for (std::size_t v = 0; v < is_owned.size(); ++v) is_owned[v] = owned_.owners[v] > 0;
  const HeldParts held = held_parts(laplacian_.stiffness, is_owned);
  if (weighting.weights == pose::Weights::biharmonic) {
    const base::ProgressPart part(progress, 0, factored_part);
    plate_.emplace(laplacian_, held, is_owned, std::move(springs), loads(), pool, progress);
  } else {
    std::vector<bool> free(is_owned.size());
    for (std::uint32_t v = 0; v < free.size(); ++v) free[v] = held.holds(v) && !is_owned[v];
    solver_.emplace(grounded(laplacian_.stiffness, free), pool, sparse::told(progress, 0, factored_part));
  }
  const auto source = sources(joined, laplacian_.stiffness, held);
  for (const auto v : mesh::lowest_in_place(model.positions)) offsets_.push_back(solver().row_of(source[v]));
  if (progress) progress->report(factored_part);
}

// Couples parts that are near to each other. In bodies with many owners per area, weakens the springs.
void SurfaceSystem::couple_parts(const mesh::Surface& joined, const pose::Cage& cage,
                                 const pose::Weighting& weighting, std::vector<double>& springs,
                                 base::WorkerPool& pool) {
  const PartedSurface parted = parted_surface(joined, laplacian_.masses);
  const mesh::EdgePaths paths(parted.surface);
  const auto found_couplings = part_couplings(parted.surface, paths, parted.masses, pool);
  const auto couplings = parted.joined(found_couplings);
  const bool plate = weighting.weights == pose::Weights::biharmonic;
  laplacian_.stiffness = with_couplings(laplacian_.stiffness, plate ? couplings : by_corners(couplings));
  const double k = count_of_handles(cage, weighting.elements);
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

const sparse::BlockSolver& SurfaceSystem::solver() const {
  return plate_ ? plate_->solver() : *solver_;
}

std::vector<ThinPlate::Load> SurfaceSystem::loads() const {
  std::vector<ThinPlate::Load> loads;
  for (std::size_t h = 0; h < handles(); ++h) {
    loads.emplace_back();
    for (const auto& owned : owned_.of_handle[h]) loads.back().push_back({owned.vertex, owned_.value(owned)});
  }
  return loads;
}

void SurfaceSystem::set_right_hand_side(std::size_t handle, std::size_t column,
                                        std::span<double> block) const {
  for (const auto& owned : owned_.of_handle[handle]) {
    const double value = owned_.value(owned);
    block[solver_->row_of(owned.vertex) + column] = value;
    for_column(laplacian_.stiffness, owned.vertex, [&](std::uint32_t other, double entry) {
      if (owned_.owners[other] == 0) block[solver_->row_of(other) + column] -= entry * value;
    });
  }
}

void SurfaceSystem::solve_block(std::size_t begin, std::size_t end, std::span<double> block) const {
  if (plate_) return plate_->solve(begin, end, block);
  for (std::size_t h = begin; h < end; ++h) set_right_hand_side(h, h - begin, block);
  solver_->solve(block, sparse::sparse_kernel(sym3::kernel()));
}

void SurfaceSystem::solve(const std::function<void(const Solved&)>& store, base::WorkerPool& pool,
                          base::Progress* progress) const {
  solver().for_blocks(handles(), pool, sparse::told(progress, factored_part, 1),
                      [&](auto begin, auto end, auto block) {
                        solve_block(begin, end, block);
                        store({begin, end - begin, block, offsets_});
                      });
}

double surface_system_bytes(std::size_t vertices) {
  // Bytes per vertex of the solved system (measured: 1200 to 3000), and per vertex of a model with a proxy.
  constexpr double solved = 1600, clustered = 150;
  return solved * static_cast<double>(solved_vertices(vertices)) +
         (vertices > most_solved_vertices ? clustered * static_cast<double>(vertices) : 0);
}

void normalise(std::span<double> weights, bool clamp) {
  if (clamp) {
    for (double& w : weights) w = std::max(w, 0.0);
  }
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  for (double& w : weights) w /= sum;
}

}  // namespace viete::weights
