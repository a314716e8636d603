// Maps of the patches around the cage's vertices: the affine map that best fits a vertex and its neighbours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "deform/maps.h"
#include "mesh/adjacency.h"

namespace viete::deform {

/// A patch is the least-squares fit about a vertex c of the cage,
///
///     M = (sum w (p' - c') (p - c)^T) K^-1 = sum (p' - c') g^T,    K = sum w (p - c) (p - c)^T,  g = w K^-1
///     (p - c),
///
/// over the vertices p that share a polygon with c, then over further rings, until they spread in all
/// directions: until the least singular value of their sqrt(w) (p - c) is at least a tenth of the largest. w
/// = 1 / (e^2 + |p - c|^2) keeps the fit local, e being 3 % of `size`, the size of the cage. Usually one ring
/// suffices. A patch is limited to 256 vertices and to its part of the cage.
///
/// Every patch reproduces any affine pose of the whole cage. A patch that is flat to a thousandth of its size
/// uses the normal as third direction, as in face_maps(), and then reproduces similarities. The map is the
/// identity for a vertex of no polygon.
class VertexPatches {
public:
  /// The cage must outlive it.
  VertexPatches(const Cage& cage, double size);

  /// A vertex that the patch depends on, and g.
  struct Member {
    std::uint32_t vertex;
    Vec3 dual;
  };
  struct Patches {
    std::vector<std::size_t> starts;  ///< offsets in members; one more than patches
    std::vector<Member> members;      ///< patch by patch; empty for vertices of no polygon
    std::vector<Vec3> normal_duals;  ///< g of each patch's normal; 0 if its vertices determine all directions
  };
  std::span<const Member> members(std::size_t patch) const {
    return std::span(patches_.members)
        .subspan(patches_.starts[patch], patches_.starts[patch + 1] - patches_.starts[patch]);
  }

  /// Updates only these patches. Exactly I for a patch with no moved vertex. maps.size(): one per vertex of
  /// the cage, posed likewise.
  void compute(std::span<const mesh::Point> posed, const Vec3& origin, std::span<const std::uint32_t> which,
               std::span<AffineMap> maps) const;

private:
  Vec3 normal(std::uint32_t vertex, std::span<const mesh::Point> at) const;

  const Cage& cage_;
  mesh::Adjacency triangles_;       // triangles around each vertex
  std::vector<Vec3> rest_normals_;  // length: the size of the adjacent triangles
  Patches patches_;
};

}  // namespace viete::deform
