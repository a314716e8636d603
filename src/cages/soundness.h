// Exact checks of a cage: closed, without self-intersections, around the model; and its closeness.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/working_cage.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"

namespace viete::cages {

struct Closeness {
  double least = 0, mean = 0, most = 0;  ///< distances of model vertices to the cage, in model diagonals
  double volume = 0;                     ///< cage volume / model volume; 0 for an open or flat model
};

/// Measures used vertices, or all points of a point set. Neither may be empty. Same bits for any pool.
Closeness closeness(const mesh::Surface& cage, const mesh::Surface& model, base::WorkerPool& pool);

/// Defects of a cage; all empty or 0 if it is sound.
struct Soundness {
  std::size_t open_edges = 0;           ///< one triangle, three or more, or two of opposite orientation
  std::size_t pinched_vertices = 0;     ///< vertices with several triangle fans
  std::vector<std::uint32_t> crossing;  ///< cage triangles that cross other cage triangles
  std::vector<std::uint32_t> cutting;   ///< cage triangles that cross the model
  std::vector<std::uint32_t> outside;   ///< one vertex of each model component outside

  bool sound() const {
    return open_edges == 0 && pinched_vertices == 0 && crossing.empty() && cutting.empty() && outside.empty();
  }
};

/// The tree must contain the model's triangles. Each component of the model is tested by one vertex. Exact,
/// except for vertices within 1e-9 of the cage's diagonal from it. progress may be null; throws
/// base::Cancelled.
Soundness soundness(const mesh::Surface& cage, std::span<const mesh::Point> positions,
                    std::span<const mesh::Triangle> triangles, const mesh::TriangleTree& tree,
                    base::WorkerPool& pool, base::Progress* progress = nullptr);

/// Checks any cage and model in their own coordinates.
Soundness soundness(const mesh::Surface& cage, const mesh::Surface& model, base::WorkerPool& pool);

/// Moves vertices of triangles that are nearer to the model than the margin outward until all keep it, or as
/// far as the cage stays sound. Exact, unlike the interpolated clearance. Returns the number left. progress
/// may be null; throws base::Cancelled.
std::size_t keep_margin(WorkingCage& cage, double margin, base::Progress* progress);

}  // namespace viete::cages
