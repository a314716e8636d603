#include "deform/fused_frame.h"

#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "deform/vec3.h"

namespace viete::deform {

FusedFrame::FusedFrame(std::shared_ptr<const Cage> cage, std::shared_ptr<const TiledBinding> binding,
                       base::WorkerPool& pool, const sym3::Kernel& kernel)
    : kernel_(frame_kernel(kernel)),
      cage_(std::move(cage)),
      binding_(std::move(binding)),
      pool_(pool) {
  if (binding_->coordinates == Coordinates::face) {
    maps_.resize(binding_->handles);
    logs_.resize(binding_->handles);
  }
  table_.resize(binding_->handles * log_size);
  positions_.resize(binding_->rings.place_count() * 4);
  vertices_.resize(binding_->leaves.vertices);
}

void FusedFrame::deform(const Pose& pose) {
  check_pose(*cage_, pose);
  times_ = {};
  origin_ = pose_origin(pose.positions);
  base::Stopwatch watch;
  if (binding_->coordinates == Coordinates::face) {
    face_maps(*cage_, pose.positions, maps_);
    times_[Link::face_maps] = watch.lap_ms();
    log_maps(*cage_, maps_, pose.turns, logs_, report_);
    times_[Link::log_maps] = watch.lap_ms();
    fill_table();
  } else {
    report_ = {pose.turns, {}, {}};
    for (std::size_t j = 0; j < binding_->handles; ++j) {
      for (int i = 0; i < 3; ++i) {
        table_[3 * j + i] = static_cast<float>((pose.positions[j][i] - origin_[i]) / binding_->unit);
      }
    }
  }
  place_vertices();
  times_[Link::fused] = watch.lap_ms();
  compute_normals();
  times_[Link::normals] = watch.lap_ms();
}

void FusedFrame::fill_table() {
  for (std::size_t j = 0; j < logs_.size(); ++j) {
    const auto& [x, y, c] = logs_[j];
    const double entry[log_size] = {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz, y[0], y[1], y[2],
                                    c[0] / binding_->unit, c[1] / binding_->unit, c[2] / binding_->unit};
    for (std::size_t i = 0; i < log_size; ++i) table_[log_size * j + i] = static_cast<float>(entry[i]);
  }
}

void FusedFrame::place_vertices() {
  const TiledBinding& b = *binding_;
  for_leaves([&](std::size_t leaf) {
    const std::size_t begin = b.leaves.begin(leaf), slots = b.leaves.end(leaf) - begin;
    const TileRun<float> run{slots / tile_lanes<float>, b.handles, b.weights.data() + begin * b.handles,
                             table_.data(), nullptr};
    const float* offsets = b.offsets.data() + begin * 3;
    float* out = positions_.data() + 4 * std::size_t(b.rings.places[leaf]);
    const auto& tiles = kernel_.in_float;
    b.coordinates == Coordinates::face ? tiles.deform(run, offsets, out) : tiles.move(run, offsets, out);
  });
}

void FusedFrame::compute_normals() {
  const TiledBinding& b = *binding_;
  const Rings& r = b.rings;
  for_leaves([&](std::size_t leaf) {
    const std::size_t begin = b.leaves.begin(leaf), slots = b.leaves.end(leaf) - begin;
    const std::size_t first = r.places[leaf];
    kernel_.ring_vertices({positions_.data(), first, slots, r.places[leaf + 1] - first,
                   std::min(slots, b.leaves.vertices - begin), r.halo.data() + (first - begin),
                   b.leaves.order.data() + begin, r.walk.data() + r.walk_starts[leaf], r.lengths.data() + begin,
                   static_cast<float>(b.unit)},
                  vertices_.data());
  });
  for (const auto& hub : r.hubs) {
    kernel_.ring_hub(positions_.data(), hub.walk.data(), hub.walk.size(), hub.place,
             vertices_[b.leaves.order[hub.slot]]);
  }
}

template <class Body>
void FusedFrame::for_leaves(const Body& body) {
  pool_.for_blocks(binding_->leaves.count(), 1, [&](std::size_t begin, std::size_t end) {
    for (std::size_t leaf = begin; leaf < end; ++leaf) body(leaf);
  });
}

}  // namespace viete::deform
