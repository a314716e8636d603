#include "deform/stitched_engine.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "deform/apply.h"

namespace viete::deform {

namespace {

Vec3 vector_of_slot(const base::AlignedVector<float>& array, std::size_t slot, double unit) {
  const float* at = array.data() + slot / lanes * lanes * 3 + slot % lanes;
  return unit * Vec3{at[0], at[lanes], at[2 * lanes]};
}

Binding held_vertices(const Stitching& stitching, const TiledBinding& tiles) {
  std::vector<std::uint32_t> slot_of(tiles.leaves.vertices);
  for (std::uint32_t slot = 0; slot < tiles.leaves.vertices; ++slot) slot_of[tiles.leaves.order[slot]] = slot;
  Binding held;
  held.vertices = stitching.holds.size();
  for (const auto& hold : stitching.holds) {
    held.rest.push_back(vector_of_slot(tiles.rest, slot_of[hold.vertex], tiles.unit));
    held.offsets.push_back(vector_of_slot(tiles.offsets, slot_of[hold.vertex], tiles.unit));
  }
  return held;
}

}  // namespace

StitchedEngine::StitchedEngine(std::shared_ptr<const TiledBinding> binding,
                               std::shared_ptr<const Stitching> stitching, RowForm form, int iterations,
                               base::WorkerPool& pool)
    : binding_(std::move(binding)),
      stitching_(std::move(stitching)),
      form_(form),
      iterations_(iterations),
      blender_(binding_, form, pool),
      stitcher_(*stitching_, form, pool),
      held_(held_vertices(*stitching_, *binding_)),
      sums_(stitching_->vertices() * shape(form).columns),
      held_sums_(held_.vertices * shape(form).columns),
      held_positions_(held_.vertices) {
  set_mask(nullptr);
}

void StitchedEngine::set_mask(const Mask& mask) {
  blender_.set_mask(mask);
  const Shares shares = product(shares_of(*binding_), mask);
  stitcher_.set_shares(shares);
  held_.shares.clear();
  for (std::size_t i = 0; i < (shares.empty() ? 0 : held_.vertices); ++i)
    held_.shares.push_back(shares[stitching_->holds[i].vertex]);
}

void StitchedEngine::run(const CageState& state, sym3::Method method) {
  blender_.blend(state, sums_);
  base::Stopwatch watch;
  place_held(sums_, method);
  const double held_ms = watch.lap_ms();
  stitcher_.run(state.rows(), sums_, held_positions_, method, iterations_);
  blender_.set_layer(layer_);
  blender_.show(stitcher_.positions());
  times_ = blender_.times();
  times_[Link::blend] += held_ms;
  times_[Link::triangle_maps] = stitcher_.loads_ms();
  times_[Link::solve] = stitcher_.solve_ms();
}

void StitchedEngine::place_held(std::span<const double> sums, sym3::Method method) {
  const std::size_t columns = shape(form_).columns;
  for (std::size_t i = 0; i < held_.vertices; ++i) {
    const auto from = sums.subspan(stitching_->holds[i].vertex * columns, columns);
    std::ranges::copy(from, held_sums_.begin() + std::ptrdiff_t(i * columns));
  }
  place_sums(held_, form_, held_sums_, {0, 0, 0}, method, held_positions_);
}

}  // namespace viete::deform
