// Consistent branches of the rotation logs: neighbouring elements get logs that are near each other.
#pragma once

#include <span>
#include <vector>

#include "deform/cage.h"
#include "mesh/adjacency.h"
#include "mesh/half_edges.h"
#include "mesh/vector.h"
#include "sym3/general.h"
#include "sym3/rotation.h"

namespace viete::deform {

inline Vec3 nearest_branch(const Vec3& v, const Vec3& reference) {
  return sym3::nearest_branch(v, reference);
}

/// Returns trace(A^T B), which is 1 + 2 cos(angle between the rotations A and B).
double alignment(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b);

/// Returns the edges of the spanning forest with the smallest relative angles. If angles are equal, prefers
/// the edge with the lower index.
std::vector<mesh::Edge> spanning_forest(std::span<const mesh::Edge> edges,
                                        std::span<const sym3::Mat3<double>> rotations);

/// Returns the mean log of each part of the cage.
std::vector<Vec3> means_of_parts(const Cage& cage, std::span<const Vec3> logs);

/// Returns the number of whole turns that `turn` has in addition to `least`, the pose's shortest rotation.
double whole_turns(const Vec3& turn, const Vec3& least);
/// Returns `count` whole turns about an axis of length 1, plus the component of `least` along this axis.
Vec3 with_whole_turns(const Vec3& axis, double count, const Vec3& least);

struct Branches {
  std::vector<Vec3> logs;  ///< one log per map
  /// For each part the mean log or, if the logs cannot represent the turns, with_whole_turns().
  std::vector<Vec3> turns;
};

/// Chooses the branches of the elements' logs, given the principal logs. In each part of the cage, a spanning
/// forest of the smallest relative angles starts at the root. Each log is the branch nearest to the parent's
/// log. The branch of the root minimizes the root mean square distance of the part's logs to turns[part] (0
/// if missing), unless neighbours' logs would become farther apart. So a flipped map does not rotate other
/// maps. If two branches are equally near, the part uses the branch nearer to the first part's mean log.
///
/// A log can have whole turns only about the axis of its rotation. If a part's turns are longer than half a
/// turn and have another axis, Branches::turns keeps their whole turns. If the logs of such a part are not
/// coherent, the part gets the logs without turns. Takes O(k log k) time for k elements.
Branches choose_branches(const Cage& cage, std::span<const sym3::Mat3<double>> rotations,
                         std::span<const Vec3> principal, std::span<const Vec3> turns);

struct WeightedPairs {
  std::vector<mesh::Edge> pairs;  ///< pairs of neighbouring triangles i < j, sorted and unique
  std::vector<double> weights;    ///< one per pair: the square root of the smaller area
  mesh::Adjacency around;         ///< for each triangle, the indices of its pairs
};
WeightedPairs weighted_pairs(std::vector<mesh::Edge> pairs, std::span<const double> areas);

/// Changes branches to reduce the weighted sum of the distances between neighbours' logs. In each part,
/// the first step starts at the triangle with the smallest rotation. From there it follows a spanning tree of
/// the smallest relative rotations. Each connected set of changed triangles keeps its new logs if they reduce
/// the sum. The second step tries, for each triangle, the branches nearest to its neighbours' logs. The sum
/// never grows, and coherent logs keep all bits. Rotations near whole turns have no clear axis, so their logs
/// cannot be coherent. Thread-safe. Takes O(n log n) time.
void make_coherent(const WeightedPairs& neighbours, std::span<const sym3::Mat3<double>> rotations,
                   std::vector<mesh::Vec3>& logs);

/// Returns the number of pairs whose logs are more than half a turn apart.
std::size_t torn_pairs(const WeightedPairs& neighbours, std::span<const mesh::Vec3> logs);

}  // namespace viete::deform
