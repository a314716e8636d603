// Affine maps of the cage's triangles from rest to pose, and links 1 and 2 of the frame: polar split and
// logs.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "deform/rows.h"
#include "mesh/vector.h"
#include "sym3/rotation.h"
#include "sym3/small_matrices.h"
#include "sym3/sym3.h"

namespace viete::deform {

/// x' = linear (x - c) + center + origin, c the element's rest centre. Entries of linear by rows.
struct AffineMap {
  sym3::Mat3<double> linear;
  mesh::Vec3 center;  ///< posed centre minus the pose's origin
};

inline mesh::Vec3 times(const sym3::Sym3<double>& s, const mesh::Vec3& x) {
  return {s.xx * x[0] + s.xy * x[1] + s.xz * x[2], s.xy * x[0] + s.yy * x[1] + s.yz * x[2],
          s.xz * x[0] + s.yz * x[1] + s.zz * x[2]};
}

inline mesh::Vec3 times(const sym3::Mat3<double>& m, const mesh::Vec3& x) {
  return {m[0] * x[0] + m[1] * x[1] + m[2] * x[2], m[3] * x[0] + m[4] * x[1] + m[5] * x[2],
          m[6] * x[0] + m[7] * x[1] + m[8] * x[2]};
}

/// a + w b.
inline sym3::Sym3<double> plus(const sym3::Sym3<double>& a, double w, const sym3::Sym3<double>& b) {
  return {a.xx + w * b.xx, a.xy + w * b.xy, a.xz + w * b.xz,
          a.yy + w * b.yy, a.yz + w * b.yz, a.zz + w * b.zz};
}

inline sym3::Mat3<double> times(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b) {
  return sym3::product(a, b);
}

using sym3::full;

/// The middle of a bounding box; of the rest cage, it is also the origin of poses near rest.
Vec3 middle(std::span<const mesh::Point> positions);

/// Origin of a pose's positions, chosen so that blending keeps precision for poses far from the coordinate
/// origin: the middle of the rest cage, plus the translation to the pose's middle in steps of about half the
/// cage. During editing the origin changes only for large steps, so vertices outside the edit's reach keep
/// their bits.
Vec3 pose_origin(const Cage& cage, std::span<const mesh::Point> posed);

/// The matrix from the basis at rest to u, v, n; near rest computed as I + (posed - rest) rest^-1, which is
/// exactly I for an element that did not move.
sym3::Mat3<double> linear_map(const RestBasis& rest, const Vec3& u, const Vec3& v, const Vec3& n);

/// Centroid of an element at these positions, relative to origin.
Vec3 element_center(const Cage& cage, std::size_t element, std::span<const mesh::Point> positions,
                    const Vec3& origin);

/// linear = [u' v' n'][u v n]^-1 with u, v two edges and n = N / sqrt|N|, N = u x v. Reproduces similarities;
/// exactly I for unmoved elements and for degenerate rest elements. A posed element without area gives a
/// matrix of rank 2 or less. Writes only maps of `elements`. maps.size() == cage.element_count(),
/// posed.size() == cage.surface.positions.size().
void face_maps(const Cage& cage, std::span<const mesh::Point> posed, const Vec3& origin,
               std::span<const std::uint32_t> elements, std::span<AffineMap> maps);

/// linear = rotation * exp(stretch), rotation = exp(turn). Does not depend on other elements.
struct MapSplit {
  sym3::Mat3<double> rotation;  ///< the nearest rotation
  sym3::Sym3<double> stretch;  ///< X = log S; valid if `least` is positive and not tiny relative to `largest`
  Vec3 turn;                   ///< |turn| <= pi
  double least, largest;       ///< stretches; least < 0 for a mirroring map, NaN for one that is not finite
};

/// Splits the maps of `elements` in double precision; leaves other splits unchanged. Each split depends only
/// on its own map, bit for bit. Errors of rotation and stretch: see sym3/polar.h and sym3/log.h.
void split_maps(std::span<const AffineMap> maps, std::span<const std::uint32_t> elements,
                std::span<MapSplit> splits);

/// linear = exp(rotation) exp(stretch). Twelve numbers, blended linearly.
struct MapLog {
  sym3::Sym3<double> stretch;  ///< X = log S
  Vec3 rotation;               ///< Y = log R as a rotation vector, any number of turns
  Vec3 center;                 ///< posed centroid minus the pose's origin
};

/// The log in the layout of LogVector::logs.
inline std::array<double, 9> numbers(const MapLog& log) {
  const auto& [x, y, center] = log;
  return {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz, y[0], y[1], y[2]};
}

/// Decisions made while taking logs: shown to the user, and passed to the next pose.
struct LogReport {
  std::vector<Vec3> turns;  ///< per part of the cage, see Branches: pass as the next pose's `turns`
  std::vector<std::uint32_t> collapsed;  ///< maps, ascending, whose stretch was raised to the floor
  /// Neighbouring maps whose rotations differ by more than 120 degrees, or whose logs by more than 180: the
  /// blend between them is ambiguous. (A ring of elements that turns once always has such a pair.)
  std::vector<mesh::Edge> torn;
};

/// Geometric mean of the largest stretches of elements that are not skipped: the overall scale of a pose.
double mean_stretch(std::span<const std::uint8_t> skipped, std::span<const MapSplit> splits);

/// M = rotation * axes diag(stretches) axes^T.
struct Polar {
  sym3::Mat3<double> rotation;  ///< proper, entries by rows
  sym3::Mat3<double> axes;      ///< columns are the directions of stretch at rest
  Vec3 stretches;               ///< descending, not negative
};

/// By singular values (M = U diag V^T, R = U V^T). det M < 0: the closest proper rotation, the smallest
/// singular vector flipped. M = 0 gives R = I.
Polar polar(const sym3::Mat3<double>& m);

/// X = axes diag(log stretches) axes^T. The stretches must be positive.
sym3::Sym3<double> log_stretch(const Polar& polar);

/// True if the least and the largest stretch of a map are above the floors below. False for NaN.
bool is_ordinary(double least, double largest, double mean_stretch);

/// Replaces the split of a map that mirrors, collapses or is not finite by its SVD with singular values
/// raised to the floors below; leaves other splits. True if one was raised, or the map is not finite.
bool raise_to_floor(const AffineMap& map, double mean_stretch, MapSplit& split);

/// For each map, linear = R S: X = log S, Y = log R, from its split, or by SVD if it mirrors or nearly
/// collapses. Singular values are raised to 1e-3 of the element's largest one and to 1e-4 of the pose's mean
/// one: no element collapses fully. A mirrored map takes the closest proper rotation. A map that is not
/// finite counts as collapsed, with the log of I.
///
/// Branches of Y: choose_branches(). A pure function of its inputs; passing report.turns to the next call
/// follows a continuous motion through any number of turns. logs.size() == maps.size(). O(k log k).
///
/// Limitation: rotations near a nonzero whole turn (|Y| about 360 degrees) have nearly arbitrary axes, so
/// elements there that do not rotate rigidly together blend badly; `torn` lists them.
void log_maps(const Cage& cage, std::span<const AffineMap> maps, std::span<const MapSplit> splits,
              std::span<const Vec3> turns, std::span<MapLog> logs, LogReport& report);

/// True if maps are fitted to points: see moments.h.
inline bool has_moments(RowForm form) {
  return form >= RowForm::affine_moments;
}

}  // namespace viete::deform
