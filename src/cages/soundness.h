// Exact checks of a cage: closed, free of self-intersections, around the whole model, and how close it is.
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
  double least = 0, mean = 0, most = 0;  ///< distances of the model's vertices to the cage, of its diagonal
  double volume = 0;  ///< of the cage, by that of the model; 0 where the model is not closed and has none
};

/// Of the vertices that triangles use, or of all points. Both are not empty. Same bits for any pool.
Closeness closeness(const mesh::Surface& cage, const mesh::Surface& model, base::WorkerPool& pool);

/// What is wrong with a cage; all empty or 0 if it is sound.
struct Soundness {
  std::size_t open_edges = 0;           ///< with one triangle, three or more, or two of opposite orientation
  std::size_t pinched_vertices = 0;     ///< where fans of triangles touch
  std::vector<std::uint32_t> crossing;  ///< triangles of the cage that others of it cross
  std::vector<std::uint32_t> cutting;   ///< triangles of the cage that the model crosses
  std::vector<std::uint32_t> outside;   ///< a vertex of each part of the model that lies outside

  bool sound() const {
    return open_edges == 0 && pinched_vertices == 0 && crossing.empty() && cutting.empty() && outside.empty();
  }
};

/// The tree is of the model's triangles; parts of it that hang together by triangles are told by one vertex
/// each. Exact but for vertices within 1e-9 of the cage's diagonal from it. progress may be null; throws
/// base::Cancelled.
Soundness soundness(const mesh::Surface& cage, std::span<const mesh::Point> positions,
                    std::span<const mesh::Triangle> triangles, const mesh::TriangleTree& tree,
                    base::WorkerPool& pool, base::Progress* progress = nullptr);

/// The same of any cage and model, in their own coordinates.
Soundness soundness(const mesh::Surface& cage, const mesh::Surface& model, base::WorkerPool& pool);

/// Moves vertices of triangles that are nearer to the model than the margin outward, until none is, or as far
/// as the cage stays sound: the clearance is interpolated, this is exact. Returns how many are left. progress
/// may be null; throws base::Cancelled.
std::size_t keep_margin(WorkingCage& cage, double margin, base::Progress* progress);

}  // namespace viete::cages
