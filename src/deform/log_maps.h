// Link 2 of the frame: each map as log of stretch, log of rotation, and centre; with consistent rotation
// branches.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "deform/face_maps.h"
#include "deform/map_split.h"
#include "sym3/sym3.h"

namespace viete::deform {

/// linear = exp(rotation) exp(stretch). Twelve numbers, blended linearly.
struct MapLog {
  sym3::Sym3<double> stretch;  ///< X = log S
  Vec3 rotation;               ///< Y = log R as a rotation vector, any number of turns
  Vec3 center;                 ///< posed centroid minus the pose's origin
};

/// In the order of LogVector::logs.
inline std::array<double, 9> numbers(const MapLog& log) {
  const auto& [x, y, center] = log;
  return {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz, y[0], y[1], y[2]};
}

/// What had to be decided: shown to the user, and carried to the next pose.
struct LogReport {
  std::vector<Vec3> turns;  ///< of each part of the cage, see Branches: pass as the next pose's `turns`
  std::vector<std::uint32_t> collapsed;  ///< maps, ascending, whose stretch was raised to the floor
  /// Neighbouring maps whose rotations differ by more than 120 degrees, or whose logs by more than 180 (no
  /// choice of branches is right around a ring of elements that turns once): between them the blend is
  /// ambiguous.
  std::vector<mesh::Edge> torn;
};

/// Geometric mean of the largest stretches of what is not skipped: what size a pose has as a whole.
double mean_stretch(std::span<const std::uint8_t> skipped, std::span<const double> largest);

/// Whether stretches, the least and the largest one of a map, are above the floors below. False for NaN.
bool is_ordinary(double least, double largest, double mean_stretch);

/// The split of a map that mirrors, collapses or is not finite, by SVD, its singular values raised to the
/// floors below; that of others stays. True if one was below, or the map is not finite.
bool raise_to_floor(const AffineMap& map, double mean_stretch, MapSplit& split);

/// Of each map, linear = R S: X = log S, Y = log R, from its split, and by SVD where it mirrors or nearly
/// collapses. Singular values are raised to 1e-3 of the element's largest one and to 1e-4 of the pose's mean
/// one: no element collapses fully. A mirrored map takes the closest proper rotation. A map that is not
/// finite counts as collapsed, with the log of I.
///
/// Branches of Y: choose_branches(). A pure function of its inputs; handing report.turns on follows a
/// continuous motion through any number of turns. logs.size() == maps.size(). O(k log k).
///
/// The log itself has a limit: rotations near a whole turn other than 0 (|Y| about 360 degrees) have nearly
/// arbitrary axes, so elements there that do not turn rigidly together blend badly; `torn` says so.
void log_maps(const Cage& cage, std::span<const AffineMap> maps, std::span<const MapSplit> splits,
              std::span<const Vec3> turns, std::span<MapLog> logs, LogReport& report);

}  // namespace viete::deform
