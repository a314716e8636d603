#include "deform/exact.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <optional>
#include <vector>

#include "base/error.h"
#include "base/memory.h"
#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/maps.h"
#include "deform/moments.h"
#include "deform/probe_layer.h"
#include "deform/staged_engine.h"
#include "deform/stitched_engine.h"
#include "deform/vertex_sample.h"
#include "deform/weigher.h"

namespace viete::deform {

namespace {

// Number of vertices with a megabyte of weights, within limits.
std::size_t handle_block(std::size_t handles) {
  constexpr std::size_t weights = 1 << 17, most = 4096;
  return std::clamp(weights / std::max<std::size_t>(handles, 1) / bind_lanes * bind_lanes, bind_lanes, most);
}

// The vertices [begin, end), without their triangles.
Binding part_of(const Binding& whole, std::size_t begin, std::size_t end) {
  const auto rows = [&](const auto& values, std::size_t length) {
    const auto at = [&](std::size_t i) { return values.begin() + static_cast<std::ptrdiff_t>(i * length); };
    return std::remove_cvref_t<decltype(values)>(at(begin), at(end));
  };
  Binding part;
  part.weighting = whole.weighting;
  part.vertices = end - begin;
  part.handles = whole.handles;
  part.rest_origin = whole.rest_origin;
  part.rest = rows(whole.rest, 1);
  part.weights = rows(whole.weights, whole.handles);
  part.offsets = rows(whole.offsets, 1);
  return part;
}

Mask part_of(const Mask& whole, std::size_t begin, std::size_t end) {
  if (!whole) return nullptr;
  const auto first = whole->begin();
  return std::make_shared<const std::vector<float>>(first + std::ptrdiff_t(begin),
                                                    first + std::ptrdiff_t(end));
}

}  // namespace

namespace {

// Stitches one pose, given its sums of rows at every vertex; replaces positions by the stitched ones.
void stitch_positions(const Stitching& stitching, const Rows& rows, std::span<const double> sums,
                      const Shares& shares, const Scheme& scheme, sym3::Method method, base::WorkerPool& pool,
                      std::span<const Vec3> ways, std::span<mesh::Point> positions) {
  std::vector<Vec3> held;
  for (const auto& hold : stitching.holds) held.push_back(positions[hold.vertex] - rows.origin);
  Stitcher stitcher(stitching, rows.form, pool);
  stitcher.set_shares(shares);
  stitcher.set_shape(ways);
  stitcher.run(rows, sums, held, method, scheme.iterations);
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = rows.origin + stitcher.positions()[v];
}

}  // namespace

namespace {

bool holds_shares(const Mask& mask, const Weighting& weighting) {
  return mask || weighting.partial();
}

const mesh::Surface& with_vertices(const mesh::Surface& model) {
  if (model.positions.empty()) throw base::Error("", "the model has no vertices", "choose another file");
  return model;
}

// Memory of weights, offset and rest.
bool has_room_to_keep(std::size_t vertices, std::size_t handles) {
  const double bytes = static_cast<double>(vertices) * (8.0 * static_cast<double>(handles) + 56);
  return bytes < 0.25 * base::free_memory().value_or(0);
}

}  // namespace

ExactDeformer::ExactDeformer(const mesh::Surface& model, std::shared_ptr<const Cage> cage,
                             const Scheme& scheme, sym3::Method method, base::WorkerPool& pool,
                             Weights weights, const Mask& mask, base::Progress* progress)
    : model_(with_vertices(model)),
      cage_(std::move(cage)),
      scheme_(scheme),
      method_(method),
      pool_(pool),
      mask_(mask),
      state_(cage_, scheme.weighting.elements, scheme.blend),
      weigher_(*cage_, scheme.weighting),
      layer_(model.positions, pool) {
  const std::size_t n = model_.positions.size();
  state_.set_amounts(scheme.amounts);
  state_.keep_origin(holds_shares(mask_, scheme.weighting));
  if (scheme.stitched()) {
    stitching_ = stitch(model_, *cage_, pool_, settings_of(scheme));
    sums_.resize(n * state_.rows().columns());
    if (holds_shares(mask_, scheme.weighting)) shares_.resize(n);
  }
  if (entry(scheme.weighting.weights).on_surface) {
    surface_weights_ = bind(model_, *cage_, scheme.weighting, pool_, progress);
  } else if (weights == Weights::kept && has_room_to_keep(n, weigher_.handles())) {
    const std::size_t block = handle_block(weigher_.handles());
    parts_.resize((n + block - 1) / block);
  }
}

BoundPart ExactDeformer::part(std::size_t begin, std::size_t count) const {
  BoundPart part = surface_weights_.weights.empty()
                       ? bind_part(weigher_, std::span(model_.positions).subspan(begin, count))
                       : BoundPart{part_of(surface_weights_, begin, begin + count)};
  part.binding.shares = product(std::move(part.binding.shares), part_of(mask_, begin, begin + count));
  return part;
}

// Keeps the offsets at rest separately: adding and subtracting displacements would change bits.
void ExactDeformer::shape_by(BoundPart& part, const SharedShape& shape, std::size_t begin) const {
  Binding& b = part.binding;
  const auto at_rest = std::span(model_.positions).subspan(begin, b.vertices);
  if (!part.offsets.empty()) {
    std::ranges::copy(at_rest, b.rest.begin());
    b.offsets = part.offsets;
  }
  if (!shape) return;
  part.offsets = b.offsets;
  std::vector<Vec3> ways;
  for (std::size_t i = 0; i < b.vertices; ++i) ways.push_back((*shape)[begin + i] - at_rest[i]);
  deform::shape_by(b, turner_ ? turner_->turned(b, b.shares, ways) : ways);
}

// Returns the error of place_vertices().
double ExactDeformer::place(const BoundPart& part, const Rows& rows, std::size_t begin,
                            std::span<mesh::Point> positions) {
  const Binding& binding = part.binding;
  const std::size_t count = positions.size(), columns = rows.columns();
  if (!shares_.empty()) std::ranges::copy(binding.shares, shares_.begin() + std::ptrdiff_t(begin));
  const double error = place_vertices(binding, rows, method_, positions);
  if (!stitching_) return error;
  const auto sums = std::span(sums_).subspan(begin * columns, count * columns);
  blend(binding, rows, 0, count, sums);
  share_sums(binding, binding.shares, rows.form, 0, count, sums);
  return error;
}

ExactModel ExactDeformer::deform(const Pose& pose, const Probes& probes, const SharedShape& shape,
                                 base::Progress* progress) {
  state_.set_pose(pose);
  if (shape && WayTurner::is_for(scheme_)) {
    if (!turner_) turner_.emplace(cage_);
    turner_->set_pose(pose);
  }
  const Rows rows = state_.rows();
  const std::size_t n = model_.positions.size(), at_once = handle_block(weigher_.handles());
  ExactModel exact;
  exact.report = state_.report();
  exact.positions.resize(n);
  std::size_t done = 0, failed = 0;
  std::mutex mutex;  // protects these and exp_error
  pool_.for_blocks(n, at_once, [&](std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    BoundPart made;
    BoundPart& bound = parts_.empty() ? made : parts_[begin / at_once];
    if (bound.binding.vertices == 0) bound = part(begin, count);
    shape_by(bound, shape, begin);
    const double error = place(bound, rows, begin, std::span(exact.positions).subspan(begin, count));
    const std::lock_guard lock(mutex);
    done += count;
    failed += bound.failed;
    exact.exp_error = std::max(exact.exp_error, error);
    if (progress) progress->report(static_cast<double>(done) / static_cast<double>(n));
  });
  if (stitching_)
    stitch_positions(*stitching_, rows, sums_, shares_, scheme_, method_, pool_,
                     ways_of(shape, model_.positions), exact.positions);
  layer_.set(probes, mask_);
  if (layer_.moves()) layer_.move_all(exact.positions, method_);
  exact.warnings = weight_warnings(*cage_, scheme_.weighting.weights, failed, n);
  return exact;
}

ExactModel deform_exactly(const mesh::Surface& model, std::shared_ptr<const Cage> cage, const Scheme& scheme,
                          const Pose& pose, sym3::Method method, base::WorkerPool& pool,
                          base::Progress* progress, const Mask& mask, const Probes& probes,
                          const SharedShape& shape) {
  ExactDeformer deformer(model, std::move(cage), scheme, method, pool, ExactDeformer::Weights::dropped, mask,
                         progress);
  return deformer.deform(pose, probes, shape, progress);
}

}  // namespace viete::deform
