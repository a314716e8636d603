// Moving least squares: every vertex gets the map that best fits the motion of the cage's points.
// 2D: S. Schaefer, T. McPhail, J. Warren, Image Deformation Using Moving Least Squares, 2006.
// 3D: Y. Zhu, S. Gortler, 3D Deformation Using Moving Least Squares, 2007.
#pragma once

#include <cstddef>
#include <span>

#include "pose/cage_state.h"
#include "weights/binding.h"

namespace viete::deform {

using mesh::Vec3;

/// Computes the positions of the vertices [begin, end) in double. The rows must have a moment form. The
/// cage's points p move to p'. A vertex x has one weight w per point; the weights sum to 1. v = max(w, 0) are
/// the positive weights. m and m' are the means of p and p' with the weights v. Then
///
///     x' = M * (x - sum w * p) + sum w * p',
///     B = sum v * (p' - m') * (p - m)^T + l^2 * sum v * A,
///     K = sum v * (p - m) * (p - m)^T + l^2 * sum v * I.
///
/// The polar decomposition of B is R * S. M depends on the RowForm:
///     affine_moments: M = B * K^-1,   rigid_moments: M = R,   similar_moments: M = R * tr S / tr K.
///
/// The paper has only the first terms of B and K. If one point has all the weight, these terms vanish. If the
/// weighted points lie in a plane, these terms lose rank. M would then be undetermined. The second terms
/// prevent this: K is never singular. A is the map of the point's patch (pose/maps.h). A patch acts like a
/// cloud of points with the radius l, which is 10 % of the cage's edge length. affine_moments follows
/// affine poses of the cage exactly, if the cage is not flat. All forms follow similarities.
///
/// Negative (biharmonic) weights affect only the sums of w * p and w * p'. In K, negative weights could
/// cancel other weights. Shares scale the displacements. Each vertex is independent of other vertices.
void apply_moments(const weights::VertexBlock& block, const pose::Rows& rows, std::size_t begin,
                   std::size_t end, std::span<mesh::Point> positions);

/// Rest data of one vertex for the fused engine. To avoid cancellation, this engine computes B with a point n
/// near m in place of m, because a float cannot be exactly m:
///     B' = sum v * p' * (p - n)^T + l^2 * sum v * A = B + m' * s^T,    s = sum v * (p - n).
/// s is so small that the engine can use sum w * p' in place of m' in B = B' - m' * s^T.
struct RestMoment {
  Vec3 dual;     ///< K^-1 * (x - sum w * p) * l
  double scale;  ///< l / tr K, times the unit of the frame's positions
};

/// Returns the rest data of one vertex. `unit` and all lengths are multiples of l. The parameters are
///     moments = sum v * ((p - p0) * (p - n)^T + l^2 * I), by rows, for any point p0,
///     sum = s,    weight = sum v,    shift = n - p0,    offset = x - sum w * p.
/// p - n is rounded as frames round it, so `moments` is not quite symmetric. If `weight` is 0, all results
/// are 0.
RestMoment rest_moment(const sym3::Mat3<double>& moments, const Vec3& sum, double weight, const Vec3& shift,
                       const Vec3& offset, double unit);

}  // namespace viete::deform
