// Generalised winding numbers, and the points outside of a cage.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// The generalised winding number around p: the sum of the triangles' signed solid angles over 4 pi. For a
/// closed, outward-oriented surface 1 inside and 0 outside; for an open one any number, smooth away from the
/// surface. Undefined on the surface itself. Any length scale from 1e-100 to 1e100. Sources: Jacobson et al.
/// 2013, Robust inside-outside segmentation using generalized winding numbers; van Oosterom and Strackee
/// 1983, The solid angle of a plane triangle (eq. 8).
double winding_number(const Surface& surface, const Point& p);

/// The positions outside of the cage, ascending: winding number nearer to 0 than to 1 or -1 (the cage's
/// orientation does not matter), and farther from the cage than 1e-9 of its diagonal, so that points on the
/// cage are not outside. Positions must be finite. Any length scale from 1e-100 to 1e100. Uses the sum of all
/// solid angles only where TriangleTree::winding_number() leaves the side open. The same result for any pool.
/// pool and progress may be null; throws base::Cancelled.
std::vector<std::uint32_t> points_outside(const Surface& cage, std::span<const Point> positions,
                                          base::WorkerPool* pool = nullptr,
                                          base::Progress* progress = nullptr);

}  // namespace viete::mesh
