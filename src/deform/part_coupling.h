// Couplings between near parts of a model that no edge joins.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/laplacian.h"
#include "mesh/edge_paths.h"
#include "mesh/surface.h"

namespace viete::deform {

/// A vertex and a point of a triangle, by barycentric coordinates. Adds strength times their squared
/// difference to w^T L w.
struct Coupling {
  std::uint32_t vertex;
  mesh::Triangle triangle;
  Vec3 shares;
  double strength;
};

inline constexpr double most_strength = 1e4;

/// Couples each vertex to the nearest point of every other part within 1.5 % of the model's diagonal, at most
/// six parts, and none more than four times as far away as the nearest one. Folds that touch: also to the
/// nearest vertex of its own part within 0.1 %, unless a path of edges shorter than 1 % joins the two. The
/// strength is the energy of a filled gap: a column between vertex and point, with the smaller share m of the
/// area of the two, and their distance d as height, has the Dirichlet energy m / d^2 (the surface's area
/// being 1) if a shell as thick as the gap has that of L; the strength is twice that, at most 1e4. So cracks
/// weld, layers move alike, and wider gaps couple less. The point lies inside a triangle, so that a small
/// part moves with a coarse surface around it without a near vertex; a corner replaces it if that is half as
/// far from it as the vertex, or within 0.3 %.
///
/// The surface must be welded, masses as in IntrinsicLaplacian. The same for any number of threads.
std::vector<Coupling> part_couplings(const mesh::Surface& surface, const mesh::EdgePaths& paths,
                                     std::span<const double> masses, base::WorkerPool& pool);

/// Splits each coupling into one for every corner with a share. Adding the result to a matrix creates no
/// positive off-diagonal entries, but functions that are linear on the triangle no longer have zero energy.
std::vector<Coupling> by_corners(std::span<const Coupling> couplings);

SparseMatrix with_couplings(const SparseMatrix& stiffness, std::span<const Coupling> couplings);

/// The bodies of a model, numbered from 0: its parts, where parts below the `small` share of the area merge
/// with parts that they touch (within 0.1 % of the diagonal), so that a triangle soup is one body.
struct Bodies {
  std::vector<std::uint32_t> of_vertex;
  std::vector<double> shares;  ///< shares of the area
};
Bodies bodies(const mesh::Surface& surface, const mesh::EdgePaths& paths, std::span<const Coupling> couplings,
              std::span<const double> masses, double small);

}  // namespace viete::deform
