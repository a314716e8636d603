// A cage at rest: its triangles with their bases, its neighbourhood, and poses of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "mesh/half_edges.h"
#include "mesh/repair.h"
#include "mesh/surface.h"
#include "mesh/vector.h"

namespace viete::deform {

using mesh::cross, mesh::dot, mesh::largest_abs, mesh::norm, mesh::relative_to, mesh::squared_norm;
using mesh::Vec3;

/// Two edges u and v of a triangle from one of its corners, and n = N / sqrt|N|, N = u x v; 0 without area.
struct TriangleBasis {
  Vec3 u, v, n;
};
TriangleBasis triangle_basis(std::span<const mesh::Point> positions, const mesh::Triangle& triangle,
                             int corner);

/// A basis of an element at rest, as its map needs it: edges u and v from one of its corners, n = N / sqrt|N|
/// with N = u x v; and the dual basis, the rows of [u v n]^-1.
struct RestBasis {
  int corner = 0;
  Vec3 u{}, v{}, n{}, dual_u{}, dual_v{}, dual_n{};
};

/// x / sqrt|x| of an area x: as long as its side. Any length scale; 0 for 0.
Vec3 side_along(const Vec3& area);

/// Of a triangle of these positions.
RestBasis rest_basis(std::span<const mesh::Point> positions, const mesh::Triangle& triangle);

/// The rest cage with everything about it that does not change when it is posed. Elements are its triangles.
struct Cage {
  mesh::Surface surface;                 ///< rest positions and triangles
  std::vector<std::uint8_t> unused;      ///< 1 where no polygon has the vertex
  std::vector<mesh::Edge> edges;         ///< of its polygons, each once
  std::vector<Vec3> centers;             ///< rest centroid of each element
  std::vector<RestBasis> bases;          ///< of each element; of use where it has area
  std::vector<std::uint8_t> degenerate;  ///< 1 where an element has no area at rest: identity map, no weight
  /// Pairs of elements that share an edge (vertices at the same place count as one); sorted. Elements without
  /// area are left out and their neighbours joined, so that they do not cut the cage into parts.
  std::vector<mesh::Edge> dual_edges;
  /// The element where rotation branches start, one per connected part of the dual graph: its centre (least
  /// eccentricity, lowest index). A function of the rest cage alone.
  std::vector<std::uint32_t> roots;
  std::vector<std::uint32_t>
      parts;            ///< of each element the part, a place in roots; without area: roots.size()
  double diagonal = 0;  ///< of the rest bounding box, the unit of tolerances
  double size = 0;      ///< mesh::used_size(), the unit of radii
  double contact =
      0;  ///< a point nearer than this to an element lies on it: what rounding cannot tell from 0
  bool closed = false;   ///< every edge has exactly two triangles, run through in opposite directions
  mesh::OneSided sides;  ///< what mean value coordinates are of
  std::vector<std::string> warnings;  ///< one line each, naming elements (0-based)

  std::size_t element_count() const { return centers.size(); }
};

/// The mean of its corners.
Vec3 polygon_center(const mesh::Surface& surface, std::uint32_t polygon,
                    std::span<const mesh::Point> positions);

/// Throws base::Error if the surface has no triangle with area, is a closed one squashed flat, or has a fin
/// (an edge with three triangles). Open, flat, inside-out and touching cages work, with a warning.
Cage make_cage(mesh::Surface surface);

/// What stands for a cage where there is none: two vertices, corners of the box, and no elements. By
/// no_motion() a model stays as it is at rest, and what is upon that moves it (ProbeLayer). The box must not
/// be empty.
Cage no_cage(const mesh::Bounds& box);

/// Radians of one turn vector: a file with longer ones is not believed.
inline constexpr double largest_turn = 1e6;

/// Posed positions, and the whole turns that the pose has made: for each part of the cage (see roots) the
/// rotation vector that its elements' logs must be nearest to, radians. Missing or 0: the least rotation. A
/// full pose is both; the second is what makes window and command line agree.
struct Pose {
  std::vector<mesh::Point> positions;
  std::vector<Vec3> turns;
};

/// The rest positions, no turns.
Pose rest_pose(const Cage& cage);

struct DualGraph {
  std::vector<mesh::Edge> edges;  ///< pairs of elements i < j, sorted, each once
  std::size_t open = 0;           ///< edges with one triangle
  std::size_t nonmanifold = 0;    ///< edges with three or more
  std::size_t misoriented = 0;    ///< edges that two triangles run through in the same direction
  /// Edges of the surface with an odd number of triangles beyond one, all of them with area: a fin
  /// sticks out there, and neither side of it is inside.
  std::vector<mesh::Edge> fins;
};

/// Vertices at exactly the same place count as one. Skipped elements have no edges; their neighbours are
/// joined.
DualGraph dual_graph(const mesh::Surface& surface, std::span<const std::uint8_t> skip);

/// Pairs i < j of what is not skipped, sorted, each once; the neighbours of each cluster of skipped elements
/// are joined in a chain.
std::vector<mesh::Edge> without_skipped(std::vector<mesh::Edge> pairs, std::span<const std::uint8_t> skip);

/// The centre of each connected part, in the order of the parts' lowest elements: the element of least
/// eccentricity, lowest index first. Exact up to 4,096 elements in a part, beyond that the middle of a
/// longest path found by two sweeps, so that the cost stays O(4096 edges). Skipped elements have no part.
std::vector<std::uint32_t> graph_centers(std::size_t elements, std::span<const mesh::Edge> edges,
                                         std::span<const std::uint8_t> skip);

/// Of each element the place in `centers` of the one it hangs together with; centers.size() if with none.
std::vector<std::uint32_t> graph_parts(std::size_t elements, std::span<const mesh::Edge> edges,
                                       std::span<const std::uint32_t> centers);

}  // namespace viete::deform
