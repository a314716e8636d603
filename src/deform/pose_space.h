// Poses as vectors: the logs of a cage's triangles, which are added, scaled and averaged, and the cage that
// follows given logs. Halfway to a half turn is a quarter turn there, where a straight line would collapse.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "deform/element_maps.h"
#include "deform/log_maps.h"
#include "deform/map_split.h"
#include "deform/sparse/sparse_cholesky.h"

namespace viete::deform {

/// A pose as a vector, whatever elements the model is bound with; rest is 0. Sums and multiples are taken
/// number by number.
struct PoseVector {
  std::vector<std::array<double, 9>> logs;  ///< of each triangle: log of stretch (6), rotation vector (3)
  std::vector<Vec3> leftovers;  ///< of each vertex: what the cage that follows the logs misses, but its place
  std::vector<Vec3> ways;       ///< of each vertex: from rest
  std::vector<Vec3> turns;      ///< of each part of the cage: its mean rotation vector
  std::vector<Vec3> wholes;     ///< of each part: the whole turns, radians, that its logs cannot tell
};

/// A share of a pose in a sum. The vector outlives it.
struct PoseTerm {
  const PoseVector* vector;
  double factor;
};
/// Rest for no terms. They must be of the same cage.
PoseVector sum(const Cage& cage, std::span<const PoseTerm> terms);

/// Where the cage is held while it moves: of each vertex a share of the point that goes its straight way, one
/// point a connected part. See PoseSpace.
using Held = std::vector<double>;

/// Takes poses of one cage to vectors and back. Constant once it is made: thread-safe.
///
/// Back: triangle t is to be mapped by M_t = exp(Y_t) exp(X_t), turned by the whole turns that are not in Y_t
/// (those about another axis than the one it is turned about, see choose_branches()); positions p minimise
///
///     sum_t area_t |(grad p - M_t) T_t|^2,
///
/// T_t projecting onto the triangle's plane at rest: a Poisson problem (Y. Yu et al., Mesh editing with
/// Poisson-based gradient field manipulation, 2004), factored once. Vertices at the same place are one there.
/// What p misses of a pose (elements that collapse, mirror or have no area cannot be told by their logs) is
/// part of its vector, so that a pose comes back as it was, up to rounding.
///
/// That leaves one translation of each connected part: a point of it goes its straight way. It is the mean of
/// the vertices, those counting most that move least, so that what stands still, stands, and a limb turns
/// about where it hangs; or, as far as the part moves as an affine map does, the point that such a map moves
/// least, so that what turns as a whole turns about its axis.
class PoseSpace {
public:
  /// Throws base::Error if the cage is so large or so small (beyond 1e75 and 1e-75) that it cannot be
  /// factored.
  explicit PoseSpace(std::shared_ptr<const Cage> cage);

  const Cage& cage() const { return *cage_; }
  /// Of whole turns those that the pose has, or, if it says nothing of them, those nearest to `turns_before`,
  /// as of the pose that came before it (missing: 0). Throws base::Error if the pose has not one position per
  /// vertex.
  PoseVector vector(const Pose& pose, std::span<const Vec3> turns_before = {}) const;
  /// On the way that goes on from a pose by a sum of others; continuous in the factors.
  Held held_from(const PoseVector& from, std::span<const PoseTerm> terms) const;
  /// On the way from one pose to another.
  Held held_between(const PoseVector& from, const PoseVector& to) const;
  /// The pose of a vector, or of a sum of them.
  Pose pose(const PoseVector& vector, const Held& held) const;
  /// The same with each vertex on its straight way.
  Pose straight(const PoseVector& vector) const;

private:
  /// What of the Poisson problem does not change with the pose. Unknowns are places: a vertex's is the first
  /// vertex there.
  struct System {
    std::vector<std::uint32_t> triangles;  ///< that have area at rest
    std::vector<Vec3> cotangents;          ///< theirs, halved, each of the side across from a corner
    std::vector<std::uint32_t> places;     ///< of the vertices
    mesh::Adjacency parts;                 ///< the vertices of each connected part; without loose ones
    std::vector<bool> loose;               ///< vertices of no triangle
    std::vector<bool> free;                ///< places that are not held: one of each part is
    SparseCholesky factors;
  };
  static System system_of(const Cage& cage);

  std::vector<Vec3> take_wholes(std::span<const AffineMap> maps, std::span<const MapSplit> splits,
                                const LogReport& report, std::vector<MapLog>& logs) const;
  std::vector<Vec3> following(const PoseVector& vector) const;
  Held held(std::span<const Vec3> from, std::span<const Vec3> ways, std::span<const double> squares) const;
  void center(std::vector<Vec3>& leftovers) const;
  void hold(std::vector<Vec3>& ways, const PoseVector& vector, const Held& held) const;

  std::shared_ptr<const Cage> cage_;
  std::unique_ptr<const ElementMaps> elements_;
  System system_;
};

}  // namespace viete::deform
