// Affine maps of the cage's triangles and patches from rest to pose; polar decompositions and logs of maps.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "mesh/vector.h"
#include "pose/cage.h"
#include "pose/rows.h"
#include "sym3/rotation.h"
#include "sym3/small_matrices.h"
#include "sym3/sym3.h"

namespace viete::pose {

/// Maps a point x to linear * (x - c) + center + origin. c is the element's centre at rest, and origin is the
/// pose's origin. `linear` is stored by rows.
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

/// Returns a + w * b.
inline sym3::Sym3<double> plus(const sym3::Sym3<double>& a, double w, const sym3::Sym3<double>& b) {
  return {a.xx + w * b.xx, a.xy + w * b.xy, a.xz + w * b.xz,
          a.yy + w * b.yy, a.yz + w * b.yz, a.zz + w * b.zz};
}

inline sym3::Mat3<double> times(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b) {
  return sym3::product(a, b);
}

using sym3::full;

/// Returns the centre of the bounding box.
Vec3 middle(std::span<const mesh::Point> positions);

/// Returns the pose's origin. Positions relative to this origin are precise even far from the coordinate
/// origin. The origin is the middle of the rest cage, moved near the middle of the pose in large steps. Each
/// step is at least half of the cage's size, so a small edit does not change the origin.
Vec3 pose_origin(const Cage& cage, std::span<const mesh::Point> posed);

/// Returns the matrix M that maps the rest basis to u, v and n. Near rest, computes M as I + (posed - rest) *
/// rest^-1. For an unmoved element, M is then exactly I.
sym3::Mat3<double> linear_map(const RestBasis& rest, const Vec3& u, const Vec3& v, const Vec3& n);

/// Computes linear = [u' v' n'] * [u v n]^-1. At rest, u and v are two edges, and n = N / sqrt|N| with
/// N = cross(u, v). u', v' and n' are the same vectors in the pose. The maps reproduce similarities. An
/// element that is unmoved or degenerate at rest gets exactly I. A posed element without area gets a matrix
/// of rank 2 or less. Changes only the maps of `elements`. `maps` has one entry per element, `posed` has one
/// position per vertex.
void face_maps(const Cage& cage, std::span<const mesh::Point> posed, const Vec3& origin,
               std::span<const std::uint32_t> elements, std::span<AffineMap> maps);

/// The polar decomposition of a map: linear = rotation * exp(stretch) and rotation = exp(turn).
struct MapSplit {
  sym3::Mat3<double> rotation;  ///< the nearest rotation
  sym3::Sym3<double> stretch;  ///< X = log S; valid if `least` is positive and not tiny relative to `largest`
  Vec3 turn;                   ///< rotation vector, |turn| <= pi
  double least, largest;       ///< singular values; NaN if the map is not finite, least < 0 if it mirrors
};

/// Splits the maps of `elements` in double precision and leaves other splits unchanged. The bits of a split
/// depend only on its map. For the errors of rotation and stretch, see sym3/polar.h and sym3/log.h.
void split_maps(std::span<const AffineMap> maps, std::span<const std::uint32_t> elements,
                std::span<MapSplit> splits);

/// The log of a map: linear = exp(rotation) * exp(stretch). A blend sums these twelve numbers with weights.
struct MapLog {
  sym3::Sym3<double> stretch;  ///< X = log S
  Vec3 rotation;               ///< Y = log R as a rotation vector, any number of turns
  Vec3 center;                 ///< posed centroid minus the pose's origin
};

/// Returns the log in the layout of LogVector::logs.
inline std::array<double, 9> numbers(const MapLog& log) {
  const auto& [x, y, center] = log;
  return {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz, y[0], y[1], y[2]};
}

/// Results of log_maps() that are shown to the user, and the turns that the next pose needs.
struct LogReport {
  std::vector<Vec3> turns;               ///< one per part of the cage; input of log_maps() for the next pose
  std::vector<std::uint32_t> collapsed;  ///< ascending indices of (nearly) collapsed maps
  /// Pairs of neighbouring maps whose rotations differ by more than 120 degrees, or whose logs differ by more
  /// than 180 degrees. Blends between such maps are ambiguous.
  std::vector<mesh::Edge> torn;
};

/// Returns the geometric mean of the elements' largest stretches. Ignores skipped elements.
double mean_stretch(std::span<const std::uint8_t> skipped, std::span<const MapSplit> splits);

/// The polar decomposition M = rotation * axes * diag(stretches) * axes^T.
struct Polar {
  sym3::Mat3<double> rotation;  ///< proper rotation, by rows
  sym3::Mat3<double> axes;      ///< columns are the directions of stretch at rest
  Vec3 stretches;               ///< descending, not negative
};

/// Computes the decomposition by SVD: M = U * D * V^T and rotation = U * V^T. If det M < 0, flips the
/// singular vector of the smallest value. If M = 0, the rotation is I. If M is not finite, all numbers are
/// NaN.
Polar polar(const sym3::Mat3<double>& m);

/// Returns axes * diag(log(stretches)) * axes^T. The stretches must be positive.
sym3::Sym3<double> log_stretch(const Polar& polar);

/// Returns true if `least` is at least the minimum stretch of log_maps(). Returns false for NaN.
bool is_ordinary(double least, double largest, double mean_stretch);

/// Leaves an ordinary split unchanged, see is_ordinary(). Otherwise splits the map by SVD, and raises small
/// singular values to the minimum of log_maps(). Returns true if it raised one, or if the map is not finite.
bool raise_to_floor(const AffineMap& map, double mean_stretch, MapSplit& split);

/// Computes X = log S and Y = log R of each map R * S. Uses the split, or an SVD if the map mirrors or nearly
/// collapses. Singular values below a minimum are replaced by this minimum: 1e-3 of the element's largest
/// singular value, but at least 1e-4 of mean_stretch(). A mirroring map gets the closest proper rotation. A
/// map that is not finite counts as collapsed and gets the log of I.
///
/// choose_branches() chooses the branch of Y. To follow a continuous motion through any number of turns, pass
/// the report.turns of the previous call. logs.size() must be maps.size(). Takes O(k log k) time for k maps.
/// Limitation: a rotation by almost a whole turn (|Y| near 360 degrees) has a nearly arbitrary axis. Elements
/// with such rotations blend badly unless they rotate rigidly together. report.torn lists these elements.
void log_maps(const Cage& cage, std::span<const AffineMap> maps, std::span<const MapSplit> splits,
              std::span<const Vec3> turns, std::span<MapLog> logs, LogReport& report);

/// Returns true if the rows contain moments, see moments.h.
inline bool has_moments(RowForm form) {
  return form >= RowForm::affine_moments;
}

/// Affine maps of patches. A patch is a vertex of the cage with the vertices around it.
///
/// A cage vertex at c and the vertices p of its patch move to c' and p'. M is fitted by least squares:
///
///     M = (sum w * (p' - c') * (p - c)^T) * K^-1 = sum (p' - c') * g^T,
///     K = sum w * (p - c) * (p - c)^T,    g = w * K^-1 * (p - c).
///
/// A patch starts with the vertices of all polygons at c. It grows by rings until its vertices spread in all
/// directions: the least singular value of all sqrt(w) * (p - c) must be at least a tenth of the largest.
/// Most patches need one ring. Growth stops at 256 vertices, or at the end of the connected part. The weight
/// w = 1 / (e^2 + |p - c|^2) keeps the fit local. e is 3 % of `size`, the size of the cage.
///
/// A patch reproduces any affine pose of the whole cage, unless the patch is flat to a thousandth of its
/// size. A flat patch uses the normal as third direction, as face_maps() does, and reproduces only
/// similarities. A vertex without polygons gets the identity.
class VertexPatches {
public:
  /// The cage must outlive this object.
  VertexPatches(const Cage& cage, double size);

  /// A vertex of a patch, and the vector g of this vertex.
  struct Member {
    std::uint32_t vertex;
    Vec3 dual;
  };
  struct Patch {
    std::vector<Member> members;  ///< empty for a vertex without polygons
    Vec3 normal_dual{0, 0, 0};    ///< g of the normal; 0 if the vertices determine all directions
  };
  std::span<const Member> members(std::size_t patch) const { return patches_[patch].members; }

  /// Changes only the maps of the patches in `which`. Patches without moved vertices get exactly I. maps and
  /// posed have one entry per vertex of the cage.
  void compute(std::span<const mesh::Point> posed, const Vec3& origin, std::span<const std::uint32_t> which,
               std::span<AffineMap> maps) const;

private:
  Vec3 normal(std::uint32_t vertex, std::span<const mesh::Point> at) const;

  const Cage& cage_;
  mesh::Adjacency triangles_;       // elements around each vertex
  std::vector<Vec3> rest_normals_;  // normal() of each vertex at rest
  std::vector<Patch> patches_;
};

}  // namespace viete::pose
