// Stitching: the model's triangles follow the blended maps as closely as possible, and stay connected.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"
#include "deform/coarse_model.h"
#include "deform/sparse/sparse_cholesky.h"

namespace viete::deform {

/// The weight of a handle's pins at the corners of its nearest triangle. For comparison, the stiffness
/// between neighbouring vertices is about 1, see stiffness_matrix().
inline constexpr double pin_strength = 0.03;

/// Pose-independent data of a stitching. Stitching finds the positions x' that minimise
///
///     sum_t area_t * |(grad x' - M_t) * T_t|^2 + sum_pins w * |x' - A_h * x|^2 + sum_holds w * |x' - b|^2.
///
/// M_t is the blended map of triangle t, and T_t projects onto the triangle's plane. A pin ties a vertex x to
/// a handle with the map A_h. A hold pulls a vertex to its blended position b. The published energy (S. Kaji,
/// "ARAP" modes) has the same minimum, but three times as many unknowns: each triangle gets a fourth corner.
///
/// At the minimum of the first sum, K * x' = sum_t M_t * g_t. K is the stiffness matrix. g_t has one vector
/// per corner: the area times the gradient of the corner's hat function. The matrix is factored once.
///
/// Couplings join near parts, the sides of cracks, and vertices at one position, see part_couplings(). A
/// coupling of a and b with strength c adds the energy c * |(x'_a - x'_b) - M * (x_a - x_b)|^2. The coupling
/// is stored as triangle (a, b, b). Parts without a pin have a hold with weight 1e-4 at each vertex. A vertex
/// with only thin triangles (see half_cotangents()), or without triangles, has a hold with weight 1.
///
/// A polygon with a center, see mesh::split_unsettled(), has one map: that of the mean of its corners' sums.
/// Its energy is that of its triangles, with the center at the mean of the corners.
///
/// If needs_coarse_model(), the coarse model is stitched. Its displacements from the means of the blended
/// positions are interpolated.
///
/// Without a coarse model, results do not depend on the scene's size or its distance from the origin.
struct Stitching {
  struct Pin {
    std::uint32_t vertex, handle;
    double weight;
  };
  struct Hold {
    std::uint32_t vertex;
    double weight;
  };
  /// A polygon with a center: a fan of triangles around its first corner, which share the map of the first.
  struct Polygon {
    std::uint32_t triangle, others;  ///< the first triangle, and the first of the `corners - 3` others
  };

  Holding holding;
  std::vector<std::uint32_t> order;  ///< all vertices, ordered for locality
  /// All proper triangles, and the first triangles of polygons, in the order of vertices; then couplings;
  /// then the other triangles of polygons.
  std::vector<mesh::Triangle> triangles;
  /// For each map, the index of the triangle that provides the fitted rotation: the triangle itself or, for a
  /// coupling, a neighbouring triangle, because a line does not determine a rotation.
  std::vector<std::uint32_t> rotated_as;
  /// Half cotangents of the corners, from which K is computed; (0, 0, c) for a coupling, and 0 for polygons.
  std::vector<Vec3> cotangents;
  std::vector<Polygon> polygons;  ///< ascending
  mesh::Adjacency rings;          ///< the corners of each polygon
  /// For each corner i of `rings`, the weights of |x_i - x_(i+1)|^2 and of |x_i - center|^2 in the energy.
  std::vector<std::array<double, 2>> ring_weights;
  /// Area gradients g of the first two corners of each triangle. The third gradient is minus their sum.
  std::vector<std::array<Vec3, 2>> gradients;
  mesh::Adjacency around;  ///< for each vertex in `order`, all corners at the vertex: 3 * triangle + corner
  std::vector<Pin> pins;
  Binding pinned;  ///< the pins' rest, rest_origin and offsets from handles' centres; no weights
  std::vector<Hold> holds;
  SparseCholesky factors;
  std::shared_ptr<const CoarseModel> coarse{};  ///< null if the model itself is stitched
  std::shared_ptr<const Binding> bound{};       ///< binding of the coarse model

  std::size_t vertices() const { return factors.size(); }
  std::size_t maps() const { return rotated_as.size(); }
  /// Adds K * x of each polygon to the gradients of its triangles.
  void add_polygon_gradients(std::span<const Vec3> x, std::vector<std::array<Vec3, 2>>& gradients) const;
  bool serves(const Scheme& scheme) const {
    return holding == scheme.holding && (!bound || bound->weighting == scheme.weighting);
  }
};

/// Returns g of the corners a and b. `cotangents` are half cotangents.
std::array<Vec3, 2> area_gradients(const Vec3& cotangents, const Vec3& a, const Vec3& b, const Vec3& c);

/// Stitches the model to the cage's faces. Each handle pins its nearest triangle, and also the vertices at
/// distances d < r from its centre: r is scheme.holding.radius * cage.size, and the weight of these pins is
/// pin_strength * ((r - d) / r)^2. All vertices get a hold with weight scheme.holding.weight. Throws
/// base::Error if the model has no vertices, or if its size is above 1e75 or below 1e-75. Throws
/// base::Cancelled. Results do not depend on the number of threads.
Stitching stitch(const mesh::Surface& model, const Cage& cage, base::WorkerPool& pool,
                 const Scheme& scheme = {}, base::Progress* progress = nullptr);

}  // namespace viete::deform
