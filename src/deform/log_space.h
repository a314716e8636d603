// Shapes of one triangle mesh as vectors: the logs of its triangles' maps, which are added, scaled and
// averaged, and the shape that follows given logs. Halfway to a half turn is a quarter turn there, where a
// straight line would collapse.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/held.h"
#include "deform/plane_kernel.h"
#include "deform/sparse/sparse_cholesky.h"
#include "mesh/adjacency.h"
#include "mesh/surface.h"
#include "mesh/union_find.h"
#include "sym3/rotation.h"

namespace viete::deform {

/// A shape as a vector; rest is 0. Sums and multiples are taken number by number.
struct LogVector {
  std::vector<std::array<double, 9>> logs;  ///< of each triangle: log of stretch (6), rotation vector (3)
  std::vector<Vec3>
      leftovers;             ///< of each vertex: what the shape that follows the logs misses, but its place
  std::vector<Vec3> ways;    ///< of each vertex: from rest
  std::vector<Vec3> turns;   ///< of each part of a cage: its mean rotation vector; of other meshes none
  std::vector<Vec3> wholes;  ///< of each turning part: the rotation vector that is not in its logs
  /// A triangle whose log is far from its neighbours': by which share of it the rotation is fitted.
  struct Doubt {
    std::uint32_t triangle;
    double share;
  };
  std::vector<Doubt> doubts;  ///< of triangles with area
};

/// A share of a shape in a sum. The vector outlives it.
struct LogTerm {
  const LogVector* vector;
  double factor;
};

/// Takes logs of one mesh to shapes. Constant once it is made: thread-safe.
///
/// Triangle t is to be mapped by M_t = exp(W) exp(Y_t) exp(X_t), W the whole turn of its part; positions p
/// minimise
///
///     sum_t area_t |(grad p - M_t) T_t|^2,
///
/// T_t projecting onto the triangle's plane at rest: a Poisson problem (Y. Yu et al., Mesh editing with
/// Poisson-based gradient field manipulation, 2004), factored once. Vertices at the same place are one there.
/// What p misses of a shape (triangles that collapse, mirror or have no area cannot be told by their logs) is
/// part of its vector, so that a shape comes back as it was, up to rounding.
///
/// Then rotations that are doubtful are replaced, by a share, by those that fit the positions best, and these
/// are solved for once more (O. Sorkine, M. Alexa, As-rigid-as-possible surface modeling, 2007): edges keep
/// their blended lengths where neighbours turn much against each other.
///
/// That leaves one translation of each connected part: see Held.
class LogSpace {
public:
  /// What it is made of; none of it is kept.
  struct Mesh {
    std::span<const mesh::Point> positions;
    std::span<const mesh::Triangle> triangles;
    std::span<const std::uint8_t> degenerate;  ///< 1: a triangle without area, which has no say
    std::span<const std::uint32_t> parts;      ///< of each triangle, a place in LogVector::wholes
    std::size_t part_count = 0;
  };
  /// The buffers of a shape. For one thread at a time; after the first shape nothing is allocated.
  struct Work {
    std::vector<Vec3> pulls, right, ways, straight;
    std::vector<Vec3> wholes;                // of the sum
    std::vector<sym3::Mat3<double>> turned;  // by them; empty: none turns
    std::vector<double> doubts;              // of the sum; of all triangles
    std::vector<std::uint32_t> doubtful;     // which are not 0
    std::vector<std::uint32_t> doubted;      // the places of their corners
    SparseCholesky::Workspace solve;
  };

  /// Throws base::Error if the mesh is so large or so small (beyond 1e75 and 1e-75) that it cannot be
  /// factored; base::Cancelled.
  LogSpace(const Mesh& mesh, base::WorkerPool& pool, base::Progress* progress = nullptr);

  const std::vector<mesh::Point>& rest() const { return rest_; }
  const HangingParts& parts() const { return parts_; }

  LogVector at_rest() const;
  /// Fills ways and leftovers of a vector that has logs and wholes.
  void complete(std::span<const mesh::Point> positions, base::WorkerPool& pool, LogVector& vector) const;

