// Affine maps of patches. A patch is a vertex of the cage with the vertices around it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "mesh/adjacency.h"
#include "pose/cage.h"
#include "pose/maps.h"

namespace viete::pose {

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
