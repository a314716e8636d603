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

std::vector<std::size_t> held_vertices(const Stitching& stitching) {
  std::vector<std::size_t> held;
  for (const auto& hold : stitching.holds) held.push_back(hold.vertex);
  return held;
}

// What apply() needs of these, but for shares. ways: of all vertices.
Binding some_vertices(const TiledBinding& tiles, std::span<const std::uint32_t> slots,
                      std::span<const std::size_t> vertices, std::span<const Vec3> ways = {}) {
  Binding some;
  std::vector<Vec3> own;
  some.vertices = vertices.size();
  for (const auto v : vertices) {
    some.rest.push_back(vector_of_slot(tiles.rest, slots[v], tiles.unit));
    some.offsets.push_back(vector_of_slot(tiles.offsets, slots[v], tiles.unit));
    if (!ways.empty()) own.push_back(ways[v]);
  }
  shape_by(some, own);
  return some;
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
      slots_(slots_of(binding_->leaves)),
      held_(some_vertices(*binding_, slots_, held_vertices(*stitching_))),
      sums_(stitching_->vertices() * shape(form).columns),
      held_sums_(held_.vertices * shape(form).columns),
      held_positions_(held_.vertices) {
  set_mask(nullptr);
}

void StitchedEngine::set_mask(const Mask& mask) {
  blender_.set_mask(mask);
  shares_ = product(shares_of(*binding_), mask);
  stitcher_.set_shares(shares_);
  held_.shares.clear();
  for (std::size_t i = 0; i < (shares_.empty() ? 0 : held_.vertices); ++i)
    held_.shares.push_back(shares_[stitching_->holds[i].vertex]);
}

void StitchedEngine::set_shape(std::span<const Vec3> ways) {
  ways_ = ways;
  blender_.set_shape(ways);
  stitcher_.set_shape(ways);
  Shares shares = std::move(held_.shares);
  held_ = some_vertices(*binding_, slots_, held_vertices(*stitching_), ways);
  held_.shares = std::move(shares);
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

std::vector<Vec3> StitchedEngine::blended(std::span<const std::size_t> vertices) const {
  const std::size_t columns = shape(form_).columns;
  Binding some = some_vertices(*binding_, slots_, vertices, ways_);
  std::vector<double> sums;
  for (const auto v : vertices) {
    const auto from = std::span(sums_).subspan(v * columns, columns);
    sums.insert(sums.end(), from.begin(), from.end());
    if (!shares_.empty()) some.shares.push_back(shares_[v]);
  }
  std::vector<Vec3> positions(vertices.size());
  place_sums(some, form_, sums, {0, 0, 0}, sym3::Method::fast, positions);
  return positions;
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
