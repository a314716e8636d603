// Converts shapes of a triangle mesh to vectors of logs, and back. Vectors can be added and scaled: half of a
// half turn is a quarter turn. With linear interpolation of positions, a half turn would collapse the shape.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/memory.h"
#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/surface.h"
#include "mesh/union_find.h"
#include "shapes/anchors.h"
#include "shapes/plane_kernel.h"
#include "sparse/sparse_cholesky.h"
#include "sym3/rotation.h"
#include "weights/part_coupling.h"

namespace viete::shapes {

/// A shape as a vector; the rest shape is 0. Sums and multiples are componentwise.
struct LogVector {
  std::vector<std::array<double, 9>> logs;  ///< per triangle: log of stretch (6), rotation vector (3)
  /// Per vertex: the shape minus the shape reconstructed from the logs. Both are translated to the same mean.
  std::vector<Vec3> leftovers;
  std::vector<Vec3> displacements;  ///< per vertex: displacement from rest
  std::vector<Vec3> turns;          ///< per part of a cage: the mean rotation vector; empty for other meshes
  std::vector<Vec3> wholes;         ///< per part: a rotation vector that is applied in addition to the logs
  /// A triangle whose log is far from its neighbours' logs. `share` is from 0 to 1: the rotation of the
  /// triangle moves by this factor towards the rotation that best fits the positions.
  struct Doubt {
    std::uint32_t triangle;
    double share;
  };
  std::vector<Doubt> doubts;  ///< only triangles with area
  /// Only for a model with a CoarseModel, whose shape the other members describe. Per vertex of the model:
  /// displacement from rest; and the shape minus the shape that follows the clusters, in coordinates that
  /// rotate with the clusters.
  std::vector<Vec3> fine_displacements, details;
};

struct LogTerm {
  const LogVector* vector;
  double factor;
};

/// Returns the weighted sum of one entry of a member; entries after the end of a vector are 0.
Vec3 summed(std::span<const LogTerm> terms, std::vector<Vec3> LogVector::*member, std::size_t i);

/// Converts logs of one mesh to shapes. Thread-safe: constant after construction.
///
/// The target map of triangle t is M_t = exp(W) exp(Y_t) exp(X_t). W is the whole turn of the triangle's
/// part, Y_t the rotation vector and X_t the log of stretch. The positions p minimize
///
///     sum_t area_t * |(grad p - M_t) T_t|^2.
///
/// T_t projects onto the triangle's plane at rest. This is a Poisson problem (Y. Yu et al., Mesh editing with
/// Poisson-based gradient field manipulation, 2004); the matrix is factored once. Vertices at one position
/// count as one vertex. Logs cannot represent triangles that collapse, mirror or have no area. Therefore a
/// vector also stores the difference between its shape and p, and reproduces the shape up to rounding.
///
/// A second step moves the rotations of doubtful triangles (see LogVector::Doubt) towards rotations that best
/// fit the positions, and solves again (O. Sorkine, M. Alexa, As-rigid-as-possible surface modeling, 2007).
/// This keeps edge lengths if the rotations of neighbours differ strongly. The anchors (see AnchorWeights)
/// determine the translations of the parts.
///
/// A coupling of the vertices a and b keeps the map of a triangle at a, M, between them: it adds the energy
/// strength * |(p_a - p_b) - M * (rest_a - rest_b)|^2, and its two parts count as one.
class LogSpace {
public:
  struct Mesh {
    std::span<const mesh::Point> positions;
    std::span<const mesh::Triangle> triangles;
    std::span<const std::uint8_t> degenerate;  ///< 1: the triangle has no area and is ignored
    std::span<const std::uint32_t> parts;      ///< per triangle, an index into LogVector::wholes
    std::size_t part_count = 0;
    std::span<const weights::Coupling> couplings{};  ///< join parts; results of vertex_couplings()
  };
  /// The buffers of one thread. Reuse avoids allocations.
  struct Work {
    std::vector<Vec3> pulls, right, displacements, straight;
    std::vector<Vec3> wholes;                // per part: weighted sum of LogVector::wholes
    std::vector<sym3::Mat3<double>> turned;  // rotation matrices of wholes; empty if all wholes are 0
    std::vector<double> doubts;              // per triangle: weighted sum of Doubt::share
    std::vector<std::uint32_t> doubtful;     // triangles with nonzero doubts
    std::vector<std::uint32_t> doubted;      // corners of doubtful triangles, see place()
    sparse::SparseCholesky::Workspace solve;
  };

