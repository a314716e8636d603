#include "deform/coarse_model.h"

#include <algorithm>

#include "deform/surface_proxy.h"

namespace viete::deform {

namespace {

constexpr std::size_t vertices_per_block = 512;

}  // namespace

CoarseModel::CoarseModel(const mesh::Surface& model, const Cage& cage, base::WorkerPool& pool,
                         base::Progress* progress)
    : blocks_((model.positions.size() + vertices_per_block - 1) / vertices_per_block) {
  const SurfaceProxy proxy(model, cage, Elements::face, proxy_vertices, pool, progress, true);
  draft_.surface = proxy.surface();
  members_ = mesh::make_adjacency(draft_.surface.positions.size(), [&](const auto& add) {
    for (std::uint32_t v = 0; v < proxy.of_vertex().size(); ++v) add(proxy.of_vertex()[v], v);
  });
  draft_.surface.positions = means(pool, [&](std::uint32_t v) { return model.positions[v]; });
  for (std::size_t c = 0; c < draft_.surface.positions.size(); ++c) {
    draft_.vertices.push_back(*std::ranges::min_element(members_.of(c), {}, [&](std::uint32_t v) {
      return squared_norm(model.positions[v] - draft_.surface.positions[c]);
    }));
  }
  pool.for_blocks(model.positions.size(), vertices_per_block, [&](std::size_t begin, std::size_t end) {
    Block& block = blocks_[begin / vertices_per_block];
    std::vector<SurfaceProxy::Term> terms;
    for (auto v = static_cast<std::uint32_t>(begin); v < end; ++v) {
      proxy.terms(v, terms);
      block.starts.push_back(block.terms.size());
      for (const auto& [cluster, factor] : terms)
        block.terms.push_back({cluster, static_cast<float>(factor)});
    }
    block.starts.push_back(block.terms.size());
    block.terms.shrink_to_fit();
  });
}

Vec3 CoarseModel::move(std::uint32_t vertex, std::span<const Vec3> moves) const {
  const Block& block = blocks_[vertex / vertices_per_block];
  const std::size_t i = vertex % vertices_per_block;
  Vec3 sum{0, 0, 0};
  for (std::size_t t = block.starts[i]; t < block.starts[i + 1]; ++t)
    sum = sum + static_cast<double>(block.terms[t].factor) * moves[block.terms[t].cluster];
  return sum;
}

}  // namespace viete::deform
