// Stitching: deforms the model so that its triangles follow blended maps as closely as one surface can.
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

/// Pull of the corners of a handle's nearest triangle to the handle's map. Weights are per vertex, relative
/// to a stiffness of about 1 between neighbours, see stiffness_matrix().
inline constexpr double pin_strength = 0.03;

/// The data of stitching that does not change with the pose. With M_t = R_t S_t the blended map of triangle
/// t, positions x' minimise
///
///     sum_t area_t |(grad x' - M_t) T_t|^2 + sum_pins w |x' - A_h x|^2 + sum_holds w |x' - blended x'|^2,
///
/// T_t projecting onto the triangle's plane. This is the published energy of tetrahedra with a fourth corner
/// off the plane (S. Kaji, "ARAP" modes), reduced to a third of the unknowns: the fourth corner belongs to
/// one tetrahedron only, so at the minimum the map agrees with M_t in its direction, and only the plane's
/// share remains. Its derivatives give K x' = sum_t M_t g_t, K the stiffness matrix and g_t, i = area grad of
/// the hat function of corner i: one factorisation, and three right-hand sides per pose.
///
/// part_couplings() of strength c join near parts, cracks, and vertices at the same place; each adds c |(x'_a
/// - x'_b) - M (x_a - x_b)|^2 as a triangle (a, b, b). A model of one part that does not touch itself has no
/// couplings.
///
/// Lengths are relative to local positions, so results do not depend on the scene's distance from the origin
/// or its size. Thin triangles count as in half_cotangents(). Every vertex is determined: parts without a pin
/// are pulled to their blended positions with 1e-4 per vertex, and vertices of only thin triangles, or of no
/// triangle, with 1.
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
  std::vector<mesh::Triangle> triangles;  ///< all but thin ones, in the order of vertices; then couplings
  /// Index of the triangle whose fitted rotation each one uses: its own; for a coupling a neighbouring
  /// triangle, since the rotation about a single line is not determined.
  std::vector<std::uint32_t> rotated_as;
  /// Half cotangents of the corners, from which K is made; for a coupling (0, 0, c).
  std::vector<Vec3> cotangents;
  /// g of the first two corners; the three sum to 0.
  std::vector<std::array<Vec3, 2>> gradients;
  mesh::Adjacency around;  ///< 3 t + corner, for each vertex in the order
  std::vector<Pin> pins;
  Binding pinned;  ///< for the pins: rest, rest_origin, offsets from the handle's centre, without weights
  std::vector<Hold> holds;
  SparseCholesky factors;

  std::size_t vertices() const { return factors.size(); }
};

/// g of a triangle with these cotangents and corners.
std::array<Vec3, 2> area_gradients(const Vec3& cotangents, const Vec3& a, const Vec3& b, const Vec3& c);

/// Approximate memory of a stitching for this many vertices.
std::size_t stitching_bytes(std::size_t vertices);

/// Stitches to the cage's faces. Vertices within holding.radius of a handle are pinned to it too, by
/// pin_strength ((radius - distance) / radius)^2; every vertex is pulled to its blended position by
/// holding.weight. Throws base::Error if the model has no vertices, or if its size is beyond
/// 1e75 or below 1e-75 so that its system cannot be factored; base::Cancelled. The same for any number of
/// threads.
Stitching stitch(const mesh::Surface& model, const Cage& cage, base::WorkerPool& pool,
                 const Holding& holding = {}, base::Progress* progress = nullptr);

}  // namespace viete::deform
