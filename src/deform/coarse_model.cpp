#include "deform/coarse_model.h"

#include <algorithm>

#include "base/memory.h"
#include "deform/surface_proxy.h"
#include "mesh/triangle.h"

namespace viete::deform {

static constexpr std::size_t vertices_per_block = 512, clusters_per_block = 64;

bool needs_coarse_model(const mesh::Surface& model) {
  return model.positions.size() > most_solved_vertices &&
         std::ranges::any_of(model.triangles,
                             [&](const auto& t) { return mesh::area(model.positions, t) > 0; });
}

CoarseModel::CoarseModel(const mesh::Surface& model, const Cage& cage, base::WorkerPool& pool,
                         base::Progress* progress)
    : blocks_((model.positions.size() + vertices_per_block - 1) / vertices_per_block) {
  base::require_memory({200.0 * static_cast<double>(model.positions.size()),
                        "a coarse copy of " + std::to_string(model.positions.size()) + " vertices takes",
                        "use a coarser model, or turn stitching off", ""});
  const SurfaceProxy proxy(model, cage, Elements::face, proxy_vertices, pool, progress, true);
  surface_ = proxy.surface(), members_ = proxy.members();
  pool.for_blocks(model.positions.size(), vertices_per_block, [&](std::size_t begin, std::size_t end) {
    Block& block = blocks_[begin / vertices_per_block];
    std::vector<SurfaceProxy::Term> terms;
    for (std::size_t v = begin; v < end; ++v) {
      terms.clear();
      if (const auto i = static_cast<std::uint32_t>(v); proxy.has_cluster(i)) proxy.terms(i, terms);
      block.starts.push_back(block.terms.size());
      for (const auto& [cluster, factor] : terms)
        block.terms.push_back({cluster, static_cast<float>(factor)});
    }
    block.starts.push_back(block.terms.size());
    block.terms.shrink_to_fit();
  });
}

std::vector<Vec3> CoarseModel::means(std::span<const Vec3> of_vertices, base::WorkerPool& pool) const {
  std::vector<Vec3> means(of_vertices.empty() ? 0 : surface_.positions.size(), Vec3{0, 0, 0});
  pool.for_blocks(means.size(), clusters_per_block, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      for (const auto v : members_.of(c)) means[c] = means[c] + of_vertices[v];
      means[c] = (1 / static_cast<double>(members_.of(c).size())) * means[c];
    }
  });
  return means;
}

Mask CoarseModel::means(const Mask& mask) const {
  if (!mask) return nullptr;
  std::vector<float> means;
  for (std::size_t c = 0; c < surface_.positions.size(); ++c) {
    float sum = 0;
    for (const auto v : members_.of(c)) sum += (*mask)[v];
    means.push_back(sum / static_cast<float>(members_.of(c).size()));
  }
  return std::make_shared<const std::vector<float>>(std::move(means));
}

void CoarseModel::move(std::span<const Vec3> moves, std::span<Vec3> positions, base::WorkerPool& pool) const {
  pool.for_blocks(positions.size(), vertices_per_block, [&](std::size_t begin, std::size_t end) {
    const Block& block = blocks_[begin / vertices_per_block];
    for (std::size_t v = begin; v < end; ++v) {
      for (std::size_t t = block.starts[v - begin]; t < block.starts[v - begin + 1]; ++t)
        positions[v] =
            positions[v] + static_cast<double>(block.terms[t].factor) * moves[block.terms[t].cluster];
    }
  });
}

}  // namespace viete::deform
