#include "deform/fused_engine.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

#include "base/clock.h"
#include "deform/moments.h"
#include "pose/maps.h"

namespace viete::deform {

namespace {

using weights::TileLines;

constexpr std::size_t few = 4;               // a drag uses cached sums if at most 1 / few of the handles move
constexpr std::size_t skeleton_block = 256;  // slots per task

void to_rows(TileLines<const float> sums, std::size_t slots, float* table) {
  for (std::size_t s = 0; s < slots; ++s)
    for (std::size_t c = 0; c < sums.lines; ++c) table[s * sums.lines + c] = sums.at(s, c);
}

// Fills a table of moment rows. A handle has the weight v and the rest centre p. `near` is the point in the
// slot's first three rest moments. With this table, the blend kernel computes
//     sums 0 to 2: sum v * (p - near),    sum 3: sum v.
void write_offset_rows(std::span<float> table) {
  for (std::size_t j = 0; j < table.size(); j += pose::moment_shape.columns) {
    std::fill_n(table.begin() + std::ptrdiff_t(j + 3), 12, 0.0f);
    table[j + 6] = table[j + 12] = 1;
  }
}

// Fills a table of moment rows. With v, p and `near` as in write_offset_rows(), the blend kernel computes
//     sums 0 to 8: sum v * ((p - middle) * (p - near)^T + I), by rows.
void write_rest_rows(const Vec3& middle, std::span<const double> rows, std::span<float> table) {
  for (std::size_t j = 0; j < table.size(); j += pose::moment_shape.columns) {
    for (std::size_t i = 0; i < 9; ++i) table[j + 3 + i] = i % 4 == 0;
    for (std::size_t i = 0; i < 3; ++i) table[j + 12 + i] = static_cast<float>(rows[j + i] - middle[i]);
  }
}

}  // namespace

FusedEngine::FusedEngine(std::shared_ptr<const weights::Binding> binding, pose::RowForm form,
                         base::WorkerPool& pool, const sym3::Kernel& kernel)
    : bound_(std::move(binding)),
      binding_(bound_->tiles),
      pool_(pool),
      kernel_(frame_kernel(kernel)),
      tiles_(kernel_.forms[static_cast<std::size_t>(form)]),
      form_(form),
      columns_(shape(form).columns),
      sums_(tiles_.sums),
      shares_(binding_->shares) {
  assert(!(has_moments(form) && binding_->compressed()));
  entries_.resize(binding_->handles * columns_);
  table_.resize(binding_->handles * columns_);
  skeleton_sums_.resize(binding_->skeleton_slots() * columns_);
  skeleton_table_.resize(binding_->skeleton_slots() * columns_);
  if (has_moments(form)) rest_moments_.resize(binding_->leaves.slot_count() * rest_moment_lines);
  positions_.resize(binding_->rings.position_count() * 4);
  vertices_.assign(binding_->leaves.vertices, pose::FrameVertex{});
  leaf_moved_.assign(binding_->leaves.count(), 1);
}

void FusedEngine::set_mask(const weights::Mask& mask) {
  shares_ = binding_->shares;
  drag_.placed = false;
  if (!mask) return;
  const auto& order = binding_->leaves.order;
  if (shares_.empty()) shares_.assign(order.size(), 1.0f);
  for (std::size_t slot = 0; slot < shares_.size(); ++slot) shares_[slot] *= (*mask)[order[slot]];
}

void FusedEngine::set_shape(std::span<const Vec3> displacements) {
  drag_.placed = knows_rest_ = false;
  displacements_ = displacements;
  rest_.clear();
  offsets_.clear();
  if (displacements.empty()) return;
  offsets_ = binding_->offsets;
  add(offsets_, [&](std::uint32_t v) { return displacements[v]; });
}

// Fills rest_, if the frame needs it.
void FusedEngine::fill_rest() {
  const bool needed = !shares_.empty() || form_ == pose::RowForm::maps || has_moments(form_);
  if (!needed || !rest_.empty()) return;
  const weights::VertexBlock block{.binding = *bound_, .displacements = displacements_};
  rest_.assign(binding_->offsets.size(), 0.0f);
  add(rest_, [&](std::uint32_t v) { return block.rest(v) - bound_->rest_origin; });
}

std::size_t FusedEngine::bytes() const {
  const std::size_t at_rest = sizeof(float) * rest_moments_.size();
  if (!dragging_) return at_rest + binding_->bytes();
  return at_rest + sizeof(float) * (drag_.sums.size() + drag_.weights.size() + binding_->offsets.size());
}

void FusedEngine::run(const pose::CageState& state, sym3::Method) {
  base::Stopwatch watch;
  prepare(state);
  apply_to_vertices();
  times_[pose::Stage::fused] = watch.lap_ms() - times_[pose::Stage::skeleton];
  finish(watch);
}

void FusedEngine::finish(base::Stopwatch& watch) {
  if (layer_) {
    move_by_probes();
    times_[pose::Stage::probes] = watch.lap_ms();
  }
  compute_normals();
  times_[pose::Stage::normals] += watch.lap_ms();
}

void FusedEngine::prepare(const pose::CageState& state) {
  times_ = {};
  base::Stopwatch watch;
  if (!std::ranges::equal(state.moving(), drag_.moving)) drag_ = {};
  origin_ = state.rows().origin;
  fill_rest();
  fill_table(state.rows());
  if (has_moments(form_) && !knows_rest_) fill_rest_moments(state.rows());
  follow_drag(state);
  if (!binding_->compressed() || dragging_) return;
  blend_skeleton(table_.data());
  times_[pose::Stage::skeleton] = watch.lap_ms();
}

void FusedEngine::blend(const pose::CageState& state, std::span<double> sums) {
  base::Stopwatch watch;
  prepare(state);
  const pose::RowShape& rows = shape(form_);
  for_leaves([&](std::size_t leaf) {
    const std::size_t begin = binding_->leaves.begin(leaf), end = binding_->leaves.end(leaf);
    base::AlignedVector<float> leaf_sums((end - begin) * columns_);
    tiles_.blend(frame_run(leaf), leaf_sums.data());
    const TileLines<const float> from{leaf_sums.data(), columns_};
    for (std::size_t slot = begin; slot < std::min(end, binding_->leaves.vertices); ++slot) {
      double* to = sums.data() + binding_->leaves.order[slot] * columns_;
      for (std::size_t c = 0; c < columns_; ++c) {
        const double mean = c < rows.with_mean ? static_cast<double>(mean_[c]) : 0;
        to[c] = (from.at(slot - begin, c) + mean) * (c < rows.first_length ? 1 : binding_->unit);
      }
      if (!shares_.empty()) share(slot, to);
    }
  });
  times_[pose::Stage::blend] = watch.lap_ms() - times_[pose::Stage::skeleton];
}

// Applies the share of a slot to the sums of this slot, see apply_shares().
void FusedEngine::share(std::size_t slot, double* sums) const {
  const double share = shares_[slot];
  const std::size_t center = shape(form_).center;
  const TileLines<const float> rest{rest_.data(), 3};
  for (std::size_t c = 0; c < columns_; ++c) {
    sums[c] *= share;
    if (c >= center) sums[c] += (1 - share) * binding_->unit * static_cast<double>(rest.at(slot, c - center));
  }
}

void FusedEngine::show(std::span<const Vec3> positions) {
  base::Stopwatch watch;
  const double scale = 1 / binding_->unit;
  for_leaves([&](std::size_t leaf) {
    leaf_moved_[leaf] = 1;
    const std::size_t begin = binding_->leaves.begin(leaf);
    float* to = positions_.data() + 4 * std::size_t(binding_->rings.position_starts[leaf]);
    for (std::size_t slot = begin; slot < binding_->leaves.end(leaf); ++slot, to += 4) {
      const Vec3& p = positions[binding_->leaves.order[slot]];
      for (int i = 0; i < 4; ++i) to[i] = static_cast<float>(scale * p[i % 3]);
    }
  });
  drag_.placed = false;
  times_[pose::Stage::normals] = watch.lap_ms();
  finish(watch);
}

void FusedEngine::fill_table(const pose::Rows& rows) {
  const double scale = 1 / binding_->unit;
  const std::size_t first_length = shape(form_).first_length;
  for (std::size_t j = 0; j < entries_.size(); j += columns_)
    for (std::size_t c = 0; c < columns_; ++c)
      entries_[j + c] = c < first_length ? rows.values[j + c] : scale * rows.values[j + c];
  if (drag_.moving.empty()) choose_mean();
  for (std::size_t j = 0; j < entries_.size(); j += columns_)
    for (std::size_t c = 0; c < columns_; ++c)
      table_[j + c] = static_cast<float>(entries_[j + c] - static_cast<double>(mean_[c]));
}

void FusedEngine::fill_rest_moments(const pose::Rows& rows) {
  const weights::TiledBinding& b = *binding_;
  for_leaves([&](std::size_t leaf) { fill_rest_moments(leaf, b.unit / rows.moment_length); });
  knows_rest_ = true;
}

// Computes the rest moments of a leaf, with three runs of the blend kernel: for the weighted mean of the
// handles' centres, for the rounding error of this mean, and for the matrix of rest_moment().
void FusedEngine::fill_rest_moments(std::size_t leaf, double unit) {
  const weights::TiledBinding& b = *binding_;
  const std::size_t begin = b.leaves.begin(leaf), slots = b.leaves.end(leaf) - begin;
  base::AlignedVector<float> own(slots * sums_), table = table_;
  const TileLines<float> moments{rest_moments_.data() + begin * rest_moment_lines, rest_moment_lines};
  const TileLines<const float> sums{own.data(), sums_}, rest{rest_.data() + begin * 3, 3},
      offsets{this->offsets().data() + begin * 3, 3};
  for (std::size_t s = 0; s < slots; ++s) moments.set(s, 0, unit * (rest.three(s, 0) - offsets.three(s, 0)));
  write_offset_rows(table);
  const auto sum = [&] { tiles_.blend(leaf_run(leaf, table.data()), own.data()); };
  sum();
  for (std::size_t s = 0; s < slots; ++s)
    if (sums.at(s, 3) > 0) moments.set(s, 0, moments.three(s, 0) + (1 / sums.at(s, 3)) * sums.three(s, 0));
  sum();
  std::vector<Vec3> off(slots);
  std::vector<double> weight(slots);
  for (std::size_t s = 0; s < slots; ++s) {
    off[s] = sums.three(s, 0);
    weight[s] = sums.at(s, 3);
  }
  const Vec3 middle = moments.three(slots / 2, 0);
  write_rest_rows(middle, entries_, table);
  sum();
  for (std::size_t s = 0; s < slots; ++s) {
    sym3::Mat3<double> m;
    for (std::size_t i = 0; i < 9; ++i) m[i] = sums.at(s, i);
    const Vec3 near = moments.three(s, 0);
    const RestMoment r = rest_moment(m, off[s], weight[s], near - middle, unit * offsets.three(s, 0), unit);
    moments.set(s, 3, off[s]);
    moments.set(s, 6, r.dual);
    moments.at(s, 9) = static_cast<float>(r.scale);
  }
}

// Sets mean_, the mean of the rows. With this mean subtracted from the rows, rotations of the whole cage are
// exact (see RowShape::with_mean). For uncompressed weights, the mean is rounded to a multiple of 0.5. Edits
// rarely change the rounded mean, so vertices that an edit does not influence keep all bits.
void FusedEngine::choose_mean() {
  for (std::size_t c = 0; c < shape(form_).with_mean; ++c) {
    double sum = 0;
    for (std::size_t j = c; j < entries_.size(); j += columns_) sum += entries_[j];
    const double mean = sum / static_cast<double>(std::max<std::size_t>(binding_->handles, 1));
    mean_[c] = static_cast<float>(binding_->compressed() ? mean : 0.5 * std::round(2 * mean));
  }
}

// Decides whether this frame uses cached sums. If so, copies the rows of the moving handles.
void FusedEngine::follow_drag(const pose::CageState& state) {
  const Handles moving = state.moving();
  dragging_ = false;
  if (moving.empty()) return;
  if (drag_.moving.empty()) {
    if (few * moving.size() > binding_->handles || few_factors(moving.size())) return;
    begin_drag(moving);
    drag_.resting = state.resting_revision();
  } else if (drag_.resting != state.resting_revision()) {
    drag_ = {};  // the next frame rebuilds the cache
    return;
  }
  dragging_ = true;
  for (std::size_t m = 0; m < moving.size(); ++m)
    std::copy_n(row_of(table_, moving[m]), columns_, row_of(drag_.rows, m));
}

// True if a frame from all factors reads less than a frame from cached sums and weights of moving handles.
bool FusedEngine::few_factors(std::size_t moving) const {
  const weights::TiledBinding& b = *binding_;
  return b.compressed() && b.factor_count() + b.skeleton.size() < b.leaves.slot_count() * (sums_ + moving);
}

void FusedEngine::begin_drag(Handles moving) {
  const std::size_t slots = binding_->leaves.slot_count();
  drag_.moving.assign(moving.begin(), moving.end());
  drag_.sums.resize(slots * sums_);
  drag_.weights.resize(list_moving());
  drag_.rows.assign(drag_.row_count() * columns_, 0.0f);
  base::AlignedVector<float> others = table_;
  for (const auto j : moving) std::fill_n(row_of(others, j), columns_, 0.0f);
  blend_skeleton(others.data());
  for_leaves([&](std::size_t leaf) {
    if (drag_.row_count(leaf) == 0) return;
    tiles_.blend(leaf_run(leaf, others.data()), drag_.sums.data() + binding_->leaves.begin(leaf) * sums_);
    base::AlignedVector<float> scratch(weights::leaf_slots * columns_);
    pack_weights(leaf, scratch.data());
  });
}

// For each leaf, lists the moving handles that have weights there. Returns the total number of these weights.
std::size_t FusedEngine::list_moving() {
  const weights::TiledBinding& b = *binding_;
  drag_.starts = {0};
  std::size_t weights = 0;
  for (std::size_t leaf = 0; leaf < b.leaves.count(); ++leaf) {
    for (std::uint32_t m = 0; m < drag_.moving.size(); ++m) {
      if (!b.has_lists() || std::ranges::binary_search(b.list(leaf), drag_.moving[m]))
        drag_.listed.push_back(m);
    }
    drag_.starts.push_back(drag_.listed.size());
    weights += (b.leaves.end(leaf) - b.leaves.begin(leaf)) * drag_.row_count(leaf);
  }
  return weights;
}

void FusedEngine::pack_whole(std::size_t leaf) {
  const weights::TiledBinding& b = *binding_;
  const auto list = b.has_lists() ? b.list(leaf) : std::span<const std::uint32_t>();
  const std::size_t count = drag_.row_count(leaf), rows = b.has_lists() ? list.size() : b.handles;
  const float* from = b.weights.data() + b.first_weight(leaf);
  float* out = drag_.weights.data() + weights::leaf_slots * drag_.starts[leaf];
  for (std::size_t m = 0; m < count; ++m) {
    const auto handle = drag_.moving[drag_.listed[drag_.starts[leaf] + m]];
    const auto row = b.has_lists() ? std::size_t(std::ranges::lower_bound(list, handle) - list.begin())
                                   : std::size_t(handle);
    for (std::size_t t = 0; t < (b.leaves.end(leaf) - b.leaves.begin(leaf)) / weights::lanes; ++t) {
      std::copy_n(from + (t * rows + row) * weights::lanes, weights::lanes,
                  out + (t * count + m) * weights::lanes);
    }
  }
}

// Writes the weights of the moving handles in a leaf to drag_.weights. Compressed weights are expanded: the
// blend kernel multiplies the leaf's factors by the pivots' weights of the moving handles. Each call of the
// kernel processes as many handles as a row has columns.
void FusedEngine::pack_weights(std::size_t leaf, float* scratch) {
  const weights::TiledBinding& b = *binding_;
  if (!b.compressed()) return pack_whole(leaf);
  const std::size_t begin = b.leaves.begin(leaf), tiles = (b.leaves.end(leaf) - begin) / weights::lanes;
  const std::size_t count = drag_.row_count();
  TileRun run = leaf_run(leaf, nullptr);
  base::AlignedVector<float> pivots(run.rows * columns_);
  const bool factored = !b.factored[leaf].dense;
  const TileLines<const float> skeleton{b.skeleton.data(), b.handles};
  const auto pivot_weight = [&](std::size_t row, std::size_t handle) -> float {
    if (!factored) return row == handle;  // a dense leaf stores all weights
    return skeleton.at(b.factored[leaf].pivots + row, handle);
  };
  float* const out = drag_.weights.data() + begin * count;
  for (std::size_t m = 0; m < count; m += columns_) {
    const std::size_t at_once = std::min(columns_, count - m);
    for (std::size_t r = 0; r < run.rows; ++r)
      for (std::size_t c = 0; c < columns_; ++c)
        pivots[r * columns_ + c] = c < at_once ? pivot_weight(r, drag_.moving[m + c]) : 0;
    run.table = pivots.data();
    tiles_.blend(run, scratch);
    for (std::size_t t = 0; t < tiles; ++t)
      std::copy_n(scratch + t * columns_ * weights::lanes, at_once * weights::lanes,
                  out + (t * count + m) * weights::lanes);
  }
}

void FusedEngine::blend_skeleton(const float* table) {
  const weights::TiledBinding& b = *binding_;
  pool_.for_blocks(b.skeleton_slots(), skeleton_block, [&](std::size_t begin, std::size_t end) {
    float* sums = skeleton_sums_.data() + begin * columns_;
    tiles_.blend(
        {(end - begin) / weights::lanes, b.handles, b.skeleton.data() + begin * b.handles, table, nullptr},
        sums);
    to_rows({sums, columns_}, end - begin, skeleton_table_.data() + begin * columns_);
  });
}

TileRun FusedEngine::leaf_run(std::size_t leaf, const float* table) const {
  const weights::TiledBinding& b = *binding_;
  const std::size_t begin = b.leaves.begin(leaf), tiles = (b.leaves.end(leaf) - begin) / weights::lanes;
  if (!b.compressed()) {
    const float* weights = b.weights.data() + b.first_weight(leaf);
    const float* moments = rest_moments_.empty() ? nullptr : rest_moments_.data() + begin * rest_moment_lines;
    return {.tiles = tiles,
            .rows = b.has_lists() ? b.list(leaf).size() : b.handles,
            .weights = weights,
            .table = table,
            .listed = b.has_lists() ? b.list(leaf).data() : nullptr,
            .rest_moments = moments};
  }
  const weights::LeafFactors& f = b.factored[leaf];
  const float* rows = f.dense ? table : skeleton_table_.data() + f.pivots * columns_;
  return {tiles, f.rank, b.factors_of(leaf), rows, nullptr};
}

// Returns the kernel's input for a leaf. If a drag moves handles with weight in the leaf, the input contains
// the rows of these handles and the cached sums. Otherwise, it contains all rows.
TileRun FusedEngine::frame_run(std::size_t leaf) const {
  TileRun run = leaf_run(leaf, table_.data());
  if (!dragging_ || drag_.row_count(leaf) == 0) return run;
  const std::size_t start = drag_.starts[leaf];
  return {.tiles = run.tiles,
          .rows = drag_.row_count(leaf),
          .weights = drag_.weights.data() + weights::leaf_slots * start,
          .table = drag_.rows.data(),
          .base = drag_.sums.data() + binding_->leaves.begin(leaf) * sums_,
          .listed = drag_.listed.data() + start,
          .rest_moments = run.rest_moments};
}

void FusedEngine::apply_to_vertices() {
  const weights::TiledBinding& b = *binding_;
  // If probes move positions in this frame, the next frame must recompute all positions.
  const bool placed = dragging_ && std::exchange(drag_.placed, !layer_);
  for_leaves([&](std::size_t leaf) {
    leaf_moved_[leaf] = !(placed && drag_.row_count(leaf) == 0);
    if (!leaf_moved_[leaf]) return;
    const std::size_t begin = b.leaves.begin(leaf);
    TileRun run = frame_run(leaf);
    run.mean = mean_.data();
    if (!shares_.empty()) run.shares = shares_.data() + begin;
    tiles_.apply(run, rest_.empty() ? nullptr : rest_.data() + begin * 3, offsets().data() + begin * 3,
                 positions_.data() + 4 * std::size_t(b.rings.position_starts[leaf]));
  });
}

void FusedEngine::move_by_probes() {
  const weights::TiledBinding& b = *binding_;
  const auto first = [&](std::size_t leaf) {
    return positions_.data() + 4 * std::size_t(b.rings.position_starts[leaf]);
  };
  if (slots_.empty()) slots_ = slots_of(b.leaves);
  std::vector<Vec3> anchors;
  for (const auto v : layer_->anchors()) {
    const std::size_t slot = slots_[v], leaf = slot / weights::leaf_slots;
    const float* p = first(leaf) + 4 * (slot - b.leaves.begin(leaf));
    anchors.push_back(b.unit * Vec3{p[0], p[1], p[2]});
  }
  layer_->carry(anchors, origin_);
  probes_.follow(*layer_, b.leaves, pool_);
  const TileKernel& logs = kernel_.forms[static_cast<std::size_t>(pose::RowForm::logs)];
  for_leaves([&](std::size_t leaf) {
    if (probes_.moves(*layer_, leaf)) probes_.move(*layer_, leaf, logs, b.unit, first(leaf));
  });
}

void FusedEngine::compute_normals() {
  const weights::TiledBinding& b = *binding_;
  const weights::Rings& r = b.rings;
  for_leaves([&](std::size_t leaf) {
    const std::size_t begin = b.leaves.begin(leaf), slots = b.leaves.end(leaf) - begin;
    const std::size_t first = r.position_starts[leaf];
    kernel_.ring_vertices({positions_.data(), first, slots, r.position_starts[leaf + 1] - first,
                           std::min(slots, b.leaves.vertices - begin), leaf_moved_[leaf] != 0,
                           r.ghosts.data() + (first - begin), r.ghosts.size() - (first - begin),
                           b.leaves.order.data() + begin, r.neighbours.data() + r.neighbour_starts[leaf],
                           r.lengths.data() + begin / weights::ring_group, static_cast<float>(b.unit)},
                          vertices_.data());
  });
  for (const auto& vertex : r.high_valence) {
    kernel_.ring_high_valence(positions_.data(), vertex.neighbours.data(), vertex.neighbours.size(),
                              vertex.position, vertices_[b.leaves.order[vertex.slot]]);
  }
}

template <class Body>
void FusedEngine::for_leaves(const Body& body) {
  pool_.for_blocks(binding_->leaves.count(), 1, [&](std::size_t leaf, std::size_t) { body(leaf); });
}

// Adds a vector per vertex to an array [tile][3][lane], in multiples of the binding's unit.
template <class OfVertex>
void FusedEngine::add(base::AlignedVector<float>& array, const OfVertex& vector) {
  const TileLines<float> lines{array.data(), 3};
  pool_.for_blocks(
      binding_->leaves.slot_count(), weights::leaf_slots, [&](std::size_t begin, std::size_t end) {
        for (std::size_t slot = begin; slot < end; ++slot)
          lines.set(slot, 0,
                    lines.three(slot, 0) + (1 / binding_->unit) * vector(binding_->leaves.order[slot]));
      });
}

}  // namespace viete::deform
