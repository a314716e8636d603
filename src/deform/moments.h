// Moving least squares: every vertex gets the map that best fits the motion of the cage's points. S.
// Schaefer, T. McPhail, J. Warren: Image Deformation Using Moving Least Squares, 2006. In 3D: Y. Zhu, S.
// Gortler: 3D Deformation Using Moving Least Squares, 2007.
#pragma once

#include <cstddef>
#include <span>

#include "deform/binding.h"
#include "deform/cage_state.h"

namespace viete::deform {

/// The cage's points p move to p'. A vertex x has one weight w per point; the weights sum to 1. Let v =
/// max(w, 0), and let m and m' be the means of p and p' with the weights v. Then
///
///     x' = M (x - sum w p) + sum w p',
///     B = sum v (p' - m')(p - m)^T + l^2 sum v A,    K = sum v (p - m)(p - m)^T + l^2 sum v I.
///
/// M is B K^-1 for `affine`. With B = R S (polar), M is R for `rigid` and R tr S / tr K for `similar`.
///
/// The paper has only the first terms of B and K. These terms vanish if one point has all the weight, and
/// lose rank if the weighted points lie in a plane. M would then be undetermined. Therefore every point also
/// adds the map A of its patch (patch_maps.h), like a cloud of points of radius l. l is 10 % of the cage's
/// edge length. With these terms, K is never singular. `affine` still follows affine poses of the cage
/// exactly (only similarities if the cage is flat); `rigid` and `similar` follow similarities.
///
/// Negative (biharmonic) weights affect only the sums of w p and w p'. In K, negative weights could cancel
/// other weights. Computes the positions of the vertices [begin, end) independently, in double. Shares scale
/// the displacements. The rows must have a moment form.
void place_by_moments(const VertexBlock& block, const Rows& rows, std::size_t begin, std::size_t end,
                      std::span<mesh::Point> positions);

/// Rest data of one vertex for the fused frame. The frame sums B' = sum v p' (p - n)^T + l^2 sum v A about a
/// fixed point n next to m. This avoids cancellation. Because n is rounded, B' - B = m' s^T, where s = sum v
/// (p - n) is so small that sum w p' can replace m'.
struct RestMoment {
  Vec3 dual;     ///< K^-1 (x - sum w p), times l
  double scale;  ///< l / tr K, times the unit of the frame's positions
};

/// All lengths and the frame's unit are multiples of l. moments is sum v ((p - p0)(p - n)^T + l^2 I) by rows,
/// for any p0. p - n is rounded as in the frame, so the matrix is not quite symmetric. sum is s, weight is
/// sum v, shift is n - p0, offset is x - sum w p. If the weight is 0, returns 0, so the vertex stays.
RestMoment rest_moment(const sym3::Mat3<double>& moments, const Vec3& sum, double weight, const Vec3& shift,
                       const Vec3& offset, double unit);

}  // namespace viete::deform