  /// Where the shape is held on the way that goes on from a shape by a sum of others; continuous in the
  /// factors.
  Held held_from(const LogVector& from, std::span<const LogTerm> terms) const;
  /// On the way from one shape to another.
  Held held_between(const LogVector& from, const LogVector& to) const;

  /// The shape of a sum; the same bits for any number of threads. positions.size() == rest().size().
  void shape(std::span<const LogTerm> terms, const Held& held, base::WorkerPool& pool, Work& work,
             std::span<mesh::Point> positions) const;
  /// The parts of shape(): work.ways become what follows the sum's logs, from rest, without leftovers; one
  /// vertex of each part stays. `whole`: in place of the sum's whole turns.
  void follow(std::span<const LogTerm> terms, base::WorkerPool& pool, Work& work,
              const Vec3* whole = nullptr) const;
  /// Again, with rotations replaced, by a share of 0 to 1, by those that fit work.ways best.
  void follow_fitted(std::span<const LogTerm> terms, double share, base::WorkerPool& pool, Work& work,
                     const Vec3* whole = nullptr) const;
  /// work.ways become the solution of the Poisson problem for work.right, which is not 0 but at places; one
  /// vertex of each part stays. Three columns at once.
  void solve(Work& work) const;

  /// Triangles with area: their number, corners and halved cotangents, and which ones of the mesh.
  std::span<const mesh::Triangle> corners() const { return corners_; }
  std::span<const Vec3> cotangents() const { return cotangents_; }
  std::span<const std::uint32_t> triangles() const { return triangles_; }
  std::uint32_t place(std::uint32_t vertex) const { return places_[vertex]; }

  /// The same with each vertex on its straight way.
  void straight(std::span<const LogTerm> terms, std::span<mesh::Point> positions) const;

private:
  class Block;

  SparseMatrix add_triangles(const Mesh& mesh);
  void fill_sides();
  const Plane* sides_of(std::size_t i) const {
    return reinterpret_cast<const Plane*>(sides_.data()) + i / plane_size * 12;
  }
  void find_parts(mesh::UnionFind sets);
  void turn_by(std::span<const LogTerm> terms, const Vec3* whole, Work& work) const;
  void load(std::span<const LogTerm> terms, double share, base::WorkerPool& pool, Work& work) const;
  template <class Make>
  void add_pulls(const Make& make, base::WorkerPool& pool, Work& work) const;
  template <class Make>
  void scatter_pulls(const Make& make, Work& work) const;
  template <class Make>
  void gather_pulls(const Make& make, base::WorkerPool& pool, Work& work) const;
  Vec3 pulled(std::span<const Vec3> pulls, std::size_t place) const;
  template <class Pull>
  void add_pulls_of(std::size_t i, const Pull& pull, std::span<Vec3> right) const;
  void ground(Work& work) const;
  void spread_places(Work& work) const;
  void fit_doubtful(std::span<const LogTerm> terms, Work& work) const;
  void sum_doubts(std::span<const LogTerm> terms, Work& work) const;

  std::vector<mesh::Point> rest_;
  std::size_t part_count_;
  std::vector<std::uint32_t> index_of_;   // of each triangle with area its place in what follows
  std::vector<std::uint32_t> triangles_;  // that have area
  std::vector<mesh::Triangle> corners_;   // theirs
  std::vector<mesh::Triangle> placed_;    // the places of these
  std::vector<std::uint32_t> part_of_;    // theirs
  std::vector<Vec3> cotangents_;          // theirs, halved, each of the side across from a corner
  base::AlignedVector<double> sides_;     // theirs and those, block by block in planes: see PlaneKernel::pull
  std::vector<std::uint32_t> places_;     // of each vertex the first that is at its place: the unknowns
  mesh::Adjacency around_;                // 3 i + corner, of each place
  HangingParts parts_;
  std::vector<std::uint32_t> copies_;    // vertices that are not the first at their place
  std::vector<std::uint32_t> grounded_;  // of each part a place that stays
  SparseCholesky factors_;
};

}  // namespace viete::deform
