// Whether a cage is one: closed, without cuts through itself, and around all of its model. Exact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"

namespace viete::cages {

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

}  // namespace viete::cages
