// The allowed ranges of values in user input and in files.
#pragma once

#include <algorithm>
#include <cmath>

#include "document/space.h"
#include "pose/cage.h"
#include "sym3/sym3.h"

namespace viete::document {

using mesh::largest_coordinate;
using pose::largest_turn;

/// Drags and camera targets stay within this distance from the model's center, in view units.
inline constexpr double farthest_place = 1e6;

/// `x` is the log of a probe's stretch. True if |entry| <= 16 for each entry. e^16 is about nine million.
inline bool is_probe_stretch(const sym3::Sym3<double>& x) {
  for (const double entry : {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz}) {
    if (!(std::abs(entry) <= 16)) return false;
  }
  return true;
}

/// The sizes and coordinates that GPUs can draw, in the file's units. The range of float is 1e-38 to 1e38.
inline constexpr double least_drawn = 1e-32, most_drawn = 1e32;

/// The limits of the distance between the camera and its target, in view units.
inline constexpr float nearest_camera = 1e-3f, farthest_camera = 1e3f;

/// The limits of a window's size, in logical pixels. The largest area limits the memory that pictures need.
inline constexpr double least_window_side = 16, most_window_side = 8192, most_window_area = 4096 * 4096;

inline bool is_window(double width, double height) {
  return std::min(width, height) >= least_window_side && std::max(width, height) <= most_window_side &&
         width * height <= most_window_area;
}

/// True if a drag may move a vertex to this point in file coordinates.
inline bool is_in_reach(const Space& space, const mesh::Point& p) {
  for (int i = 0; i < 3; ++i) {
    const bool near = std::abs((p[i] - space.center[i]) * space.scale) <= farthest_place;
    if (!near || !(std::abs(p[i]) <= most_drawn)) return false;
  }
  return true;
}

}  // namespace viete::document
