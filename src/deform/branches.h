// Which of the many logs of a rotation: neighbouring elements take neighbouring ones.
#pragma once

#include <span>
#include <vector>

#include "deform/map_graph.h"
#include "sym3/rotation.h"

namespace viete::deform {

/// The branch n (theta + 2 pi k) of the rotation vector v = n theta that is nearest to `reference`. Where v
/// is zero, or along the reference up to 1e-13, the axis is the reference's, so that full turns do not lose
/// it.
Vec3 nearest_branch(const Vec3& v, const Vec3& reference);

/// trace(A^T B) = 1 + 2 cos(angle between the two rotations).
double alignment(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b);

struct Branches {
  std::vector<Vec3> logs;   ///< of each map
  std::vector<Vec3> turns;  ///< mean log of each part of the cage
};

/// Logs of the maps' rotations, from their principal logs. Within a component all follow their neighbour,
/// from the root on, along a minimum spanning forest of the graph by relative angle (ties: lowest pair).
/// Which whole turns the component has made is decided by all its logs together: their root mean square
/// distance to turns[its part] (missing: 0) is the least, as long as neighbours stay as close, so that one
/// map that was turned over, even the root, cannot pull the others round. Components that are half a turn
/// from their references take the same side as the first. A pure function of its inputs. O(k log k).
Branches choose_branches(const MapGraph& graph, std::span<const sym3::Mat3<double>> rotations,
                         std::span<const Vec3> principal, std::span<const Vec3> turns);

}  // namespace viete::deform
