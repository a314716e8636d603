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
#include "pose/cage.h"
#include "pose/deformer.h"
#include "sparse/sparse_cholesky.h"
#include "weights/laplacian.h"
#include "weights/part_coupling.h"
#include "weights/thin_plate.h"

namespace viete::weights {

/// Approximate number of vertices of a proxy.
inline constexpr std::size_t proxy_vertices = 40'000;
/// Models with more vertices use a proxy. For smaller models, a proxy saves little time.
inline constexpr std::size_t most_solved_vertices = 2 * proxy_vertices;
/// Returns the approximate number of vertices of a model, or of its proxy, whose weights are solved for.
constexpr std::size_t solved_vertices(std::size_t vertices) {
  return vertices > most_solved_vertices ? proxy_vertices : vertices;
}

/// Each handle owns the vertex nearest to it. Of vertices that are equally near up to rounding errors, it
/// owns the one nearest to its center; if several are, it owns each of them in part. Vertices without
/// triangles have no owner. Handles own no vertex if HandleShape::share is 0.
struct OwnedVertices {
  struct Owned {
    std::uint32_t vertex;
    double part;  ///< HandleShape::share / (number of equally near vertices)
  };
  std::vector<std::vector<Owned>> of_handle;  ///< several vertices also if several bodies are near
  std::vector<double> owners;                 ///< the sum of the parts that handles own of each vertex

  /// Returns t of SurfaceSystem for the handle that owns `owned`.
  double value(const Owned& owned) const { return owned.part / owners[owned.vertex]; }
};

/// Finds the vertices by exact distances. Throws base::Error if the model has no triangles.
OwnedVertices owned_vertices(const mesh::Surface& model, const pose::Cage& cage, pose::Elements elements,
                             base::WorkerPool& pool);

/// Lets each handle own one vertex in each body near it, so that a layer and its contents follow the cage
/// alike. v is the body's vertex nearest to the handle. The body is near if the handle is at most 4 times
/// as far from v as the handle that is nearest to v. Skips bodies with less than a tenth of the mean area per
/// handle.
void own_in_bodies(OwnedVertices& owned, const mesh::Surface& model, const Bodies& bodies,
                   const pose::Cage& cage, pose::Elements elements, base::WorkerPool& pool);

/// Solves for the weights of sixteen handles at a time. The caller stores the weights.
///
/// The `harmonic` weights w of a handle are fixed at owned vertices: w = t, with t = 1 / (number of owners)
/// if the handle owns the vertex, otherwise t = 0. Owners in part count as fractions. At vertices that no
/// handle owns, L * w = 0, with L of intrinsic_laplacian(). L has no negative edge weights, so w is in [0, 1]
/// up to rounding.
///
/// `biharmonic` weights minimise
///
///     w^T * L * M^-1 * L * w + s * sum over owned vertices v of (w_v - t_v)^2,    s = number of handles.
///
/// The handles of a polygon with a center count as n - 2 in s. M contains the masses (total area 1). This is
/// a thin plate on springs, see ThinPlate. Biharmonic weights are smoother than harmonic weights. They can be
/// outside of [0, 1], and w_v is only approximately t_v. Published tools omit M, so their weights depend on
/// the triangulation.
///
/// Vertices at one position count as one vertex, so that seams, sharp edges and separate triangles do not
/// tear. part_couplings() joins near parts and cracks in L. If there are several bodies, a handle owns a
/// vertex in each body near it, see own_in_bodies(). Then s is lower in bodies with many owners per area.
///
/// A part without owned vertices moves as a whole. All its vertices copy the weights of one vertex: the
/// vertex that is nearest to the part's middle and is in a part with owned vertices. A vertex without
/// triangles is a part without owned vertices.
///
/// The weights of a vertex sum to 1 only approximately. Callers must divide by the sum.
class SurfaceSystem {
public:
  /// Factors the matrix. Reports less than half of the progress.
  /// Throws base::Cancelled. Throws base::Error if the model has no triangles, memory is insufficient, or the
  /// system has no solution in double precision.
  SurfaceSystem(const mesh::Surface& model, const pose::Cage& cage, const pose::Weighting& weighting,
                base::WorkerPool& pool, base::Progress* progress = nullptr);

  std::size_t vertices() const { return offsets_.size(); }
  std::size_t handles() const { return owned_.of_handle.size(); }

  /// Weights of handles [first, first + count). `count` is at most solved_columns.
  struct Solved {
    std::size_t first, count;
    std::span<const double> block;
    std::span<const std::size_t> offsets;
    const double* of(std::size_t vertex) const { return block.data() + offsets[vertex]; }
  };
  /// Calls store() for all handles, from any thread of the pool. Weights are invalid after store() returns.
  /// Reports the rest of the progress. Throws base::Cancelled. Results do not depend on the thread count.
  void solve(const std::function<void(const Solved&)>& store, base::WorkerPool& pool,
             base::Progress* progress) const;

private:
  SurfaceSystem(const mesh::Surface& model, const mesh::Surface& joined, const pose::Cage& cage,
                const pose::Weighting& weighting, base::WorkerPool& pool, base::Progress* progress);
  void couple_parts(const mesh::Surface& joined, const pose::Cage& cage, const pose::Weighting& weighting,
                    std::vector<double>& springs, base::WorkerPool& pool);
  const sparse::BlockSolver& solver() const;
  std::vector<ThinPlate::Load> loads() const;
  void set_right_hand_side(std::size_t handle, std::size_t column, std::span<double> block) const;
  void solve_block(std::size_t begin, std::size_t end, std::span<double> block) const;

  OwnedVertices owned_;
  IntrinsicLaplacian laplacian_;
  std::optional<sparse::BlockSolver> solver_;  // for harmonic weights
  std::optional<ThinPlate> plate_;             // for biharmonic weights
  std::vector<std::size_t> offsets_;           // offset of each vertex in a block
};

/// Returns the approximate number of bytes of a SurfaceSystem, or of a proxy and its system, and one block
/// per thread. Models of many parts can take twice as much.
double surface_system_bytes(std::size_t vertices);

/// Scales weights to sum 1. If `clamp` is true, first sets negative weights to 0.
void normalise(std::span<double> weights, bool clamp = false);

}  // namespace viete::weights
