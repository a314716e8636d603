// Maps of patches: the affine map that fits an element and its neighbours best.
#pragma once

#include <memory>

#include "deform/element_maps.h"

namespace viete::deform {

/// A patch is the least-squares fit about its centre c,
///
///     M = (sum w (p' - c') (p - c)^T) K^-1 = sum (p' - c') g^T,    K = sum w (p - c) (p - c)^T,  g = w K^-1
///     (p - c),
///
/// over vertices p of the cage, ring after ring, until they spread as far in all directions: until the least
/// singular value of their sqrt(w) (p - c) is a tenth of the largest, or more. w = 1 / (e^2 + |p - c|^2)
/// keeps the fit local, e being 3 % of `size`, that of the cage. In most places one ring does. A patch ends
/// where it has 256 vertices or the part of the cage has no more.
///
/// Any affine pose of the whole cage is the map of every patch. Where one lies in a plane, to a thousandth of
/// its size, there is no third direction, and the normal there stands for it, as in face_maps(): then
/// similarities are.
///
/// Of a triangle: c is its centroid, p are its corners, those of its neighbours across edges, of theirs. The
/// map is the identity where the rest triangle has no area.
std::unique_ptr<const ElementMaps> face_patch_maps(const Cage& cage, double size);
/// Of a vertex: c is the vertex, p are those that share a polygon with it, then those that share one with
/// them. The map is the identity where no polygon has the vertex.
std::unique_ptr<const ElementMaps> vertex_patch_maps(const Cage& cage, double size);

}  // namespace viete::deform
