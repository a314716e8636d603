// Maps of faces: the affine map of each cage triangle, rest to posed.
#pragma once

#include <span>

#include "deform/affine_map.h"
#include "deform/cage.h"

namespace viete::deform {

/// The middle of a bounding box: of a rest cage, where poses have their origin too while they stay near.
Vec3 middle(std::span<const mesh::Point> positions);

/// What a pose's positions are taken relative to, so that blending them loses nothing when the pose is far
/// from the origin of the axes: the middle of the rest cage, plus the way to the pose's middle in steps of
/// about half the cage. A pose that is edited keeps its origin, but for large steps, and so what the edit
/// does not reach keeps its bits.
Vec3 pose_origin(const Cage& cage, std::span<const mesh::Point> posed);

/// What takes the basis at rest to u, v, n; near rest as I + (posed - rest) rest^-1, which is exactly I where
/// nothing moved.
sym3::Mat3<double> linear_map(const RestBasis& rest, const Vec3& u, const Vec3& v, const Vec3& n);

/// Centroid of an element at these positions, relative to origin.
Vec3 element_center(const Cage& cage, std::size_t element, std::span<const mesh::Point> positions,
                    const Vec3& origin);

/// linear = [u' v' n'][u v n]^-1 with u, v two edges and n = N / sqrt|N|, N = u x v. Reproduces similarities;
/// exactly I for an element that did not move, and for degenerate rest elements. A posed element without area
/// gives a matrix of rank 2 or less. Of these elements alone; the others' maps stay as they are. maps.size()
/// == cage.element_count(), posed.size() == cage.surface.positions.size().
void face_maps(const Cage& cage, std::span<const mesh::Point> posed, const Vec3& origin,
               std::span<const std::uint32_t> elements, std::span<AffineMap> maps);

}  // namespace viete::deform
