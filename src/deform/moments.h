// Moving least squares: at every vertex the map that moves the cage's points most nearly as they do. S.
// Schaefer, T. McPhail, J. Warren: Image Deformation Using Moving Least Squares, 2006; in space Y. Zhu, S.
// Gortler: 3D Deformation Using Moving Least Squares, 2007.
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
/// Of the paper are the first terms. They vanish where one point has all the weight, and lack directions
/// where the points that count lie in a plane: there M would be anything. So every point takes with it a
/// little of what is about it, the map A of its patch (patch_maps.h), as if it were a cloud of radius l, 10 %
/// of the cage's edges. K then is never singular, and nothing that the paper's maps reproduce is lost:
/// `affine` follows affine poses of the cage exactly (where the cage is flat, similarities), the others
/// similarities.
///
/// Weights below 0 (biharmonic ones) move the means of x' alone: in K they could cancel others.
///
/// Positions of the vertices [begin, end) of a binding for the staged engine, all links at once, in double.
/// Each is computed by itself. Of its way from rest a vertex goes its share. The form of the rows must be one
/// of moments. ways, of all vertices: how far their shapes are from rest; empty: at rest.
void place_by_moments(const Binding& binding, const Shares& shares, const Rows& rows,
                      std::span<const Vec3> ways, std::size_t begin, std::size_t end,
                      std::span<mesh::Point> positions);

/// What the fused frame knows of a vertex at rest. It sums B' = sum v p' (p - n)^T + l^2 sum v A about a
/// fixed point n next to m, so that nothing cancels; what the rounding of n leaves, B' - B = m' s^T with s =
/// sum v (p - n), is small enough to take sum w p' for m'.
struct RestMoment {
  Vec3 dual;     ///< K^-1 (x - sum w p), times l
  double scale;  ///< l / tr K, times the unit of the frame's positions
};

/// moments: sum v ((p - p0)(p - n)^T + l^2 I) by rows, of any p0, as the frame sums them: where it rounds
/// p in the second factor so do these, and are not quite symmetric; sum: s; weight: sum v; shift: n - p0;
/// offset: x - sum w p. All lengths in l, and the frame's unit too. 0 without weights, whose vertex stays.
RestMoment rest_moment(const sym3::Mat3<double>& moments, const Vec3& sum, double weight, const Vec3& shift,
                       const Vec3& offset, double unit);

}  // namespace viete::deform