  /// Throws base::Cancelled. Throws base::Error if the size of the mesh is not between 1e-75 and 1e75.
  LogSpace(const Mesh& mesh, base::WorkerPool& pool, base::Progress* progress = nullptr);

  const std::vector<mesh::Point>& rest() const { return rest_; }
  const AnchoredParts& parts() const { return parts_; }

  LogVector at_rest() const;
  /// Computes vector.displacements and vector.leftovers for the shape `positions`, from vector.logs and
  /// vector.wholes.
  void complete(std::span<const mesh::Point> positions, base::WorkerPool& pool, LogVector& vector) const;

  /// Returns the anchors of the motion that adds `terms` to the shape `from`; continuous in the factors.
  AnchorWeights anchors_from(const LogVector& from, std::span<const LogTerm> terms) const;
  AnchorWeights anchors_between(const LogVector& from, const LogVector& to) const;

  /// Computes the shape of a sum. positions.size() must be rest().size(). The number of threads does not
  /// change the result.
  void shape(std::span<const LogTerm> terms, const AnchorWeights& anchors, base::WorkerPool& pool, Work& work,
             std::span<mesh::Point> positions) const;
  /// The first step of shape(): sets work.displacements to the displacements that fit the sum's logs, without
  /// leftovers. One vertex of each part does not move. If `whole` is not null, *whole is used as whole turn
  /// of all parts.
  void follow(std::span<const LogTerm> terms, base::WorkerPool& pool, Work& work,
              const Vec3* whole = nullptr) const;
  /// Like follow(), but moves all rotations by the factor `share` (0 to 1) towards the rotations that best
  /// fit the displacements work.displacements.
  void follow_fitted(std::span<const LogTerm> terms, double share, base::WorkerPool& pool, Work& work,
                     const Vec3* whole = nullptr) const;
  /// Solves the Poisson problem for the right-hand side work.right, and writes the solution to
  /// work.displacements. work.right must be 0 except at places (see place()). One vertex of each part does
  /// not move. Solves all three coordinates at once.
  void solve(Work& work) const;

  /// The triangles with area, then the couplings of a and b as triangles (a, b, b): corners, half cotangents
  /// and indices in the mesh. place() returns the first vertex at the position of `vertex`.
  std::span<const mesh::Triangle> corners() const { return corners_; }
  std::span<const Vec3> cotangents() const { return cotangents_; }
  std::span<const std::uint32_t> triangles() const { return triangles_; }
  std::uint32_t place(std::uint32_t vertex) const { return places_[vertex]; }

  /// Computes the linear sum, in which every vertex moves on a straight line.
  void linear(std::span<const LogTerm> terms, std::span<mesh::Point> positions) const;

private:
  class Block;

  sparse::SparseMatrix add_triangles(const Mesh& mesh);
  std::vector<weights::Coupling> add_couplings(std::span<const weights::Coupling> couplings);
  void add_masses();
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
  AnchorWeights anchors_along(const LogVector& from, std::span<const Vec3> displacements,
                              std::span<const double> squares) const;

  std::vector<mesh::Point> rest_;
  std::size_t part_count_;
  std::vector<std::uint32_t> index_of_;   // per triangle of the mesh: its index in the arrays below
  std::vector<std::uint32_t> triangles_;  // triangles with area, then a triangle at each coupling
  std::vector<mesh::Triangle> corners_;   // corners of triangles_
  std::vector<mesh::Triangle> placed_;    // places of corners_
  std::vector<std::uint32_t> part_of_;    // parts of triangles_
  std::vector<Vec3> cotangents_;          // half cotangents of triangles_, one per corner
  base::AlignedVector<double> sides_;     // sides and half cotangents, block by block, see PlaneKernel::pull
  std::vector<std::uint32_t> places_;     // per vertex: its place, which is the first vertex at its position
  mesh::Adjacency around_;  // per place: 3 * i + k for each corner k of triangles_[i] at the place
  AnchoredParts parts_;
  std::vector<std::uint32_t> copies_;    // vertices that are not places
  std::vector<std::uint32_t> grounded_;  // one fixed place per part
  sparse::SparseCholesky factors_;
};

}  // namespace viete::shapes
