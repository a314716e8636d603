// Weights along the model's surface, from the vertices that handles own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/cage.h"
#include "deform/laplacian.h"
#include "deform/part_coupling.h"
#include "deform/scheme.h"
#include "deform/sparse/sparse_cholesky.h"
#include "deform/thin_plate.h"

namespace viete::deform {

/// Approximate number of vertices of a proxy.
inline constexpr std::size_t proxy_vertices = 40'000;
/// Weights along the surface of models with more vertices are solved on a proxy. For smaller models a proxy
/// saves little time.
inline constexpr std::size_t most_solved_vertices = 2 * proxy_vertices;

/// The vertex that each handle owns: the nearest corner of the model's triangles; ties: the lowest index.
/// Handles without weight (see handle_shape()) own none.
struct OwnedVertices {
  static constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> of_handle;  ///< or none
  std::vector<std::uint32_t> owners;     ///< number of owning handles per vertex
  /// Additional vertices of a handle, one in each near body; empty if there is one body.
  std::vector<std::vector<std::uint32_t>> elsewhere;
};

/// Distances are exact: to the triangle or the vertex. Throws base::Error if the model has no triangles. O(k
/// log n). candidates: the vertices to choose from, corners of triangles; empty: all of these.
OwnedVertices owned_vertices(const mesh::Surface& model, const Cage& cage, Elements elements,
                             base::WorkerPool& pool, std::span<const std::uint32_t> candidates = {});

/// Adds the vertex nearest to each handle in every body near the handle: bodies where no other handle is less
/// than two thirds as far away. Layers and their contents thus follow the cage alike, and adding a body takes
/// no vertices from others. Bodies of less than a tenth of a handle's share of the area get none. In bodies
/// without candidates all vertices are candidates.
void own_in_bodies(OwnedVertices& owned, const mesh::Surface& model, const Bodies& bodies, const Cage& cage,
                   Elements elements, base::WorkerPool& pool, std::span<const std::uint32_t> candidates = {});

/// Solves for the weights of sixteen handles at a time; the caller decides which of them to store, and how.
///
/// With L of intrinsic_laplacian(), `harmonic` weights of handle k are 1 / m at the vertex that it owns, m
/// being the number of handles that own it, 0 at vertices of other handles, and L w = 0 elsewhere. They are
/// in [0, 1] up to the rounding of 1 (the maximum principle: L has no negative weights).
///
/// `biharmonic` weights minimise
///
///     w^T L M^-1 L w + s sum over owned vertices v of (w_v - its value above)^2,    s = K
///
/// M being the masses (total area 1), K the number of handles: a thin plate on springs (ThinPlate). They are
/// smoother, leave [0, 1], and interpolate their values only approximately. Published tools do the same, but
/// omit M, so that their weights depend on the triangulation, and use the springs' strength also as the
/// value.
///
/// Vertices at the same place count as one: texture seams, sharp edges, and triangles without shared vertices
/// do not tear. part_couplings() join near parts and cracks in L, and handles own a vertex in each of several
/// bodies (own_in_bodies(), s by the area): weights across bodies depend on distance in space, and no pose
/// tears the model.
///
/// A part without an owned vertex, or a vertex of no triangle, copies the weights of the vertex nearest to
/// its middle among parts with owned vertices: such a part moves as a whole.
///
/// Rows sum to 1 up to rounding and the condition of the equations: callers divide by the sum.
class SurfaceSystem {
public:
  /// Factors the matrix. Reports progress up to `done`. Throws base::Cancelled; base::Error if the model has
  /// no triangles, memory is short, or the system has no solution in double precision. Handles own vertices
  /// among the candidates, as in owned_vertices().
  SurfaceSystem(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
                base::WorkerPool& pool, base::Progress* progress = nullptr, double done = 1,
                std::span<const std::uint32_t> candidates = {});

  std::size_t vertices() const { return offsets_.size(); }
  std::size_t handles() const { return owned_.of_handle.size(); }

  /// Weights of handles [first, first + count), at most solved_columns of them.
  struct Solved {
    std::size_t first, count;
    std::span<const double> block;
    std::span<const std::size_t> offsets;
    const double* of(std::size_t vertex) const { return block.data() + offsets[vertex]; }
  };
  /// Calls store() for all handles, from any thread of the pool; weights are invalid after it returns.
  /// Reports progress from `from` to `to`. Throws base::Cancelled. The same bits for any number of threads.
  void solve(const std::function<void(const Solved&)>& store, base::WorkerPool& pool,
             base::Progress* progress, double from = 0, double to = 1) const;

private:
  SurfaceSystem(const mesh::Surface& model, const mesh::Surface& joined, const Cage& cage,
                const Weighting& weighting, base::WorkerPool& pool, base::Progress* progress, double done,
                std::span<const std::uint32_t> candidates);
  void couple_parts(const mesh::Surface& joined, const Cage& cage, const Weighting& weighting,
                    std::span<const std::uint32_t> candidates, std::vector<double>& springs,
                    base::WorkerPool& pool);
  const BlockSolver& solver() const;
  std::vector<ThinPlate::Load> loads() const;
  void set_right_hand_side(std::size_t handle, std::size_t column, std::span<double> block) const;
  void solve_block(std::size_t begin, std::size_t end, std::span<double> block) const;

  OwnedVertices owned_;
  IntrinsicLaplacian laplacian_;
  std::optional<BlockSolver> solver_;  // for harmonic weights
  std::optional<ThinPlate> plate_;     // for biharmonic weights
  std::vector<std::size_t> offsets_;   // offset of each vertex in a block
};

/// Approximate upper bound of the bytes of a SurfaceSystem and one block per thread.
double surface_system_bytes(std::size_t vertices);

/// Scales weights to sum 1; with clamp, negative weights become 0 first.
void normalise(std::span<double> weights, bool clamp = false);

}  // namespace viete::deform
