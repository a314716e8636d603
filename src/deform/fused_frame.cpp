#include "deform/fused_frame.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/clock.h"

namespace viete::deform {

namespace {

constexpr std::size_t few = 4;               // of the elements, at most one in so many is few
constexpr std::size_t skeleton_block = 256;  // slots that one thread blends at once

// Sums [tile][12][lane] of slots [begin, end) as rows of a table.
void to_rows(const float* sums, std::size_t begin, std::size_t end, float* table) {
  for (std::size_t s = begin; s < end; ++s) {
    const float* from = sums + s / lanes * lanes * log_size + s % lanes;
    for (std::size_t c = 0; c < log_size; ++c) table[s * log_size + c] = from[c * lanes];
  }
}

}  // namespace

FusedFrame::FusedFrame(std::shared_ptr<const Cage> cage, std::shared_ptr<const TiledBinding> binding,
                       base::WorkerPool& pool, const sym3::Kernel& kernel)
    : kernel_(frame_kernel(kernel)),
      cage_(std::move(cage)),
      binding_(std::move(binding)),
      pool_(pool),
      columns_(binding_->coordinates == Coordinates::face ? log_size : position_size) {
  if (binding_->coordinates == Coordinates::face) {
    maps_.resize(binding_->handles);
    splits_.resize(binding_->handles);
    logs_.resize(binding_->handles);
    entries_.resize(binding_->handles);
  }
  table_.assign(binding_->handles * columns_, 0.0f);
  skeleton_sums_.resize(binding_->skeleton_slots() * log_size);
  skeleton_table_.resize(binding_->skeleton_slots() * log_size);
  positions_.resize(binding_->rings.place_count() * 4);
  vertices_.assign(binding_->leaves.vertices, FrameVertex{});
  leaf_moved_.assign(binding_->leaves.count(), 1);
}

std::size_t FusedFrame::bytes() const {
  if (!dragging_) return binding_->bytes();
  return sizeof(float) * (held_.sums.size() + held_.weights.size() + binding_->offsets.size());
}

void FusedFrame::deform(const Pose& pose) {
  check_pose(*cage_, pose);
  times_ = {};
  base::Stopwatch watch;
  find_moved(pose);
  const bool held = drag_ && !held_.moving.empty();
  origin_ = held ? held_.origin : pose_origin(*cage_, pose.positions);
  if (binding_->coordinates == Coordinates::face) {
    face_maps(*cage_, pose.positions, moved_, maps_);
    times_[Link::face_maps] = watch.lap_ms();
    split_maps(maps_, moved_, splits_);
    log_maps(*cage_, maps_, splits_, pose.turns, logs_, report_);
    times_[Link::log_maps] = watch.lap_ms();
  } else {
    report_ = {pose.turns, {}, {}};
  }
  pose_ = pose.positions;
  fill_table(pose);
  follow_drag();
  if (binding_->compressed() && !dragging_) {
    blend_skeleton(table_.data());
    times_[Link::skeleton] = watch.lap_ms();
  }
  place_vertices();
  times_[Link::fused] = watch.lap_ms();
  compute_normals();
  times_[Link::normals] = watch.lap_ms();
}

PosedHandles FusedFrame::posed_handles() const {
  PosedHandles posed{pose_origin(*cage_, pose_), logs_, {}};
  if (binding_->coordinates == Coordinates::mean_value)
    posed.positions = relative_to(posed.origin, pose_);
  return posed;
}

void FusedFrame::set_dragging(bool on) {
  if (drag_ != on) held_ = {};
  drag_ = on;
}

// Since the last frame; all at the first.
void FusedFrame::find_moved(const Pose& pose) {
  moved_.clear();
  for (std::uint32_t e = 0; e < cage_->element_count(); ++e) {
    const auto& t = cage_->surface.triangles[e];
    const auto stayed = [&](std::uint32_t v) { return !pose_.empty() && pose.positions[v] == pose_[v]; };
    if (!std::all_of(t.begin(), t.end(), stayed)) moved_.push_back(e);
  }
}

void FusedFrame::fill_table(const Pose& pose) {
  const double scale = 1 / binding_->unit;
  if (binding_->coordinates == Coordinates::mean_value) {
    for (std::size_t j = 0; j < binding_->handles; ++j) {
      const Vec3 p = scale * (pose.positions[j] - origin_);
      for (int i = 0; i < 3; ++i) table_[position_size * j + i] = static_cast<float>(p[i]);
    }
    return;
  }
  for (std::size_t j = 0; j < logs_.size(); ++j) {
    const auto& [x, y, unused] = logs_[j];
    const auto& t = cage_->surface.triangles[j];
    const auto& p = pose.positions;
    const Vec3 c = (scale / 3) * ((p[t[0]] - origin_) + (p[t[1]] - origin_) + (p[t[2]] - origin_));
    entries_[j] = {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz, y[0], y[1], y[2], c[0], c[1], c[2]};
  }
  if (held_.moving.empty()) choose_mean();
  for (std::size_t j = 0; j < entries_.size(); ++j) {
    for (std::size_t i = 0; i < log_size; ++i) {
      table_[log_size * j + i] = static_cast<float>(entries_[j][i] - static_cast<double>(mean_[i]));
    }
  }
}

// Weights sum to one up to what compression leaves out, so the log that all elements share is best not
// weighted at all: a turn of the whole cage is then as exact as float, whatever the tolerance. (What the
// centres miss, the offsets hold, which are made with the same weights.) During a drag the mean stays with
// the sums. Where nothing is left out something near it does, which an edit leaves as it is, and with it the
// bits of all that the edit does not reach.
void FusedFrame::choose_mean() {
  for (std::size_t i = 0; i < centre_column; ++i) {
    double sum = 0;
    for (const auto& entry : entries_) sum += entry[i];
    const double mean = sum / static_cast<double>(std::max<std::size_t>(entries_.size(), 1));
    mean_[i] = static_cast<float>(binding_->compressed() ? mean : 0.5 * std::round(2 * mean));
  }
}

// An element that no vertex of moved can still take another branch of its log.
bool FusedFrame::others_stayed() const {
  auto moving = held_.moving.begin();
  for (std::size_t e = 0; e < binding_->handles; ++e) {
    if (moving != held_.moving.end() && *moving == e) {
      ++moving;
      continue;
    }
    const auto row = table_.begin() + static_cast<std::ptrdiff_t>(e * log_size);
    const auto then = held_.table.begin() + static_cast<std::ptrdiff_t>(e * log_size);
    if (!std::equal(row, row + log_size, then)) return false;
  }
  return true;
}

// Decides whether this frame adds to sums that are kept, and fills what it adds.
void FusedFrame::follow_drag() {
  dragging_ = false;
  if (!drag_ || binding_->coordinates != Coordinates::face) return;
  if (!held_.moving.empty()) {
    const bool same = std::includes(held_.moving.begin(), held_.moving.end(), moved_.begin(), moved_.end());
    dragging_ = same && others_stayed();
    if (!dragging_) held_ = {};  // formed anew when the next frame moves something
  } else if (!moved_.empty() && few * moved_.size() <= binding_->handles) {
    hold(moved_);
    dragging_ = true;
  }
  for (std::size_t m = 0; m < held_.moving.size(); ++m) {
    std::copy_n(table_.begin() + static_cast<std::ptrdiff_t>(held_.moving[m] * log_size), log_size,
                held_.rows.begin() + static_cast<std::ptrdiff_t>(m * log_size));
  }
}

void FusedFrame::hold(const Elements& moving) {
  const std::size_t slots = binding_->leaves.slot_count();
  held_.moving = moving;
  held_.table = table_;
  held_.origin = origin_;
  held_.sums.resize(slots * log_size);
  held_.weights.resize(list_moving());
  held_.rows.assign(held_.row_count() * log_size, 0.0f);
  base::AlignedVector<float> others = table_;
  for (const auto j : moving)
    std::fill_n(others.begin() + static_cast<std::ptrdiff_t>(j * log_size), log_size, 0.0f);
  blend_skeleton(others.data());
  for_leaves([&](std::size_t leaf) {
    if (held_.row_count(leaf) == 0) return;
    kernel_.in_float.blend(leaf_run(leaf, others.data()),
                           held_.sums.data() + binding_->leaves.begin(leaf) * log_size);
    base::AlignedVector<float> scratch(leaf_slots * log_size);
    pack_weights(leaf, scratch.data());
  });
}

// Which of the moving elements have weight in each leaf. Returns how many weights that makes.
std::size_t FusedFrame::list_moving() {
  const TiledBinding& b = *binding_;
  held_.starts = {0};
  std::size_t weights = 0;
  for (std::size_t leaf = 0; leaf < b.leaves.count(); ++leaf) {
    for (std::uint32_t m = 0; m < held_.moving.size(); ++m) {
      if (!b.has_lists() || std::ranges::binary_search(b.list(leaf), held_.moving[m]))
        held_.listed.push_back(m);
    }
    held_.starts.push_back(held_.listed.size());
    weights += (b.leaves.end(leaf) - b.leaves.begin(leaf)) * held_.row_count(leaf);
  }
  return weights;
}

void FusedFrame::pack_listed(std::size_t leaf) {
  const TiledBinding& b = *binding_;
  const auto list = b.list(leaf);
  const std::size_t count = held_.row_count(leaf), rows = list.size();
  const float* from = b.weights.data() + b.first_weight(leaf);
  float* out = held_.weights.data() + leaf_slots * held_.starts[leaf];
  for (std::size_t m = 0; m < count; ++m) {
    const auto handle = held_.moving[held_.listed[held_.starts[leaf] + m]];
    const auto row = static_cast<std::size_t>(std::ranges::lower_bound(list, handle) - list.begin());
    for (std::size_t t = 0; t < (b.leaves.end(leaf) - b.leaves.begin(leaf)) / lanes; ++t) {
      std::copy_n(from + (t * rows + row) * lanes, lanes, out + (t * count + m) * lanes);
    }
  }
}

// The columns of the moving elements: copied, or, where the leaf has factors, blended of its pivots' like
// logs.
void FusedFrame::pack_weights(std::size_t leaf, float* scratch) {
  const TiledBinding& b = *binding_;
  if (b.has_lists()) return pack_listed(leaf);
  const std::size_t begin = b.leaves.begin(leaf), tiles = (b.leaves.end(leaf) - begin) / lanes;
  const std::size_t count = held_.row_count();
  TileRun<float> run = leaf_run(leaf, nullptr);
  base::AlignedVector<float> pivots(run.rows * log_size);
  const bool factored = b.compressed() && !b.factored[leaf].dense;
  float* const out = held_.weights.data() + begin * count;
  for (std::size_t m = 0; m < count; m += log_size) {
    for (std::size_t r = 0; r < run.rows; ++r) {
      for (std::size_t c = 0; c < log_size; ++c) {
        float entry = 0;
        if (m + c < held_.moving.size()) {
          const std::size_t j = held_.moving[m + c];
          const std::size_t slot = factored ? b.factored[leaf].pivots + r : 0;
          entry = factored ? b.skeleton[slot / lanes * lanes * b.handles + j * lanes + slot % lanes] : r == j;
        }
        pivots[r * log_size + c] = entry;
      }
    }
    run.table = pivots.data();
    kernel_.in_float.blend(run, scratch);
    for (std::size_t t = 0; t < tiles; ++t) {
      std::copy_n(scratch + t * log_size * lanes, std::min(log_size, count - m) * lanes,
                  out + (t * count + m) * lanes);
    }
  }
}

void FusedFrame::blend_skeleton(const float* table) {
  const TiledBinding& b = *binding_;
  pool_.for_blocks(b.skeleton_slots(), skeleton_block, [&](std::size_t begin, std::size_t end) {
    float* sums = skeleton_sums_.data() + begin * log_size;
    kernel_.in_float.blend(
        {(end - begin) / lanes, b.handles, b.skeleton.data() + begin * b.handles, table, nullptr}, sums);
    to_rows(sums, 0, end - begin, skeleton_table_.data() + begin * log_size);
  });
}

TileRun<float> FusedFrame::leaf_run(std::size_t leaf, const float* table) const {
  const TiledBinding& b = *binding_;
  const std::size_t begin = b.leaves.begin(leaf), tiles = (b.leaves.end(leaf) - begin) / lanes;
  if (!b.compressed()) {
    const float* weights = b.weights.data() + b.first_weight(leaf);
    if (!b.has_lists()) return {tiles, b.handles, weights, table};
    return {tiles, b.list(leaf).size(), weights, table, nullptr, nullptr, b.list(leaf).data()};
  }
  const LeafFactors& f = b.factored[leaf];
  const float* rows = f.dense ? table : skeleton_table_.data() + f.pivots * log_size;
  return {tiles, f.rank, b.factors.data() + f.first, rows, nullptr};
}

void FusedFrame::place_vertices() {
  const TiledBinding& b = *binding_;
  const auto& tiles = kernel_.in_float;
  const bool placed = dragging_ && std::exchange(held_.placed, true);
  for_leaves([&](std::size_t leaf) {
    leaf_moved_[leaf] = !(placed && held_.row_count(leaf) == 0);
    if (!leaf_moved_[leaf]) return;
    const std::size_t begin = b.leaves.begin(leaf);
    TileRun<float> run = leaf_run(leaf, table_.data());
    if (dragging_ && held_.row_count(leaf) > 0) {
      const std::size_t start = held_.starts[leaf];
      run = {run.tiles,
             held_.row_count(leaf),
             held_.weights.data() + leaf_slots * start,
             held_.rows.data(),
             held_.sums.data() + begin * log_size,
             nullptr,
             held_.listed.data() + start};
    }
    run.mean = mean_.data();
    const float* offsets = b.offsets.data() + begin * position_size;
    float* out = positions_.data() + 4 * std::size_t(b.rings.places[leaf]);
    b.coordinates == Coordinates::face ? tiles.deform(run, offsets, out) : tiles.move(run, offsets, out);
  });
}

void FusedFrame::compute_normals() {
  const TiledBinding& b = *binding_;
  const Rings& r = b.rings;
  for_leaves([&](std::size_t leaf) {
    const std::size_t begin = b.leaves.begin(leaf), slots = b.leaves.end(leaf) - begin;
    const std::size_t first = r.places[leaf];
    kernel_.ring_vertices(
        {positions_.data(), first, slots, r.places[leaf + 1] - first,
         std::min(slots, b.leaves.vertices - begin), leaf_moved_[leaf] != 0, r.halo.data() + (first - begin),
         r.halo.size() - (first - begin), b.leaves.order.data() + begin, r.walk.data() + r.walk_starts[leaf],
         r.lengths.data() + begin / ring_group, static_cast<float>(b.unit)},
        vertices_.data());
  });
  for (const auto& hub : r.hubs) {
    kernel_.ring_hub(positions_.data(), hub.walk.data(), hub.walk.size(), hub.place,
                     vertices_[b.leaves.order[hub.slot]]);
  }
}

template <class Body>
void FusedFrame::for_leaves(const Body& body) {
  pool_.for_blocks(binding_->leaves.count(), 1, [&](std::size_t leaf, std::size_t) { body(leaf); });
}

}  // namespace viete::deform
