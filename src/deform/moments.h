// Moving least squares: at every vertex the map that best fits the motion of the cage's points. S. Schaefer,
// T. McPhail, J. Warren: Image Deformation Using Moving Least Squares, 2006; in space Y. Zhu, S. Gortler: 3D
// Deformation Using Moving Least Squares, 2007.
#pragma once

#include <cstddef>
#include <span>

#include "deform/binding.h"
#include "deform/cage.h"
#include "deform/cage_state.h"
#include "deform/maps.h"

namespace viete::deform {

/// A vertex x has weights w (sum 1) of points p that are moved to p'. With v the weights that are positive,
/// and m and m' their means of p and p',
///
///     x' = M (x - sum w p) + sum w p',
///     B = sum v (p' - m')(p - m)^T + l^2 sum v A,    K = sum v (p - m)(p - m)^T + l^2 sum v I,
///
/// `affine`: M = B K^-1; `rigid`: M = R, the rotation nearest to B, of B = R S; `similar`: M = R tr S / tr K.
///
/// The paper has only the first terms. They vanish if one point has all the weight, and are rank-deficient if
/// the weighted points lie in a plane: M would be undetermined. Therefore every point also contributes the
/// map A of its patch (patch_maps.h), like a cloud of points of radius l, 10 % of the cage's edges. K is then
/// never singular, and everything that the paper's maps reproduce is still reproduced: `affine` follows
/// affine poses of the cage exactly (similarities if the cage is flat), the others similarities.
///
/// Negative (biharmonic) weights affect only the means of x': in K they could cancel others.
///
/// Computes positions of the vertices [begin, end) of a binding for the staged engine, all links at once, in
/// double, each independently. Displacements are scaled by the shares. The form of the rows must be one of
/// moments. ways: displacements of all vertices' shapes from rest; empty: at rest.
void place_by_moments(const Binding& binding, const Shares& shares, const Rows& rows,
                      std::span<const Vec3> ways, std::size_t begin, std::size_t end,
                      std::span<mesh::Point> positions);

/// Per-vertex rest data of the fused frame. It sums B' = sum v p' (p - n)^T + l^2 sum v A about a fixed point
/// n next to m, which avoids cancellation; the remainder from rounding n, B' - B = m' s^T with s = sum v (p -
/// n), is so small that sum w p' can replace m'.
struct RestMoment {
  Vec3 dual;     ///< K^-1 (x - sum w p), times l
  double scale;  ///< l / tr K, times the unit of the frame's positions
};

/// moments: sum v ((p - p0)(p - n)^T + l^2 I) by rows, for any p0, summed like the frame: rounded in the
/// second factor likewise, and therefore not quite symmetric; sum: s; weight: sum v; shift: n - p0; offset: x
/// - sum w p. All lengths in l, including the frame's unit. 0 without weights; such a vertex stays.
RestMoment rest_moment(const sym3::Mat3<double>& moments, const Vec3& sum, double weight, const Vec3& shift,
                       const Vec3& offset, double unit);

}  // namespace viete::deform
