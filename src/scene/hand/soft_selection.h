// How much of a motion goes on to what is near the selection.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "scene/document/handling.h"

namespace viete::scene {

/// A vertex near selected ones.
struct Softened {
  std::uint32_t vertex;
  double share;           ///< in (0, 1]; 1: as far as the selected ones
  std::uint32_t nearest;  ///< which of the selected ones it goes with, a place in their list
};

/// The share at a distance in units of the radius: 1 at 0, 0 from 1 on.
double soft_share(SoftCurve curve, double distance);

/// What goes along with the selected vertices, which are among it, in ascending order. `positions` of the
/// cage in its pose; `radius` in the file's units. Distances over edges are shortest paths. O(n log n).
std::vector<Softened> softened(const deform::Cage& cage, std::span<const mesh::Point> positions,
                               std::span<const std::uint32_t> selected, const SoftSelection& soft,
                               double radius);

}  // namespace viete::scene
