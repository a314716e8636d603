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

/// The pairs of a spanning forest with the smallest relative angles; ties: lowest place.
std::vector<mesh::Edge> spanning_forest(std::span<const mesh::Edge> edges,
                                        std::span<const sym3::Mat3<double>> rotations);

/// How many whole turns about its own axis `turn` has beyond `least`, the least rotation of the same pose.
double whole_turns(const Vec3& turn, const Vec3& least);
/// So many about an axis of length 1, and of the least rotation what is about it.
Vec3 with_whole_turns(const Vec3& axis, double count, const Vec3& least);

struct Branches {
  std::vector<Vec3> logs;  ///< of each map
  std::vector<Vec3>
      turns;  ///< mean log of each part of the cage, or with_whole_turns() that logs cannot tell
};

/// Logs of the elements' rotations, from their principal logs. Within a component all follow their neighbour,
/// from the root on, along a minimum spanning forest of the graph by relative angle (ties: lowest pair).
/// Which whole turns the component has made is decided by all its logs together: their root mean square
/// distance to turns[its part] (missing: 0) is the least, as long as neighbours stay as close, so that one
/// map that was turned over, even the root, cannot pull the others round. Components that are half a turn
/// from their references take the same side as the first.
///
/// Logs can have whole turns about the axes of their rotations alone. Where a part's rotations are not about
/// the axis of its turns, and these are of more than half a turn, the whole ones of them stay as they are;
/// the logs are those without them where only these are coherent. A pure function of its inputs. O(k log k).
Branches choose_branches(const Cage& cage, std::span<const sym3::Mat3<double>> rotations,
                         std::span<const Vec3> principal, std::span<const Vec3> turns);

/// Triangles and their neighbours.
struct WeightedPairs {
  std::vector<mesh::Edge> pairs;  ///< i < j, sorted, each once
  std::vector<double> weights;    ///< of each pair, how much it counts
  mesh::Adjacency around;         ///< of each triangle its pairs
};
WeightedPairs weighted_pairs(std::vector<mesh::Edge> pairs, std::span<const double> areas);

/// Makes the sum of the distances between neighbours' logs, by weight, small, by other branches than the
/// given ones. Tried are those along the tree of least relative rotations, from the triangle of each part
/// that turns least: they are taken where the sum over what differs, and hangs together, is less; then what
/// is nearest to each triangle's neighbours. So the sum never grows: what is coherent stays, bit for bit, and
/// a single triangle that was turned over turns no others. Near a whole turn other than 0 logs have no clear
/// axis, and no choice is coherent. Thread-safe. O(n log n).
void make_coherent(const WeightedPairs& neighbours, std::span<const sym3::Mat3<double>> rotations,
                   std::vector<mesh::Vec3>& logs);

/// Pairs whose logs are more than half a turn apart.
std::size_t torn_pairs(const WeightedPairs& neighbours, std::span<const mesh::Vec3> logs);

}  // namespace viete::deform
