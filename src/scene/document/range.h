// How far numbers may go: one range for what is typed, dragged and looked at, and for what a session holds,
// so that whatever is written is read again.
#pragma once

#include <algorithm>
#include <cmath>

#include "deform/cage.h"
#include "scene/document/space.h"
#include "sym3/sym3.h"

namespace viete::scene {

/// Coordinates and turns of a pose, as its files have them too.
using deform::largest_turn;
using mesh::largest_coordinate;

/// View units from the middle of the model, which has a diagonal of 2: how far a drag takes vertices and
/// where a camera looks. Floats still tell parts of the model from each other there.
inline constexpr double farthest_place = 1e6;

/// Entries of the log of a probe's stretch: a factor of e^16, nine million.
inline bool is_probe_stretch(const sym3::Sym3<double>& x) {
  for (const double entry : {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz}) {
    if (!(std::abs(entry) <= 16)) return false;
  }
  return true;
}

/// Sizes and places, in the file's units, that graphics cards can draw, which compute in float: it ends near
/// 1e-38 and 1e38. What is larger or smaller is not opened.
inline constexpr double least_drawn = 1e-32, most_drawn = 1e32;

/// View units between a camera and what it looks at.
inline constexpr float nearest_camera = 1e-3f, farthest_camera = 1e3f;

/// Logical pixels of a window; the area of a wall of screens, and what a picture of them takes in memory.
inline constexpr double least_window_side = 16, most_window_side = 8192, most_window_area = 4096 * 4096;

inline bool is_window(double width, double height) {
  return std::min(width, height) >= least_window_side && std::max(width, height) <= most_window_side &&
         width * height <= most_window_area;
}

/// Whether a drag may put a vertex there, in the file's units.
inline bool is_in_reach(const Space& space, const mesh::Point& p) {
  for (int i = 0; i < 3; ++i) {
    const bool near = std::abs((p[i] - space.center[i]) * space.scale) <= farthest_place;
    if (!near || !(std::abs(p[i]) <= most_drawn)) return false;
  }
  return true;
}

}  // namespace viete::scene
