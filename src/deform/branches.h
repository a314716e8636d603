// Consistent branches of the rotation logs: neighbouring elements take neighbouring logs.
#pragma once

#include <cstdint>
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

/// trace(A^T B) = 1 + 2 cos(angle between the two rotations).
double alignment(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b);

/// The pairs of a spanning forest with the smallest relative angles; ties: lowest index.
std::vector<mesh::Edge> spanning_forest(std::span<const mesh::Edge> edges,
                                        std::span<const sym3::Mat3<double>> rotations);

/// The mean log of each part of the cage.
std::vector<Vec3> means_of_parts(const Cage& cage, std::span<const Vec3> logs);

/// Number of whole turns by which the rotation vector `turn` exceeds `least`, the shortest rotation vector of
/// the same pose.
double whole_turns(const Vec3& turn, const Vec3& least);
/// This many turns about an axis of length 1, plus the component of the least rotation along it.
Vec3 with_whole_turns(const Vec3& axis, double count, const Vec3& least);

struct Branches {
  std::vector<Vec3> logs;  ///< log of each map
  std::vector<Vec3>
      turns;  ///< mean log of each part of the cage, or with_whole_turns() if logs cannot represent the turns
};

/// Logs of the elements' rotations, from their principal logs. Within a component each follows its neighbour,
/// from the root on, along a minimum spanning forest of the graph by relative angle (ties: lowest pair). All
/// logs of a component together determine its whole turns: their root mean square distance to turns[its part]
/// (missing: 0) is minimal among choices that keep neighbours as close, so that a single flipped map, even
/// the root, does not rotate the others. Components half a turn from their references take the same side as
/// the first one.
///
/// Logs can only have whole turns about the axes of their rotations. If a part's rotations are about another
/// axis than its turns, and these are more than half a turn, their whole turns stay unchanged, and the logs
/// are taken without them if only these are coherent. A pure function of its inputs. O(k log k).
Branches choose_branches(const Cage& cage, std::span<const sym3::Mat3<double>> rotations,
                         std::span<const Vec3> principal, std::span<const Vec3> turns);

/// Pairs of neighbouring triangles.
struct WeightedPairs {
  std::vector<mesh::Edge> pairs;  ///< i < j, sorted, each once
  std::vector<double> weights;    ///< weight of each pair
  mesh::Adjacency around;         ///< pairs of each triangle
};
WeightedPairs weighted_pairs(std::vector<mesh::Edge> pairs, std::span<const double> areas);

/// Changes branches to reduce the weighted sum of the distances between neighbours' logs. First tries the
/// branches along the tree of least relative rotations, from the triangle of each part that rotates least,
/// and takes them per connected set of changed triangles if the sum decreases; then the branch nearest to
/// each triangle's neighbours. The sum never grows: coherent logs stay, bit for bit, and a single flipped
/// triangle does not rotate others. Near a nonzero whole turn logs have no clear axis, and no choice is
/// coherent. Thread-safe. O(n log n).
void make_coherent(const WeightedPairs& neighbours, std::span<const sym3::Mat3<double>> rotations,
                   std::vector<mesh::Vec3>& logs);

/// Number of pairs whose logs are more than half a turn apart.
std::size_t torn_pairs(const WeightedPairs& neighbours, std::span<const mesh::Vec3> logs);

}  // namespace viete::deform
