// Value ranges, the same for typed, dragged and session values, so that every written session can be read
// again.
#pragma once

#include <algorithm>
#include <cmath>

#include "deform/cage.h"
#include "document/space.h"
#include "sym3/sym3.h"

namespace viete::document {

/// Coordinates and turns of a pose, in memory and in files.
using deform::largest_turn;
using mesh::largest_coordinate;

/// View units from the middle of the model, whose diagonal is 2: the limit for drags and camera targets.
/// Floats still resolve parts of the model at this distance.
inline constexpr double farthest_place = 1e6;

/// Entries of the log of a probe's stretch: a factor of e^16, nine million.
inline bool is_probe_stretch(const sym3::Sym3<double>& x) {
  for (const double entry : {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz}) {
    if (!(std::abs(entry) <= 16)) return false;
  }
  return true;
}

/// Sizes and coordinates, in the file's units, that GPUs can draw in float, whose range ends near 1e-38 and
/// 1e38. Files beyond these limits are refused.
inline constexpr double least_drawn = 1e-32, most_drawn = 1e32;

/// View units between the camera and its target.
inline constexpr float nearest_camera = 1e-3f, farthest_camera = 1e3f;

/// Logical pixels of a window; the area covers a wall of screens and limits the memory of a picture.
inline constexpr double least_window_side = 16, most_window_side = 8192, most_window_area = 4096 * 4096;

inline bool is_window(double width, double height) {
  return std::min(width, height) >= least_window_side && std::max(width, height) <= most_window_side &&
         width * height <= most_window_area;
}

/// True if a drag may move a vertex there, in the file's units.
inline bool is_in_reach(const Space& space, const mesh::Point& p) {
  for (int i = 0; i < 3; ++i) {
    const bool near = std::abs((p[i] - space.center[i]) * space.scale) <= farthest_place;
    if (!near || !(std::abs(p[i]) <= most_drawn)) return false;
  }
  return true;
}

}  // namespace viete::document
