// Shapes of one triangle mesh as vectors: the logs of its triangles' maps, which can be added, scaled and
// averaged, and the shape that fits given logs. The midpoint of a half turn is a quarter turn, where linear
// interpolation would collapse.
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

/// A shape as a vector; rest is 0. Sums and multiples are componentwise.
struct LogVector {
  std::vector<std::array<double, 9>> logs;  ///< per triangle: log of stretch (6), rotation vector (3)
  std::vector<Vec3>
      leftovers;             ///< per vertex: the error of the shape that fits the logs, without translation
  std::vector<Vec3> ways;    ///< per vertex: displacement from rest
  std::vector<Vec3> turns;   ///< per part of a cage: its mean rotation vector; empty for other meshes
  std::vector<Vec3> wholes;  ///< per rotating part: the rotation vector that is not in its logs
  /// A triangle whose log is far from its neighbours', and the share by which its rotation is refitted.
  struct Doubt {
    std::uint32_t triangle;
    double share;
  };
  std::vector<Doubt> doubts;  ///< only triangles with area
};

/// A vector and its factor in a sum. The vector must outlive it.
struct LogTerm {
  const LogVector* vector;
  double factor;
};

/// Converts logs of one mesh to shapes. Constant after construction: thread-safe.
///
/// The target map of triangle t is M_t = exp(W) exp(Y_t) exp(X_t), W the whole turn of its part; positions p
/// minimise
///
///     sum_t area_t |(grad p - M_t) T_t|^2,
///
/// T_t projecting onto the triangle's plane at rest: a Poisson problem (Y. Yu et al., Mesh editing with
/// Poisson-based gradient field manipulation, 2004), factored once. Vertices at the same place count as one.
/// The difference between p and a shape (logs cannot represent triangles that collapse, mirror or have no
/// area) is part of its vector, so that a shape is reproduced up to rounding.
///
/// Doubtful rotations are then replaced, by a share, by those that best fit the positions, and these are
/// solved for once more (O. Sorkine, M. Alexa, As-rigid-as-possible surface modeling, 2007): edges keep their
/// blended lengths where neighbours rotate strongly against each other.
///
/// The translation of each connected part remains free: see Held.
class LogSpace {
public:
  /// Input of the constructor; not stored.
  struct Mesh {
    std::span<const mesh::Point> positions;
    std::span<const mesh::Triangle> triangles;
    std::span<const std::uint8_t> degenerate;  ///< 1: a triangle without area, which is ignored
    std::span<const std::uint32_t> parts;      ///< per triangle, an index of LogVector::wholes
    std::size_t part_count = 0;
  };
  /// The buffers of a shape. One per thread; after the first shape nothing is allocated.
  struct Work {
    std::vector<Vec3> pulls, right, ways, straight;
    std::vector<Vec3> wholes;                // whole turns of the sum
    std::vector<sym3::Mat3<double>> turned;  // by them, per part; empty: no rotation
    std::vector<double> doubts;              // doubts of the sum, per triangle
    std::vector<std::uint32_t> doubtful;     // triangles with nonzero doubt
    std::vector<std::uint32_t> doubted;      // the places of their corners
    SparseCholesky::Workspace solve;
  };

  /// Throws base::Error if the mesh is so large or so small (beyond 1e75 and 1e-75) that it cannot be
  /// factored; base::Cancelled.
  LogSpace(const Mesh& mesh, base::WorkerPool& pool, base::Progress* progress = nullptr);

  const std::vector<mesh::Point>& rest() const { return rest_; }
  const HangingParts& parts() const { return parts_; }

  LogVector at_rest() const;
  /// Fills ways and leftovers of a vector that already has logs and wholes.
  void complete(std::span<const mesh::Point> positions, base::WorkerPool& pool, LogVector& vector) const;

  /// Anchors of the motion from a shape along a sum of others; continuous in the factors.
  Held held_from(const LogVector& from, std::span<const LogTerm> terms) const;
  /// Anchors of the motion from one shape to another.
  Held held_between(const LogVector& from, const LogVector& to) const;

  /// The shape of a sum; the same bits for any number of threads. positions.size() == rest().size().
  void shape(std::span<const LogTerm> terms, const Held& held, base::WorkerPool& pool, Work& work,
             std::span<mesh::Point> positions) const;
  /// A step of shape(): work.ways become the displacements from rest that fit the sum's logs, without
  /// leftovers; one vertex of each part is fixed. `whole`: replaces the sum's whole turns.
  void follow(std::span<const LogTerm> terms, base::WorkerPool& pool, Work& work,
              const Vec3* whole = nullptr) const;
  /// As follow(), with rotations moved by `share`, 0 to 1, towards those that best fit work.ways.
  void follow_fitted(std::span<const LogTerm> terms, double share, base::WorkerPool& pool, Work& work,
                     const Vec3* whole = nullptr) const;
  /// work.ways become the solution of the Poisson problem for work.right, which must be 0 except at places;
  /// one vertex of each part is fixed. Solves three columns at once.
  void solve(Work& work) const;

  /// Triangles with area: corners, half cotangents, and indices in the mesh.
  std::span<const mesh::Triangle> corners() const { return corners_; }
  std::span<const Vec3> cotangents() const { return cotangents_; }
  std::span<const std::uint32_t> triangles() const { return triangles_; }
  std::uint32_t place(std::uint32_t vertex) const { return places_[vertex]; }

  /// The linear sum: every vertex moves on a straight line.
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
  Vec3 pulled(std::span<const Vec3> pulls, std::size_t place) const;
  template <class Pull>
  void add_pulls_of(std::size_t i, const Pull& pull, std::span<Vec3> right) const;
  void ground(Work& work) const;
  void spread_places(Work& work) const;
  void fit_doubtful(std::span<const LogTerm> terms, Work& work) const;
  void sum_doubts(std::span<const LogTerm> terms, Work& work) const;
  Held held_along(const LogVector& from, std::span<const Vec3> ways, std::span<const double> squares) const;

  std::vector<mesh::Point> rest_;
  std::size_t part_count_;
  std::vector<std::uint32_t> index_of_;   // per triangle with area: its index in the arrays below
  std::vector<std::uint32_t> triangles_;  // triangles with area
  std::vector<mesh::Triangle> corners_;   // corners of triangles_
  std::vector<mesh::Triangle> placed_;    // corners_ as places
  std::vector<std::uint32_t> part_of_;    // part of triangles_
  std::vector<Vec3> cotangents_;       // half cotangents of triangles_, each of the edge opposite to a corner
  base::AlignedVector<double> sides_;  // edges, then cotangents, by blocks in planes: PlaneKernel::pull
  std::vector<std::uint32_t> places_;  // per vertex the first vertex at its place: the unknowns
  mesh::Adjacency around_;             // 3 i + corner, for each place
  HangingParts parts_;
  std::vector<std::uint32_t> copies_;    // vertices that are not the first at their place
  std::vector<std::uint32_t> grounded_;  // per part one fixed place
  SparseCholesky factors_;
};

}  // namespace viete::deform
