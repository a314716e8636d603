// Consistent branches of the rotation logs: neighbouring elements get logs that are near each other.
#pragma once

#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/half_edges.h"
#include "mesh/vector.h"
#include "pose/cage.h"
#include "sym3/general.h"
#include "sym3/rotation.h"

namespace viete::pose {

inline Vec3 nearest_branch(const Vec3& v, const Vec3& reference) {
  return sym3::nearest_branch(v, reference);
}

/// Returns trace(A^T * B), which is 1 + 2 * cos(angle between the rotations A and B).
double alignment(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b);

/// Returns the edges of a minimum spanning forest. The cost of an edge is the angle between the rotations of
/// the edge's two elements. If two costs are equal, prefers the edge with the lower index.
std::vector<mesh::Edge> spanning_forest(std::span<const mesh::Edge> edges,
                                        std::span<const sym3::Mat3<double>> rotations);

std::vector<Vec3> means_of_parts(const Cage& cage, std::span<const Vec3> logs);

/// Returns the number of whole turns that `turn` has in addition to `least`, the pose's shortest rotation.
/// Returns 0 if `turn` is at most half a turn.
double whole_turns(const Vec3& turn, const Vec3& least);
/// Returns `count` whole turns about the unit vector `axis`, plus the component of `least` along `axis`.
Vec3 with_whole_turns(const Vec3& axis, double count, const Vec3& least);

struct Branches {
  std::vector<Vec3> logs;  ///< one log per element
  /// One per part: the mean log, or with_whole_turns() if logs cannot represent the part's whole turns.
  std::vector<Vec3> turns;
};

/// Chooses a branch for each element's log, given the principal logs. Goes from the root of each part along
/// spanning_forest(): an element gets the branch nearest to the log of its parent in the forest. For the
/// root, takes the branch of its own log nearest to turns[part] (0 if missing). Replaces it by the branch
/// with one turn more or less if the part's logs are then nearer to turns[part] (root mean square):
/// - Not if neighbours' logs then differ much more. A smoother branch that is farther from turns[part] is not
///   taken, because it would lose whole turns.
/// - If two branches are equally near, takes the branch nearer to the first part's mean log.
///
/// A log can have whole turns only about the axis of its rotation. Whole turns of turns[part] about another
/// axis are kept only in Branches::turns. If turns[part] makes neighbours' logs too different, the part gets
/// the logs for turns[part] = 0. Takes O(k log k) time for k elements.
Branches choose_branches(const Cage& cage, std::span<const sym3::Mat3<double>> rotations,
                         std::span<const Vec3> principal, std::span<const Vec3> turns);

struct WeightedPairs {
  std::vector<mesh::Edge> pairs;  ///< pairs of neighbouring triangles i < j, sorted and unique
  std::vector<double> weights;    ///< one per pair: the square root of the smaller triangle's area
  mesh::Adjacency around;         ///< for each triangle, the indices of its pairs
};
WeightedPairs weighted_pairs(std::vector<mesh::Edge> pairs, std::span<const double> areas);

/// Changes branches to reduce the sum of weight * (distance of the two logs) over all pairs. Does nothing if
/// torn_pairs() is 0. Torn pairs may remain, because the axis of a rotation near a whole turn is arbitrary.
/// Thread-safe. O(n log n).
void make_coherent(const WeightedPairs& neighbours, std::span<const sym3::Mat3<double>> rotations,
                   std::vector<mesh::Vec3>& logs);

/// Returns the number of pairs whose logs are more than half a turn apart.
std::size_t torn_pairs(const WeightedPairs& neighbours, std::span<const mesh::Vec3> logs);

}  // namespace viete::pose
