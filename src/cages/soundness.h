// Checks that a cage is sound, and enforces its margin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/working_cage.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"

namespace viete::cages {

struct Soundness {
  std::size_t open_edges = 0;           ///< edges that do not have two triangles of equal orientation
  std::size_t pinched_vertices = 0;     ///< vertices at which triangles meet without a shared edge
  std::vector<std::uint32_t> crossing;  ///< split triangles that intersect others
  std::vector<std::uint32_t> cutting;   ///< split triangles that intersect the model
  std::vector<std::uint32_t> outside;   ///< one vertex per component of the model that is outside the cage

  bool sound() const {
    return open_edges == 0 && pinched_vertices == 0 && crossing.empty() && cutting.empty() && outside.empty();
  }
};

/// Checks a cage, split as in mesh::CenterSplit. `positions`, `triangles` and their `tree` belong to the
/// model. Exact, but a model vertex may be outside by 1e-9 of the cage's diagonal. `progress` may be null.
/// Throws base::Cancelled.
Soundness soundness(const mesh::Surface& cage, std::span<const mesh::Point> positions,
                    std::span<const mesh::Triangle> triangles, const mesh::TriangleTree& tree,
                    base::WorkerPool& pool, base::Progress* progress = nullptr);

/// Checks a cage and a model in file coordinates.
Soundness soundness(const mesh::Surface& cage, const mesh::Surface& model, base::WorkerPool& pool);

/// Moves triangles outward if their distance to the model is less than the margin. The cage stays sound.
/// Returns the number of triangles that are still too near. `progress` may be null. Throws base::Cancelled.
std::size_t keep_margin(WorkingCage& cage, double margin, base::Progress* progress);

}  // namespace viete::cages
