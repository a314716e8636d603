// Generalised winding numbers, and points outside a cage.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Returns the generalised winding number around p: the sum of the triangles' signed solid angles, divided by
/// 4 pi. For a closed surface oriented outward, the number is 1 inside and 0 outside. Must not be called for
/// points on the surface. Lengths must be from 1e-100 to 1e100. Sources: Jacobson et al. 2013, Robust
/// inside-outside segmentation; van Oosterom and Strackee 1983, The solid angle of a plane triangle.
double winding_number(const Surface& surface, const Point& p);

/// Returns the indices of the positions outside the cage, ascending. Outside, the absolute winding number is
/// below 0.5; the cage's orientation has no effect. Points nearer to the cage than 1e-9 * its diagonal count
/// as inside. Positions must be finite. Lengths must be from 1e-100 to 1e100. The result does not
/// depend on the pool. `pool` and `progress` may be null. Throws base::Cancelled.
std::vector<std::uint32_t> points_outside(const Surface& cage, std::span<const Point> positions,
                                          base::WorkerPool* pool = nullptr,
                                          base::Progress* progress = nullptr);

}  // namespace viete::mesh
