// What holds parts of a model together that lie near each other and that no edge joins.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "deform/laplacian.h"
#include "mesh/edge_paths.h"
#include "mesh/surface.h"

namespace viete::deform {

/// A vertex and a point of a triangle, by the shares of its corners, which sum to 1. The square of the
/// difference between the two, times the strength, is added to w^T L w.
struct Coupling {
  std::uint32_t vertex;
  mesh::Triangle triangle;
  Vec3 shares;
  double strength;
};

inline constexpr double most_strength = 1e4;

/// Couples each vertex to the nearest point of every other part within 1.5 % of the model's diagonal, but not
/// to those that are more than four times as far away as the nearest one, and to six at most. Folds that
/// touch: also to the nearest vertex of its own part within 0.1 %, if no path of edges shorter than 1 % joins
/// the two. The gap counts as if it were filled: a column between vertex and point, of the share m that
/// the vertex or the point has of the area, whichever is smaller, and as high as their distance d, has the
/// Dirichlet energy m / d^2 (the surface's area being 1) if a shell as thick as the gap has that of L; twice
/// that, and 1e4 at most. So cracks weld, layers move
/// alike, and a wider gap couples less. The point lies between vertices, so that a small part moves with a
/// coarse surface around it although no vertex of this is near; a corner stands for it that is half as
/// far from it as the vertex, or within 0.3 %.
///
/// The surface welded, masses as in IntrinsicLaplacian. The same for any number of threads.
std::vector<Coupling> part_couplings(const mesh::Surface& surface, const mesh::EdgePaths& paths,
                                     std::span<const double> masses, base::WorkerPool& pool);

/// Each coupling as one to every corner that has a share. Added to a matrix without positive entries off its
/// diagonal they leave none, but functions that are linear on the triangle are no longer free of energy.
std::vector<Coupling> by_corners(std::span<const Coupling> couplings);

SparseMatrix with_couplings(const SparseMatrix& stiffness, std::span<const Coupling> couplings);

/// The bodies of a model, numbered from 0: its parts, those of less than the `small` share of the area being
/// one with what they touch (within 0.1 % of the diagonal), so that a soup of triangles is one body.
struct Bodies {
  std::vector<std::uint32_t> of_vertex;
  std::vector<double> shares;  ///< in the area
};
Bodies bodies(const mesh::Surface& surface, const mesh::EdgePaths& paths, std::span<const Coupling> couplings,
              std::span<const double> masses, double small);

}  // namespace viete::deform
