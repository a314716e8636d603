// A coarse copy of a large model, for solves that would take too long with all vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "deform/cage.h"
#include "mesh/adjacency.h"
#include "mesh/drawing.h"

namespace viete::deform {

/// About proxy_vertices clusters of neighbouring vertices, see SurfaceProxy. Thread-safe.
class CoarseModel {
public:
  /// Throws base::Error if the model has no triangles. Throws base::Cancelled.
  CoarseModel(const mesh::Surface& model, const Cage& cage, base::WorkerPool& pool,
              base::Progress* progress = nullptr);

  /// Clusters at the means of their vertices. Draft::vertices has the vertex nearest to each cluster.
  const mesh::Draft& draft() const { return draft_; }
  /// Returns for each cluster the mean of value(vertex).
  template <class Value>
  auto means(base::WorkerPool& pool, const Value& value) const {
    std::vector<decltype(value(0u))> means(draft_.surface.positions.size());
    pool.for_blocks(means.size(), 64, [&](std::size_t begin, std::size_t end) {
      for (std::size_t c = begin; c < end; ++c) {
        for (const auto v : members_.of(c)) means[c] = means[c] + value(v);
        means[c] = (1.0 / static_cast<double>(members_.of(c).size())) * means[c];
      }
    });
    return means;
  }
  /// Interpolates displacements of clusters at a vertex of the model.
  Vec3 move(std::uint32_t vertex, std::span<const Vec3> moves) const;

private:
  struct Term {
    std::uint32_t cluster;
    float factor;
  };
  struct Block {
    std::vector<std::size_t> starts;  // start of the terms of each vertex, and the end
    std::vector<Term> terms;
  };

  mesh::Draft draft_;
  mesh::Adjacency members_;
  std::vector<Block> blocks_;
};

}  // namespace viete::deform
