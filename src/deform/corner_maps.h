// Maps of edges, vertices and polygons, each the mean of those of its sides or corners.
#pragma once

#include <memory>

#include "deform/element_maps.h"

namespace viete::deform {

/// After S. Kaji's deformer, whose tetrahedra these are: two edges of the cage and an offset across, rest to
/// posed. All reproduce similarities, take the corners of a polygon alike, however it is cut into triangles,
/// and have offsets that grow with the cage. A map is the identity where its tetrahedron is flat at rest.

/// Of each triangle, those of its polygon: of a triangle its own; of others one a corner, of the edges to the
/// next and the previous corner and N / sqrt|N|, N their cross product. Corners that are flat at rest, as in
/// the middle of a side, have none, unless all are. All triangles of a convex polygon share its map and its
/// centre; one of a concave polygon, whose ends may be far from each other, has those of its own corners, and
/// its own centre.
std::unique_ptr<const ElementMaps> polygon_maps(const Cage& cage);
/// Of each polygon edge, one map a polygon beside it: of the edge, the way from its middle to the polygon's
/// centroid, and, shared, |edge| times the unit mean of the polygons' unit normals.
std::unique_ptr<const ElementMaps> edge_maps(const Cage& cage);
/// Of each vertex, one map a polygon corner: of the edges to the next and the previous corner, and, shared,
/// the root of the summed areas of the corners' triangles along the mean of their unit normals.
std::unique_ptr<const ElementMaps> vertex_maps(const Cage& cage);
/// Of each vertex, one map a polygon corner: of the two edges and N / sqrt|N|, N their cross product.
std::unique_ptr<const ElementMaps> vertex_face_maps(const Cage& cage);

}  // namespace viete::deform
