// How a model follows its cage: whole poses, single vertices, and the surface nearby.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/cage.h"
#include "sym3/rotation.h"

namespace viete::bench {

/// The model's vertices in a pose of the cage.
using Deform = std::function<std::vector<mesh::Point>(const deform::Pose&)>;

/// A map of space, posing the cage as a whole: x -> linear (x - middle) + middle + shift, the middle that of
/// the cage's box, the shift in its diagonals.
struct WholePose {
  const char* name;
  sym3::Mat3<double> linear;
  mesh::Vec3 shift;
};
/// A translation, a rigid motion, a similarity and an affine pose, each of its kind and no simpler.
std::span<const WholePose> whole_poses();

/// What a deformation is said to reproduce if it is no farther off: what rounding leaves.
inline constexpr double exactly = 1e-9;

/// How far the model is from where the pose has the space around it: the largest distance of a vertex, in
/// diagonals of the posed cage.
double deviation(const WholePose& pose, const deform::Cage& cage, std::span<const mesh::Point> model,
                 const Deform& deform);

/// What one vertex of the cage does to what is far from it: it is moved along its normal by a tenth of the
/// cage's diagonal, and this is how far those vertices of the model move that are more than a quarter of it
/// away, in diagonals: the median of those, and of at most 8 vertices of the cage. NaN if none is so far
/// away.
double leak(const deform::Cage& cage, std::span<const mesh::Point> model, const Deform& deform);

/// A point of the cage's surface: of a triangle by its corners.
struct CagePoint {
  std::uint32_t triangle;
  mesh::Vec3 barycentric;
};
/// Of each point the nearest one of the cage at rest.
std::vector<CagePoint> nearest_on_cage(const deform::Cage& cage, std::span<const mesh::Point> points,
                                       base::WorkerPool& pool);
/// How far the points are from where a pose has these of the cage: mean by shares, which sum to 1, in
/// diagonals of the cage at rest.
double gap(const deform::Cage& cage, std::span<const CagePoint> nearest, std::span<const double> shares,
           std::span<const mesh::Point> posed_cage, std::span<const mesh::Point> points);

}  // namespace viete::bench
