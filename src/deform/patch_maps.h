// Link 1 of the frame, of patches: the affine map that fits a cage triangle and its neighbours best.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/affine_map.h"
#include "deform/cage.h"

namespace viete::deform {

/// A cage vertex, and how far its movement goes into the map of a patch.
struct PatchVertex {
  std::uint32_t vertex;
  Vec3 dual;
};

/// What of patches does not change with the pose: the least-squares fit about the triangle's centroid c,
///
///     M = (sum w (p' - c') (p - c)^T) K^-1 = sum (p' - c') g^T,    K = sum w (p - c) (p - c)^T,  g = w K^-1
///     (p - c),
///
/// over the vertices p of the triangle, of its neighbours across edges, of theirs, ring after ring, until
/// they spread as far in all directions: until the least singular value of their sqrt(w) (p - c) is a tenth
/// of the largest, or more. w = 1 / (e^2 + |p - c|^2) keeps the fit local, e being 3 % of the cage's
/// diagonal. In most places one ring does. A patch ends where it has 256 vertices or the part of the cage has
/// no more.
///
/// Any affine pose of the whole cage is the map of every patch. Where one lies in a plane, to a thousandth of
/// its size, there is no third direction, and the normal of the triangle stands for it, as in face_maps():
/// then similarities are.
struct Patches {
  std::vector<std::size_t> starts;    ///< in vertices; one more than elements
  std::vector<PatchVertex> vertices;  ///< patch by patch; none where the triangle has no area
  std::vector<Vec3> normal_duals;     ///< of each patch's normal; 0 where its vertices do

  std::span<const PatchVertex> of(std::size_t element) const {
    return std::span(vertices).subspan(starts[element], starts[element + 1] - starts[element]);
  }
};

Patches make_patches(const Cage& cage);

/// Of these elements alone; the others' maps stay as they are. Exactly I for a patch that did not move, and
/// where the rest triangle has no area. Sizes as for face_maps().
void patch_maps(const Cage& cage, const Patches& patches, std::span<const mesh::Point> posed,
                const Vec3& origin, std::span<const std::uint32_t> elements, std::span<AffineMap> maps);

}  // namespace viete::deform
