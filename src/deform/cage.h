// A cage at rest: its triangles with their bases, its neighbourhood, and poses of it.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/error.h"
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

/// x / sqrt|x| for an area vector x: its length is the side of a square of that area. Any length scale; 0 for
/// 0.
Vec3 side_along(const Vec3& area);

/// The basis of a triangle with these positions.
RestBasis rest_basis(std::span<const mesh::Point> positions, const mesh::Triangle& triangle);

/// The rest cage with all data that posing does not change. Elements are its triangles.
struct Cage {
  mesh::Surface surface;                 ///< rest positions and triangles
  std::vector<std::uint8_t> unused;      ///< 1 for a vertex of no polygon
  std::vector<mesh::Edge> edges;         ///< edges of its polygons, each once
  std::vector<Vec3> centers;             ///< rest centroid of each element
  std::vector<RestBasis> bases;          ///< one per element; meaningful only if it has area
  std::vector<std::uint8_t> degenerate;  ///< 1 where an element has no area at rest: identity map, no weight
  /// Pairs of elements that share an edge (vertices at the same place count as one); sorted. Elements without
  /// area are left out and their neighbours joined, so that they do not cut the cage into parts.
  std::vector<mesh::Edge> dual_edges;
  /// The element where rotation branches start, one per connected part of the dual graph: its centre (least
  /// eccentricity, lowest index). A function of the rest cage alone.
  std::vector<std::uint32_t> roots;
  std::vector<std::uint32_t> parts;  ///< part of each element, an index of roots; without area: roots.size()
  double diagonal = 0;               ///< diagonal of the rest bounding box, the unit of tolerances
  double size = 0;                   ///< mesh::used_size(), the unit of radii
  double contact = 0;    ///< points nearer than this to an element count as on it: the level of rounding
  bool closed = false;   ///< every edge has exactly two triangles, which traverse it in opposite directions
  mesh::OneSided sides;  ///< sides for mean value coordinates
  std::vector<std::string> warnings;  ///< one line each, naming elements (0-based)

  std::size_t element_count() const { return centers.size(); }
};

/// The surface has an edge with an odd number of triangles above one, all with area.
struct FinError : base::Error {
  using base::Error::Error;
};

/// Throws base::Error if the surface has no triangle with area or is closed but squashed flat, and FinError.
/// Open, flat, inside-out and touching cages work, with a warning.
Cage make_cage(mesh::Surface surface);

/// A placeholder for a missing cage: two vertices at corners of the box, and no elements. With no_motion() it
/// leaves a model at rest, so that layers such as ProbeLayer can move it. The box must not be empty.
Cage no_cage(const mesh::Bounds& box);

/// Longest valid turn vector of a file, in radians.
inline constexpr double largest_turn = 1e6;

/// Posed positions and whole turns: for each part of the cage (see roots) the rotation vector, in radians,
/// that the logs of its elements must be nearest to. Missing or 0: the least rotation. With the turns, the
/// window and the command line reproduce the same pose.
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
  std::size_t misoriented = 0;    ///< edges that two triangles traverse in the same direction
  /// Edges of the surface with an odd number of triangles above one, all with area. A fin ends there; both of
  /// its sides face the outside.
  std::vector<mesh::Edge> fins;
};

/// Vertices at the same place count as one. Skipped elements have no edges; their neighbours are joined.
DualGraph dual_graph(const mesh::Surface& surface, std::span<const std::uint8_t> skip);

/// Pairs i < j of elements that are not skipped, sorted, each once; the neighbours of each cluster of skipped
/// elements are joined in a chain.
std::vector<mesh::Edge> without_skipped(std::vector<mesh::Edge> pairs, std::span<const std::uint8_t> skip);

struct GraphParts {
  std::vector<std::uint32_t> centers;
  std::vector<std::uint32_t> of;  ///< part of each element: an index of centers; skipped: centers.size()
};
/// The connected parts of a graph, in the order of their lowest elements, without skipped elements. The
/// centre is the element of least eccentricity, lowest index first. Exact up to 4,096 elements per part; for
/// larger ones the middle of a longest path found by two sweeps, so that the cost stays O(4096 edges).
GraphParts graph_parts(std::size_t elements, std::span<const mesh::Edge> edges,
                       std::span<const std::uint8_t> skip);

}  // namespace viete::deform
