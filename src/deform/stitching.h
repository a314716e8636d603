// Stitching: the model whose triangles follow blended maps as closely as one surface can.
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

/// How firmly a stitched model is held. Weights are of one vertex, beside a stiffness of about 1 between
/// neighbours, see stiffness_matrix().
struct StitchingSettings {
  double pin = 0.03;       ///< of each corner of the triangle nearest to a handle, to where its map takes it
  double radius = 0;       ///< in sizes of the cage : vertices so near to a handle are pinned too, by
                           ///< pin ((radius - distance) / radius)^2
  double translation = 0;  ///< of every vertex, to its blended position

  friend bool operator==(const StitchingSettings&, const StitchingSettings&) = default;
};
StitchingSettings settings_of(const Scheme& scheme);

/// What of stitching does not change with the pose. With M_t = R_t S_t the blended map of triangle t,
/// positions x' minimise
///
///     sum_t area_t |(grad x' - M_t) T_t|^2 + sum_pins w |x' - A_h x|^2 + sum_holds w |x' - blended x'|^2,
///
/// T_t projecting onto the triangle's plane. That is the published energy of tetrahedra with a fourth corner
/// off the plane (S. Kaji, "ARAP" modes): this corner is of one tetrahedron only, so that at the minimum the
/// map takes its direction exactly as M_t does, whatever the others do; what is left is the plane's share, in
/// a third as many unknowns. Derivatives of it give K x' = sum_t M_t g_t, K the stiffness matrix and g_t, i =
/// area grad of the hat function of corner i: one factorisation, and three right-hand sides a pose.
///
/// Parts that lie near each other, cracks, and vertices at the same place are held together by
/// part_couplings() of strength c, which add sum c |(x'_a - x'_b) - M (x_a - x_b)|^2: triangles (a, b, b), as
/// it were. A model of one part that touches nowhere has none.
///
/// Lengths are relative to where things are, so that it does not matter how far from the origin or how large
/// the scene is. Thin triangles count as in half_cotangents(). Every vertex has its place: parts without a
/// pin are held by their blended positions, by 1e-4 a vertex, and vertices that only thin triangles or none
/// have, by 1.
struct Stitching {
  struct Pin {
    std::uint32_t vertex, handle;
    double weight;
  };
  struct Hold {
    std::uint32_t vertex;
    double weight;
  };

  StitchingSettings settings;
  std::vector<std::uint32_t> order;       ///< all vertices, neighbours near each other
  std::vector<mesh::Triangle> triangles;  ///< that count, in the order of their vertices; then couplings
  /// Whose rotation each of them takes when rotations are fitted: its own, and couplings that of a triangle
  /// beside, since along one line any rotation fits.
  std::vector<std::uint32_t> rotated_as;
  /// Half the cotangents of their corners, of which K is made; of a coupling (0, 0, c).
  std::vector<Vec3> cotangents;
  /// g of their first two corners; the third is what these lack to 0.
  std::vector<std::array<Vec3, 2>> gradients;
  mesh::Adjacency around;  ///< 3 t + corner, of each vertex in the order
  std::vector<Pin> pins;
  Binding pinned;  ///< what apply() needs of the pins: rest, rest_origin, offsets from the handle's centre
  std::vector<Hold> holds;
  SparseCholesky factors;

  std::size_t vertices() const { return factors.size(); }
};

/// g of a triangle with these cotangents whose corners are there.
std::array<Vec3, 2> area_gradients(const Vec3& cotangents, const Vec3& a, const Vec3& b, const Vec3& c);

/// Bytes that it takes, about, for a surface of so many vertices.
std::size_t stitching_bytes(std::size_t vertices);

/// To the cage's faces. Throws base::Error when the model has no vertices, or is so large or so small
/// (beyond 1e75 and 1e-75) that its system cannot be factored; base::Cancelled. The same for any number of
/// threads.
Stitching stitch(const mesh::Surface& model, const Cage& cage, base::WorkerPool& pool,
                 const StitchingSettings& settings = {}, base::Progress* progress = nullptr);

}  // namespace viete::deform
