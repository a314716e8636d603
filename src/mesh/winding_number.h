// Generalised winding numbers, and the points outside of a cage.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// numbers[i] is the generalised winding number around points[i]: the sum of the triangles' signed solid
/// angles over 4 pi. For a closed, outward-oriented surface 1 inside and 0 outside; for an open one any
/// number, smooth away from the surface. On the surface itself it is one of the nearby values. Any length
/// scale from 1e-100 to 1e100. The same result for any pool. numbers.size() == points.size(). pool may be
/// null. Sources: Jacobson et al. 2013, Robust inside-outside segmentation using generalized winding numbers;
/// van Oosterom and Strackee 1983, The solid angle of a plane triangle (eq. 8). O(points * triangles), about
/// 8 ns each on one core: vectorised over points, with one arc tangent per point instead of per triangle.
void winding_numbers(const Surface& surface, std::span<const Point> points, std::span<double> numbers,
                     base::WorkerPool* pool = nullptr);

/// The positions outside of the cage, ascending: winding number nearer to 0 than to 1 or -1 (the cage's
/// orientation does not matter), and farther from the cage than 1e-9 of its diagonal, so that points on the
/// cage are not outside. Positions must be finite. Costs as winding_numbers(); points far from the cage cost
/// twice as much.
std::vector<std::uint32_t> points_outside(const Surface& cage, std::span<const Point> positions,
                                          base::WorkerPool* pool = nullptr);

}  // namespace viete::mesh
