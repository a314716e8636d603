// The rest cage with the data of its triangles, and poses of the cage.
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

namespace viete::pose {

using mesh::cross, mesh::dot, mesh::largest_abs, mesh::norm, mesh::relative_to, mesh::squared_norm;
using mesh::Vec3;

/// Two edges u and v of a triangle at one corner, and n = N / sqrt(|N|) for N = u x v. If N is 0, n is 0.
struct TriangleBasis {
  Vec3 u, v, n;
};
TriangleBasis triangle_basis(std::span<const mesh::Point> positions, const mesh::Triangle& triangle,
                             int corner);

/// The basis (see TriangleBasis) of an element at rest. The dual vectors are the rows of [u v n]^-1.
struct RestBasis {
  int corner = 0;
  Vec3 u{}, v{}, n{}, dual_u{}, dual_v{}, dual_n{};
};

/// Returns area / sqrt(|area|) for an area vector; 0 for 0. The squared length of the result is |area|.
Vec3 side_along(const Vec3& area);

RestBasis rest_basis(std::span<const mesh::Point> positions, const mesh::Triangle& triangle);

/// The rest cage, with all data that do not depend on the pose.
struct Cage {
  mesh::Surface surface;  ///< rest positions and polygons
  /// The elements, as triangles of the polygons of `surface`, see mesh::CenterSplit. A polygon that repeats
  /// another one has no elements. `positions` are those of `surface`, then the centers; see with_centers().
  mesh::Surface elements;
  std::vector<std::uint32_t> split;      ///< the polygon of each center
  std::vector<std::uint8_t> unused;      ///< one per vertex: 1 if no polygon uses the vertex
  std::vector<mesh::Edge> edges;         ///< edges of the polygons, without duplicates
  std::vector<Vec3> centers;             ///< rest centroid of each element
  std::vector<RestBasis> bases;          ///< one per element; undefined if the element has no area
  std::vector<std::uint8_t> degenerate;  ///< 1: the element has no area; its map is I, its weight 0
  /// Pairs of elements that share an edge, sorted; see dual_graph(). Elements without area are skipped.
  std::vector<mesh::Edge> dual_edges;
  /// The central element of each connected part of the dual graph, see graph_parts().
  std::vector<std::uint32_t> roots;
  std::vector<std::uint32_t>
      parts;             ///< per element, an index into roots; roots.size() for elements without area
  double diagonal = 0;   ///< diagonal of the rest bounding box, the unit of tolerances
  double size = 0;       ///< mesh::used_size(), the unit of radii
  double contact = 0;    ///< points within this distance touch an element; about the rounding error
  bool closed = false;   ///< true: every edge has two triangles, in opposite directions along the edge
  mesh::OneSided sides;  ///< consistently oriented triangles for mean value coordinates
  std::vector<std::string> warnings;  ///< one line each, with element numbers from 0

  std::size_t element_count() const { return centers.size(); }
  std::uint32_t polygon_of(std::size_t element) const { return elements.triangle_polygon[element]; }
};

/// Returns positions for the vertices of Cage::elements, from positions of the cage's vertices.
std::vector<mesh::Point> with_centers(const Cage& cage, std::span<const mesh::Point> positions);

/// Thrown if an edge has an odd number of triangles, at least three, and all these triangles have an area.
struct FinError : base::Error {
  using base::Error::Error;
};

/// Throws FinError. Throws base::Error if no triangle has an area, or if the surface is flat and has no open
/// edge (see DualGraph). Cage::warnings lists other defects: repeated faces, faces without area, and open,
/// nonmanifold or misoriented edges.
Cage make_cage(mesh::Surface surface);

/// A placeholder for a missing cage: two vertices at opposite corners of the box, and no elements. With the
/// deformer no_motion(), only probes move the model. The box must not be empty.
Cage no_cage(const mesh::Bounds& box);

/// The longest valid turn vector in a file, in radians.
inline constexpr double largest_turn = 1e6;

/// The posed positions, and one rotation vector in radians for each part of the cage (see Cage::roots). The
/// vector tells the number of whole turns of the part, see choose_branches(). A missing vector is 0.
struct Pose {
  std::vector<mesh::Point> positions;
  std::vector<Vec3> turns;
};

Pose rest_pose(const Cage& cage);

struct DualGraph {
  std::vector<mesh::Edge> edges;  ///< pairs of elements i < j, sorted and unique
  std::size_t open = 0;           ///< edges with one triangle
  std::size_t nonmanifold = 0;    ///< edges with three or more triangles
  std::size_t misoriented = 0;    ///< edges that two triangles traverse in the same direction
  /// Edges that cause a FinError. Each is the end of a fin: a surface with the outside on both sides.
  std::vector<mesh::Edge> fins;
};

/// Connects elements with a common edge. Welds vertices at equal positions. skip: see without_skipped().
DualGraph dual_graph(const mesh::Surface& surface, std::span<const std::uint8_t> skip);

/// Removes all pairs with skipped elements. If skipped elements form a cluster, a chain of new pairs connects
/// the neighbours of the cluster. Returns pairs i < j, sorted and unique.
std::vector<mesh::Edge> without_skipped(std::vector<mesh::Edge> pairs, std::span<const std::uint8_t> skip);

struct GraphParts {
  std::vector<std::uint32_t> centers;
  std::vector<std::uint32_t> of;  ///< per element, an index into centers; centers.size() if skipped
};
/// Returns the connected parts of a graph without skipped elements, sorted by their lowest element index. The
/// centre of a part is the element whose path to its farthest element has the fewest edges. If there are
/// several, takes the one with the lowest index. For more than 4,096 elements, takes the middle of a long
/// path, because this needs only linear time.
GraphParts graph_parts(std::size_t elements, std::span<const mesh::Edge> edges,
                       std::span<const std::uint8_t> skip);

/// Throws base::Error if `vertices` is not the cage's vertex count. `place` names the source of the pose.
void check_pose(const Cage& cage, std::size_t vertices, const std::string& place = "");

}  // namespace viete::pose
