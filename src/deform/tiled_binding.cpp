#include "deform/tiled_binding.h"

#include <atomic>
#include <cmath>

#include "deform/face_maps.h"
#include "deform/frame_kernel.h"
#include "deform/mean_value.h"
#include "deform/vec3.h"
#include "deform/weights.h"

namespace viete::deform {

namespace {

constexpr std::size_t lanes = tile_lanes<float>;

std::vector<std::uint32_t> triangle_counts(const mesh::Surface& model) {
  std::vector<std::uint32_t> counts(model.positions.size());
  for (const auto& t : model.triangles) {
    for (const auto v : t) ++counts[v];
  }
  return counts;
}

void bind_leaf(const mesh::Surface& model, const Cage& cage, std::size_t leaf, TiledBinding& b) {
  const auto& handles = b.coordinates == Coordinates::mean_value ? cage.surface.positions : cage.centers;
  const Vec3 origin = pose_origin(cage.surface.positions);
  std::vector<double> row(b.handles);
  for (std::size_t s = b.leaves.begin(leaf); s < b.leaves.end(leaf); ++s) {
    const mesh::Point& x = model.positions[b.leaves.order[s]];
    if (b.coordinates == Coordinates::mean_value) {
      mean_value_weights(cage, x, row);
    } else {
      inverse_distance_weights(cage, x, row);
    }
    float* weights = b.weights.data() + s / lanes * lanes * b.handles + s % lanes;
    Vec3 sum{0, 0, 0};
    for (std::size_t j = 0; j < b.handles; ++j) {
      weights[j * lanes] = static_cast<float>(row[j]);
      sum = sum + weights[j * lanes] * (handles[j] - origin);
    }
    const Vec3 offset = (x - origin) - sum;
    float* offsets = b.offsets.data() + s / lanes * lanes * 3 + s % lanes;
    for (int i = 0; i < 3; ++i) offsets[i * lanes] = static_cast<float>(offset[i] / b.unit);
  }
}

}  // namespace

std::size_t TiledBinding::bytes() const {
  return sizeof(float) * (weights.size() + offsets.size());
}

TiledBinding bind_tiles(const mesh::Surface& model, const Cage& cage, Coordinates coordinates,
                        base::WorkerPool& pool, base::Progress* progress) {
  TiledBinding b;
  b.coordinates = coordinates;
  b.handles = coordinates == Coordinates::face ? cage.element_count() : cage.surface.positions.size();
  b.leaves = make_leaves(model.positions, triangle_counts(model));
  b.rings = make_rings(b.leaves, model.triangles);
  b.unit = std::exp2(std::round(std::log2(cage.diagonal)));
  b.weights.resize(b.leaves.slot_count() * b.handles);
  b.offsets.resize(b.leaves.slot_count() * 3);
  std::atomic<std::size_t> done{0};
  pool.for_blocks(b.leaves.count(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) bind_leaf(model, cage, leaf, b);
    done += end - begin;
    if (progress) progress->report(static_cast<double>(done) / static_cast<double>(b.leaves.count()));
  });
  return b;
}

}  // namespace viete::deform
