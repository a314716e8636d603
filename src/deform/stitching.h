// Stitching: deforms the model so that its triangles follow the blended maps as closely as one surface can.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/binding.h"
#include "deform/sparse/sparse_cholesky.h"

namespace viete::deform {

/// The weight of a handle's pins at the corners of its nearest triangle. For comparison, the stiffness
/// between neighbouring vertices is about 1, see stiffness_matrix().
inline constexpr double pin_strength = 0.03;

/// Pose-independent data of a stitching. With the blended map M_t of triangle t, the positions x' minimise
///
///     sum_t area_t * |(grad x' - M_t) * T_t|^2 + sum_pins w * |x' - A_h * x|^2 + sum_holds w * |x' - b|^2.
///
/// T_t projects onto the triangle's plane, A_h is the map of the pin's handle, and b is the blended position.
/// The published energy (S. Kaji, "ARAP" modes) uses tetrahedra with a fourth corner off the plane. Each
/// fourth corner belongs to one tetrahedron, so at the minimum the map agrees with M_t in this corner's
/// direction. Only the part in the plane remains, with a third of the unknowns. The first sum gives K * x' =
/// sum_t M_t * g_t. K is the stiffness matrix. g_t has one vector per corner: the area times the gradient of
/// the corner's hat function. The matrix is factored once. Each pose has three right-hand sides.
///
/// part_couplings() join near parts, cracks, and vertices at one position. A coupling of a and b with
/// strength c adds the energy c * |(x'_a - x'_b) - M * (x_a - x_b)|^2. It is stored as triangle (a, b, b).
///
/// Results do not depend on the scene's size or its distance from the origin. For thin triangles, see
/// half_cotangents(). Every vertex is determined: in parts without a pin, vertices are pulled to their
/// blended positions with weight 1e-4. Vertices with only thin or no triangles are pulled with weight 1.
struct Stitching {
  struct Pin {
    std::uint32_t vertex, handle;
    double weight;
  };
  struct Hold {
    std::uint32_t vertex;
    double weight;
  };

  Holding holding;
  std::vector<std::uint32_t> order;       ///< all vertices, ordered for locality
  std::vector<mesh::Triangle> triangles;  ///< all proper triangles, ordered as the vertices; then couplings
  /// For each triangle, the index of the triangle that provides the fitted rotation: the triangle itself or,
  /// for a coupling, a neighbouring triangle, because a line does not determine a rotation.
  std::vector<std::uint32_t> rotated_as;
  /// Half cotangents of the corners, from which K is computed; (0, 0, c) for a coupling.
  std::vector<Vec3> cotangents;
  /// Area gradients g of the first two corners of each triangle. The third gradient is minus their sum.
  std::vector<std::array<Vec3, 2>> gradients;
  mesh::Adjacency around;  ///< for each vertex in `order`: 3 * t + corner, for its corners of triangles t
  std::vector<Pin> pins;
  Binding pinned;  ///< binding of the pins without weights: rest, rest_origin, offsets from handles' centres
  std::vector<Hold> holds;
  SparseCholesky factors;

  std::size_t vertices() const { return factors.size(); }
};

/// Returns g of the corners a and b. `cotangents` are half cotangents.
std::array<Vec3, 2> area_gradients(const Vec3& cotangents, const Vec3& a, const Vec3& b, const Vec3& c);

/// Returns the approximate memory of a stitching for this many vertices.
std::size_t stitching_bytes(std::size_t vertices);

/// Stitches the model to the cage's faces. Each handle also pins the vertices at distances d < r from its
/// centre, with weight pin_strength * ((r - d) / r)^2 and r = holding.radius * cage.size. holding.weight
/// pulls every vertex to its blended position. Throws base::Error if the model has no vertices, or if its
/// size is above 1e75 or below 1e-75. Throws base::Cancelled. Results do not depend on the number of threads.
Stitching stitch(const mesh::Surface& model, const Cage& cage, base::WorkerPool& pool,
                 const Holding& holding = {}, base::Progress* progress = nullptr);

}  // namespace viete::deform
