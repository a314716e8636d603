// Generalised winding numbers, and which points lie outside of a cage.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// numbers[i] is the generalised winding number around points[i]: the sum of the triangles' signed solid
/// angles over 4 pi. For a closed surface an integer, 1 inside of one oriented outward, 0 outside; for an
/// open one any number, smooth away from it. On the surface itself one of the values nearby. Any length scale
/// from 1e-100 to 1e100. Same value for any pool. numbers.size() == points.size(). pool may be null. Sources:
/// Jacobson et al. 2013, Robust inside-outside segmentation using generalized winding numbers; van Oosterom
/// and Strackee 1983, The solid angle of a plane triangle (eq. 8). Cost O(points * triangles), about 8 ns
/// each on one core: a few points at a time in vector registers, one arc tangent per point instead of one per
/// triangle.
void winding_numbers(const Surface& surface, std::span<const Point> points, std::span<double> numbers,
                     base::WorkerPool* pool = nullptr);

/// Which positions lie outside of the cage: winding number nearer to 0 than to 1 or -1 (so the cage's
/// orientation does not matter), and further from the cage than 1e-9 of its diagonal, so that points on it
/// are not outside. Ascending. Positions are finite. Cost as winding_numbers; points far from the cage cost
/// as much again.
std::vector<std::uint32_t> points_outside(const Surface& cage, std::span<const Point> positions,
                                          base::WorkerPool* pool = nullptr);

}  // namespace viete::mesh
