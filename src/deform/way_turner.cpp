#include "deform/way_turner.h"

#include "deform/staged_engine.h"

namespace viete::deform {

namespace {

// Applies a sum of map rows.
Vec3 turned_by_row(const double* m, const Vec3& way) {
  const auto row = [&](std::size_t i) {
    return m[3 * i] * way[0] + m[3 * i + 1] * way[1] + m[3 * i + 2] * way[2];
  };
  return way + Vec3{row(0), row(1), row(2)};
}

}  // namespace

std::span<const Vec3> WayTurner::turned(const Binding& binding, const Mask& mask, std::span<const Vec3> ways,
                                        base::WorkerPool& pool) {
  if (!binding.tiles) {
    turned_ = turned(binding, product(binding.shares, mask), ways);
    return turned_;
  }
  if (!blender_) blender_ = std::make_unique<FusedEngine>(binding.tiles, state_.rows().form, pool);
  if (mask_ != mask) blender_->set_mask(mask);
  mask_ = mask;
  const std::size_t columns = state_.rows().columns();
  sums_.resize(ways.size() * columns);
  turned_.resize(ways.size());
  blender_->blend(state_, sums_);
  for (std::size_t v = 0; v < ways.size(); ++v)
    turned_[v] = turned_by_row(sums_.data() + v * columns, ways[v]);
  return turned_;
}

std::vector<Vec3> WayTurner::turned(const Binding& binding, const Shares& shares,
                                    std::span<const Vec3> ways) const {
  const Rows rows = state_.rows();
  std::vector<double> sums(ways.size() * rows.columns());
  deform::blend(binding, rows, 0, ways.size(), sums);
  share_sums(binding, shares, rows.form, 0, ways.size(), sums);
  std::vector<Vec3> all;
  for (std::size_t v = 0; v < ways.size(); ++v)
    all.push_back(turned_by_row(sums.data() + v * rows.columns(), ways[v]));
  return all;
}

}  // namespace viete::deform
