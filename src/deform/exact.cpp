#include "deform/exact.h"

#include <algorithm>
#include <mutex>
#include <numeric>
#include <utility>

#include "base/error.h"
#include "base/os.h"
#include "deform/staged_engine.h"
#include "deform/stitched_engine.h"
#include "weights/surface_weights.h"

namespace viete::deform {

namespace {

// Returns the number of vertices per block: a multiple of bind_lanes and at most 4,096. The weights of a
// block take about a megabyte.
std::size_t handle_block(std::size_t handles) {
  constexpr std::size_t weights = 1 << 17, most = 4096;
  return std::clamp(weights / std::max<std::size_t>(handles, 1) / weights::bind_lanes * weights::bind_lanes,
                    weights::bind_lanes, most);
}

bool holds_shares(const weights::Mask& mask, const pose::Weighting& weighting) {
  return mask || weighting.partial();
}

const mesh::Surface& with_vertices(const mesh::Surface& model) {
  if (model.positions.empty()) throw base::Error("", "the model has no vertices", "choose another file");
  return model;
}

pose::Deformer for_model(const mesh::Surface& model, pose::Deformer deformer) {
  deformer.weighting = weights::weighting_for(model, deformer.weighting);
  return deformer;
}

bool has_room_to_keep(std::size_t vertices, std::size_t handles) {
  const double bytes = static_cast<double>(vertices) * (8.0 * static_cast<double>(handles) + 56);
  return bytes < 0.25 * base::os::free_memory().value_or(0);
}

}  // namespace

ExactDeformer::ExactDeformer(const mesh::Surface& model, std::shared_ptr<const pose::Cage> cage,
                             const pose::Deformer& deformer, sym3::Method method, base::WorkerPool& pool,
                             Weights weights, const weights::Mask& mask, base::Progress* progress,
                             std::shared_ptr<const mesh::Splats> splats)
    : splats_(std::move(splats)),
      tip_step_(splats_ ? tip_step(model, *cage, tip_in_double) : 0),
      with_tips_(splats_ ? with_tips(model, tip_step_) : mesh::Surface()),
      model_(with_vertices(splats_ ? with_tips_ : model)),
      cage_(std::move(cage)),
      deformer_(for_model(model, deformer)),
      method_(method),
      pool_(pool),
      mask_(splats_ ? with_tips(mask) : mask),
      state_(cage_, deformer.weighting.elements, deformer.blend),
      weigher_(*cage_, deformer_.weighting),
      layer_(model_.positions, pool) {
  const std::size_t n = model_.positions.size();
  state_.set_amounts(deformer.amounts);
  state_.keep_origin(holds_shares(mask_, deformer_.weighting));
  if (deformer.stitched() && weights::stitches_coarse_model(model_)) {
    std::optional<base::ProgressPart> part(std::in_place, progress, 0, 0.25);
    coarse_model_.emplace(weights::coarse_model_of(model_, *cage_, pool_, progress));
    part.emplace(progress, 0.25, 0.5);
    coarse_ = std::make_unique<ExactDeformer>(coarse_model_->surface(), cage_, deformer_, method, pool,
                                              weights, coarse_model_->means(mask_), progress);
  } else if (deformer.stitched()) {
    stitching_ = stitch(model_, *cage_, pool_, deformer);
    sums_.resize(n * state_.rows().columns());
    if (holds_shares(mask_, deformer_.weighting)) shares_.resize(n);
  }
  const base::ProgressPart part(progress, coarse_ ? 0.5 : 0, 1);
  const bool on_surface = deformer_.weighting.on_surface();
  if (on_surface && n > weights::most_solved_vertices) {
    proxy_.emplace(model_, *cage_, deformer_.weighting, pool_, progress);
    row_ = [this](std::uint32_t vertex, std::span<double> row) { proxy_->row(vertex, row); };
  } else if (on_surface) {
    surface_weights_ = weights::bind(mesh::lent(model_), *cage_, deformer_.weighting,
                                     pose::EngineKind::staged, nullptr, pool_, progress);
    row_ = known_row(surface_weights_);
  }
  const bool has_all = on_surface && !proxy_;
  if (weights == Weights::kept && !has_all && has_room_to_keep(n, weigher_.handles())) {
    const std::size_t block = handle_block(weigher_.handles());
    parts_.resize((n + block - 1) / block);
  }
}

weights::BoundPart ExactDeformer::part(std::size_t begin, std::size_t count) const {
  std::vector<std::size_t> vertices(count);
  std::iota(vertices.begin(), vertices.end(), begin);
  return bind_vertices(weigher_, model_.positions, row_, mask_, vertices);
}

std::vector<Vec3> ExactDeformer::displacements(const weights::Binding& part,
                                               const weights::SharedShape& shape, std::size_t begin) const {
  if (!shape) return {};
  std::vector<Vec3> displacements;
  for (std::size_t i = 0; i < part.vertices; ++i)
    displacements.push_back((*shape)[begin + i] - (*part.rest)[i]);
  return follower_ ? follower_->followed({part, part.shares}, displacements) : displacements;
}

double ExactDeformer::place(const weights::Binding& part, const weights::SharedShape& shape,
                            std::size_t begin, std::span<mesh::Point> positions) {
  const std::size_t columns = state_.rows().columns();
  if (!shares_.empty()) std::ranges::copy(part.shares, shares_.begin() + std::ptrdiff_t(begin));
  const auto sums = stitching_ ? std::span(sums_).subspan(begin * columns, positions.size() * columns)
                               : std::span<double>();
  const std::vector<Vec3> displacements = this->displacements(part, shape, begin);
  return apply_to_vertices({part, part.shares, displacements}, state_.rows(), method_, positions, sums);
}

void ExactDeformer::stitch_positions(std::span<const Vec3> displacements,
                                     std::span<mesh::Point> positions) const {
  const pose::Rows rows = state_.rows();
  std::vector<Vec3> held;
  for (const auto& hold : stitching_->holds) held.push_back(positions[hold.vertex] - rows.origin);
  Stitcher stitcher(*stitching_, rows.form, pool_);
  stitcher.set_shares(shares_);
  stitcher.set_shape(displacements);
  stitcher.run(rows, sums_, held, method_, deformer_.iterations);
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = rows.origin + stitcher.positions()[v];
}

ExactModel ExactDeformer::deform(const pose::Pose& pose, const pose::Probes& probes,
                                 const weights::SharedShape& given_shape, base::Progress* progress) {
  const weights::SharedShape shape = splats_ ? with_tips(given_shape, tip_step_) : given_shape;
  state_.set_pose(pose);
  if (shape && ShapeFollower::is_for(deformer_)) {
    if (!follower_) follower_.emplace(cage_);
    follower_->set_pose(pose);
  }
  const std::size_t n = model_.positions.size(), at_once = handle_block(weigher_.handles());
  ExactModel exact;
  exact.report = state_.report();
  exact.positions.resize(n);
  std::size_t done = 0, failed = 0;
  std::mutex mutex;  // protects done, failed and exp_error
  pool_.for_blocks(n, at_once, [&](std::size_t begin, std::size_t end) {
    const std::size_t count = end - begin;
    weights::BoundPart made;
    weights::BoundPart& bound = parts_.empty() ? made : parts_[begin / at_once];
    if (bound.binding.vertices == 0) bound = part(begin, count);
    const double error = place(bound.binding, shape, begin, std::span(exact.positions).subspan(begin, count));
    const std::lock_guard lock(mutex);
    done += count;
    failed += bound.failed;
    exact.exp_error = std::max(exact.exp_error, error);
    if (progress) progress->report(static_cast<double>(done) / static_cast<double>(n));
  });
  if (stitching_) blended_ = exact.positions;
  if (stitching_) stitch_positions(weights::displacements_of(shape, model_.positions), exact.positions);
  if (coarse_) {
    weights::SharedShape own;
    if (shape)
      own = std::make_shared<std::vector<Vec3>>(coarse_model_->shape_of(*shape, model_.positions, pool_));
    auto moves = coarse_->deform(pose, {}, own).positions;
    const auto means =
        coarse_model_->is_lattice() ? coarse_->blended_ : coarse_model_->means(exact.positions, pool_);
    for (std::size_t c = 0; c < moves.size(); ++c) moves[c] = moves[c] - means[c];
    coarse_model_->move(moves, mask_, exact.positions, pool_);
  }
  layer_.set(probes, mask_);
  if (layer_.moves()) layer_.move_all(exact.positions, method_);
  if (splats_) pose_splats(exact);
  const std::size_t points = splats_ ? 4 : 1;  // counts splats, not tips
  exact.warnings = weights::weight_warnings(*cage_, deformer_.weighting.weights,
                                            (failed + points - 1) / points, n / points);
  return exact;
}

void ExactDeformer::pose_splats(ExactModel& exact) const {
  exact.splats =
      std::make_shared<const mesh::Splats>(posed_splats(*splats_, exact.positions, tip_step_, pool_));
  exact.positions.resize(splats_->size());
}

ExactModel deform_exactly(const mesh::Surface& model, std::shared_ptr<const pose::Cage> cage,
                          const pose::Deformer& deformer, const pose::Pose& pose, sym3::Method method,
                          base::WorkerPool& pool, base::Progress* progress, const weights::Mask& mask,
                          const pose::Probes& probes, const weights::SharedShape& shape,
                          std::shared_ptr<const mesh::Splats> splats) {
  ExactDeformer exact(model, std::move(cage), deformer, method, pool, ExactDeformer::Weights::dropped, mask,
                      progress, std::move(splats));
  return exact.deform(pose, probes, shape, progress);
}

}  // namespace viete::deform
