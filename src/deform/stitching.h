// Stitching: the model's triangles follow the blended maps as closely as possible, and stay connected.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "sparse/sparse_cholesky.h"
#include "weights/binding.h"
#include "weights/coarse_model.h"
#include "weights/part_coupling.h"

namespace viete::deform {

using mesh::Vec3;

/// The weight of a handle's pins at the corners of its nearest triangle, times HandleShape::share. For
/// comparison, the stiffness between neighbouring vertices is about 1, see stiffness_matrix().
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
/// coupling of a vertex a and a point b with strength c adds the energy
/// c * |(x'_a - x'_b) - M * (x_a - x_b)|^2. See for_sides(). Parts without a pin have a hold with weight 1e-4
/// at each vertex. A vertex with only thin triangles (see half_cotangents()), or without triangles, has a
/// hold with weight 1.
///
/// The triangles are those of mesh::split_unsettled(). The centers of polygons are further vertices, whose
/// blended values are the means of those of the polygons' corners. Polygons have at most most_split_corners
/// corners.
///
/// If stitches_coarse_model(), the coarse model is stitched. Its displacements from the means of the blended
/// positions are interpolated; those of a lattice, from its own blended positions.
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

  pose::Holding holding;
  mesh::Adjacency rings;                  ///< the corners of each polygon with a center
  std::vector<std::uint32_t> order;       ///< all vertices, then centers, ordered for locality
  std::vector<mesh::Triangle> triangles;  ///< all proper triangles, in the order of vertices; then couplings
  /// For each triangle, the index of the triangle that provides the fitted rotation: the triangle itself or,
  /// for a coupling, a neighbouring triangle, because a line does not determine a rotation.
  std::vector<std::uint32_t> rotated_as;
  std::vector<Vec3> cotangents;              ///< half cotangents of the corners, from which K is computed
  std::vector<weights::Coupling> couplings;  ///< have no cotangents
  /// Area gradients g of the first two corners of each triangle. The third gradient is minus their sum.
  std::vector<std::array<Vec3, 2>> gradients;
  mesh::Adjacency around;  ///< for each vertex in `order`, all corners at the vertex: 3 * triangle + corner
  std::vector<Pin> pins;
  weights::Binding pinned;  ///< the pins' rest, rest_origin and offsets from handles' centres; no weights
  std::vector<Hold> holds;
  sparse::SparseCholesky factors;
  std::shared_ptr<const weights::CoarseModel> coarse{};  ///< null if the model itself is stitched
  std::shared_ptr<const weights::Binding> bound{};       ///< binding of the coarse model

  /// Returns `gradients` for the positions x.
  std::vector<std::array<Vec3, 2>> gradients_of(std::span<const Vec3> x, base::WorkerPool& pool) const;
  /// Returns the number of the model's vertices, without the centers.
  std::size_t vertices() const { return factors.size() - rings.starts.size() + 1; }
  /// Adds the values of the centers to values of the vertices. Each vertex has `columns` values.
  template <class T>
  std::vector<T> with_centers(std::span<const T> values, std::size_t columns = 1) const {
    std::vector<T> all(values.begin(), values.end());
    for (std::size_t i = 0; !values.empty() && i + 1 < rings.starts.size(); ++i) {
      const double share = 1 / static_cast<double>(rings.of(i).size());
      for (std::size_t k = 0; k < columns; ++k) {
        T mean{};
        for (const auto v : rings.of(i)) mean = mean + share * values[v * columns + k];
        all.push_back(mean);
      }
    }
    return all;
  }
  bool serves(const pose::Deformer& deformer) const {
    return holding == deformer.holding && (!bound || bound->weighting == deformer.weighting);
  }
};

/// Divides a coupling into triangles that join its vertex to the sides of its own triangle, so that the maps
/// of all corners near the point have influence. Calls visit(triangle, first, second). The factors of the gap
/// x_a - x_b in g of the first two corners are `first` and `second`.
template <class Visit>
void for_sides(const weights::Coupling& coupling, const Visit& visit) {
  mesh::Triangle corners{};
  Vec3 shares{};
  std::size_t count = 0;  // corners without a share are not used
  for (std::size_t k = 0; k < 3; ++k) {
    if (coupling.shares[k] == 0) continue;
    corners[count] = coupling.triangle[k];
    shares[count++] = coupling.strength * coupling.shares[k] / 2;  // a corner is in two sides
  }
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t j = (i + 1) % count;
    visit(mesh::Triangle{coupling.vertex, corners[i], corners[j]}, shares[i] + shares[j], -shares[i]);
  }
}

/// Stitches the model to the cage's faces. Each handle pins its nearest triangle, and also the vertices at
/// distances d < r from its centre: r is deformer.holding.radius * cage.size, and the weight of these pins is
/// pin_strength * ((r - d) / r)^2. All vertices get a hold with weight deformer.holding.weight. Throws
/// base::Error if the model has no vertices, or if its size is above 1e75 or below 1e-75. Throws
/// base::Cancelled. Results do not depend on the number of threads.
Stitching stitch(const mesh::Surface& model, const pose::Cage& cage, base::WorkerPool& pool,
                 const pose::Deformer& deformer = {}, base::Progress* progress = nullptr);

}  // namespace viete::deform
