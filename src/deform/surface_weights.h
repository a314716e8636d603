// Weights that live on the model's surface: how much of each handle a vertex takes is decided along the
// surface, from vertices that belong to handles.
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

/// The vertex of the model that each handle owns: of its triangles' corners the one that is nearest to the
/// handle, the lowest of those that are equally near. Handles that do not weigh (see handle_shape()) own
/// none.
struct OwnedVertices {
  static constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  std::vector<std::uint32_t> of_handle;  ///< or none
  std::vector<std::uint32_t> owners;     ///< how many each vertex has
  /// More that a handle owns, one in each body that it is near; empty where there is one body.
  std::vector<std::vector<std::uint32_t>> elsewhere;
};

/// Distances are exact: to the triangle or the vertex. Throws base::Error where the model has no
/// triangles. O(k log n).
OwnedVertices owned_vertices(const mesh::Surface& model, const Cage& cage, Elements elements,
                             base::WorkerPool& pool);

/// Adds the vertex nearest to each handle in every body that the handle is near: where no other is less than
/// two thirds as far away. So layers and what they enclose follow the cage alike, and none gives up its
/// vertices when another is added. Bodies of less than a tenth of a handle's share of the area get none.
void own_in_bodies(OwnedVertices& owned, const mesh::Surface& model, const Bodies& bodies, const Cage& cage,
                   Elements elements, base::WorkerPool& pool);

/// Solves for the weights of sixteen handles at a time; which of them are kept, and how, is for the caller to
/// say.
///
/// With L of intrinsic_laplacian(), `harmonic` weights of handle k are 1 / m at the vertex that it owns, m
/// handles sharing it, 0 at those of others, and L w = 0 elsewhere. They are in [0, 1] (the maximum
/// principle: L has no negative weights), to the rounding of 1.
///
/// `biharmonic` weights minimise
///
///     w^T L M^-1 L w + s sum over owned vertices v of (w_v - its value above)^2,    s = K
///
/// M being the masses, the area 1, and K the number of handles: a thin plate on springs (ThinPlate). They are
/// smoother, leave [0, 1], and do not quite take their values. Of published tools they keep that; not that
/// there is no M in them, so that they depend on how the model is cut into triangles, nor that the springs'
/// strength is also the value.
///
/// Vertices at the same place are one: seams of textures and sharp edges do not tear, nor do triangles that
/// share no vertices. Parts that lie near each other, and cracks, are held together by part_couplings(),
/// which L then has too, and handles own a vertex in each body of several (own_in_bodies(), s by the area):
/// weights are a matter of space there, and no pose tears the model.
///
/// A part of the model without an owned vertex, and a vertex of no triangle, take over the weights of the
/// vertex nearest to their middle that has a part with one: all of such a part moves as one.
///
/// Rows sum to 1 up to rounding and what the equations' condition makes of it: callers divide by the sum.
class SurfaceSystem {
public:
  /// Factors. Reports up to `done`. Throws base::Cancelled; base::Error when the model has no triangles, when
  /// there is not the memory, or when the system has no solution in double precision.
  SurfaceSystem(const mesh::Surface& model, const Cage& cage, const Weighting& weighting,
                base::WorkerPool& pool, base::Progress* progress = nullptr, double done = 1);

  std::size_t vertices() const { return offsets_.size(); }
  std::size_t handles() const { return owned_.of_handle.size(); }

  /// Weights of handles [first, first + count), at most solved_columns of them.
  struct Solved {
    std::size_t first, count;
    std::span<const double> block;
    std::span<const std::size_t> offsets;
    const double* of(std::size_t vertex) const { return block.data() + offsets[vertex]; }
  };
  /// store() is called for all handles, from any thread of the pool; weights are gone when it returns.
  /// Reports from `from` to `to`. Throws base::Cancelled. The same bits for any number of threads.
  void solve(const std::function<void(const Solved&)>& store, base::WorkerPool& pool,
             base::Progress* progress, double from = 0, double to = 1) const;

private:
  SurfaceSystem(const mesh::Surface& model, const mesh::Surface& joined, const Cage& cage,
                const Weighting& weighting, base::WorkerPool& pool, base::Progress* progress, double done);
  void couple_parts(const mesh::Surface& joined, const Cage& cage, const Weighting& weighting,
                    std::vector<double>& springs, base::WorkerPool& pool);
  const BlockSolver& solver() const;
  std::vector<ThinPlate::Load> loads() const;
  void set_right_hand_side(std::size_t handle, std::size_t column, std::span<double> block) const;
  void solve_block(std::size_t begin, std::size_t end, std::span<double> block) const;

  OwnedVertices owned_;
  IntrinsicLaplacian laplacian_;
  std::optional<BlockSolver> solver_;  // of harmonic weights
  std::optional<ThinPlate> plate_;     // of biharmonic ones
  std::vector<std::size_t> offsets_;   // of a vertex in a block
};

/// Bytes that a SurfaceSystem and a block for each thread take at most, roughly.
double surface_system_bytes(std::size_t vertices);

/// Scales weights so that they sum to 1; with clamp those below 0 become 0 first.
void normalise(std::span<double> weights, bool clamp = false);

}  // namespace viete::deform
