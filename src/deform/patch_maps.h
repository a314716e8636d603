// Maps of the patches about the cage's vertices: the affine map that fits a vertex and its neighbours best.
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
/// over the vertices p that share a polygon with it, then those that share one with them, ring after ring,
/// until they spread as far in all directions: until the least singular value of their sqrt(w) (p - c) is a
/// tenth of the largest, or more. w = 1 / (e^2 + |p - c|^2) keeps the fit local, e being 3 % of `size`, that
/// of the cage. In most places one ring does. A patch ends where it has 256 vertices or the part of the cage
/// has no more.
///
/// Any affine pose of the whole cage is the map of every patch. Where one lies in a plane, to a thousandth of
/// its size, there is no third direction, and the normal there stands for it, as in face_maps(): then
/// similarities are. The map is the identity where no polygon has the vertex.
class VertexPatches {
public:
  /// The cage must outlive it.
  VertexPatches(const Cage& cage, double size);

  /// A vertex that a patch moves with, and g.
  struct Member {
    std::uint32_t vertex;
    Vec3 dual;
  };
  struct Patches {
    std::vector<std::size_t> starts;  ///< in members; one more than patches
    std::vector<Member> members;      ///< patch by patch; none of vertices of no polygon
    std::vector<Vec3> normal_duals;   ///< of each patch's normal; 0 where its vertices do
  };
  std::span<const Member> members(std::size_t patch) const {
    return std::span(patches_.members)
        .subspan(patches_.starts[patch], patches_.starts[patch + 1] - patches_.starts[patch]);
  }

  /// Updates only these patches. Exactly I for a patch none of whose vertices moved.
  /// maps.size(): one a vertex of the cage, posed likewise.
  void compute(std::span<const mesh::Point> posed, const Vec3& origin, std::span<const std::uint32_t> which,
               std::span<AffineMap> maps) const;

private:
  Vec3 normal(std::uint32_t vertex, std::span<const mesh::Point> at) const;

  const Cage& cage_;
  mesh::Adjacency triangles_;       // around each vertex
  std::vector<Vec3> rest_normals_;  // as long as the size of what they stand on
  Patches patches_;
};

}  // namespace viete::deform
