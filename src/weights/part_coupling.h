// Couplings between parts of a model that are near each other but not joined by edges.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/edge_paths.h"
#include "mesh/surface.h"
#include "weights/laplacian.h"

namespace viete::weights {

/// Couples a vertex to a point: adds strength * (w(vertex) - w(point))^2 to the energy of weights w.
struct Coupling {
  std::uint32_t vertex;
  mesh::Triangle triangle;  ///< contains the point
  Vec3 shares;              ///< the point's barycentric coordinates
  double strength;
};

inline constexpr double most_strength = 1e4;

/// Couples each vertex to points that are near in space but not along edges:
/// - in other parts: the nearest point of each part within 2 % of the model's diagonal. Takes at most six
///   points, and no point more than four times as far away as the nearest point.
/// - in the vertex's own part, where folds touch: the nearest vertex within 0.1 %, unless a path of edges
///   shorter than 1 % joins the two vertices.
/// A corner of the triangle replaces a point if the corner is within 0.3 %, or within half of the distance d
/// from the vertex to the point.
///
/// The strength is 0.6 * m / d^2, within a part 2 * m / d^2, and at most 1e4. m is the smaller of the areas
/// that belong to the vertex and to the point. The surface's area is 1. m / d^2 is the Dirichlet energy of a
/// column with base m and height d, which fills the gap. So the couplings are strong across narrow gaps and
/// weak across wide gaps. The surface must be welded; `masses` as in IntrinsicLaplacian. Results do not
/// depend on the thread count.
std::vector<Coupling> part_couplings(const mesh::Surface& surface, const mesh::EdgePaths& paths,
                                     std::span<const double> masses, base::WorkerPool& pool);

/// A surface whose vertices belong to one part each: edges connect the triangles of a part. Parts that share
/// single vertices, such as an eye that touches its socket, have copies of these vertices, at the end.
struct PartedSurface {
  mesh::Surface surface;
  std::vector<double> masses;          ///< one per vertex
  std::vector<std::uint32_t> origins;  ///< for each copy, the vertex of the original surface

  /// Returns couplings of this surface as couplings of the original surface.
  std::vector<Coupling> joined(std::vector<Coupling> couplings) const;
};
PartedSurface parted_surface(const mesh::Surface& surface, std::vector<double> masses);

/// Splits each coupling into couplings to the corners with a positive share. Such couplings add no positive
/// off-diagonal entries to a matrix. But they resist linear functions on the triangle, unlike the original.
std::vector<Coupling> by_corners(std::span<const Coupling> couplings);

/// Returns the couplings of any surface.
std::vector<Coupling> surface_couplings(const mesh::Surface& surface, base::WorkerPool& pool);
/// Returns the couplings of any surface, by_corners().
std::vector<Coupling> vertex_couplings(const mesh::Surface& surface, base::WorkerPool& pool);

sparse::SparseMatrix with_couplings(const sparse::SparseMatrix& stiffness,
                                    std::span<const Coupling> couplings);

/// The bodies of a model, numbered from 0. Each part is a body, but a part with less than `small` of the area
/// merges with all parts that touch it (within 0.1 % of the diagonal). A triangle soup is then one body.
struct Bodies {
  std::vector<std::uint32_t> of_vertex;  ///< the number of each vertex's body
  std::vector<double> shares;            ///< each body's share of the area
};
Bodies bodies(const mesh::Surface& surface, const mesh::EdgePaths& paths, std::span<const Coupling> couplings,
              std::span<const double> masses, double small);

}  // namespace viete::weights
