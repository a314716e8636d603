#include "files/animated_model.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "base/os.h"
#include "document/checks.h"
#include "pose/deformer.h"
#include "weights/bind.h"
#include "weights/tiled_binding.h"

namespace viete::files {

using Precision = AnimatedModel::Precision;

AnimatedModel::AnimatedModel(const Export& model, const document::Timeline& timeline, Precision wish,
                             double most, std::span<const double> tried, base::WorkerPool& pool,
                             base::Progress* progress)
    : model_(model), pool_(pool) {
  vectors_.follow(has_cage() ? model.cage : nullptr);
  vectors_.follow_model(model.model);
  animation_.emplace(timeline, vectors_);
  if (wish == Precision::fast && can_fuse()) make_fast(most, tried, progress);
}

document::WholePose AnimatedModel::pose(double frame) const {
  document::WholePose pose = animation_->at(frame);
  if (!has_cage()) pose.cage = pose::rest_pose(*model_.cage);
  return pose;
}

bool AnimatedModel::can_fuse() const {
  if (!has_cage() || pose::engine_for(model_.deformer, model_.method) != pose::EngineKind::fused)
    return false;
  const std::size_t handles = pose::handle_count(*model_.cage, model_.deformer.weighting.elements);
  const double weights =
      4.0 * static_cast<double>(handles) * static_cast<double>(model_.model->positions.size());
  return weights < 0.5 * base::os::free_memory().value_or(0);
}

void AnimatedModel::make_fast(double most, std::span<const double> tried, base::Progress* progress) {
  const pose::Weighting& weighting = model_.deformer.weighting;
  constexpr double uncompressed = 0;  // compression would add more error than rounding to float
  auto tiles = std::make_shared<const weights::TiledBinding>(
      weights::bind_tiles(*model_.model, *model_.cage, weighting, pool_, uncompressed, progress));
  auto binding = std::make_shared<const weights::Binding>(
      weights::with_tiles(model_.model, *model_.cage, std::move(tiles)));
  deformer_ =
      std::make_unique<deform::FrameDeformer>(model_.cage, std::move(binding), model_.deformer, pool_);
  deformer_->set_mask(model_.mask);
  for (const double frame : tried) run_fast(frame);
  if (fast_error() <= most) return;
  deformer_ = nullptr;
  error_ = 0;
}

double AnimatedModel::fast_error() const {
  constexpr double unsampled_factor = 3;  // error of other vertices / error of the sample; <= 1.6 in tests
  return unsampled_factor * error_;
}

pose::Probes AnimatedModel::probes(const document::WholePose& pose) const {
  pose::Probes probes = model_.probes;
  for (std::size_t i = 0; i < probes.all.size(); ++i)
    if (!probes.all[i].locked) probes.all[i].pose = pose.probe(i);
  return probes;
}

deform::ExactModel AnimatedModel::exact(const document::WholePose& pose, base::Progress* progress) {
  const auto acts = [](const document::Probe& probe) {
    return !probe.pin && probe.pose != document::ProbePose{};
  };
  if (pose.shape && !has_cage() && std::ranges::none_of(probes(pose).all, acts)) {
    notes_ = animation_->notes();
    return {*pose.shape, {}, {}, 0, model_.splats};
  }
  using deform::ExactDeformer;
  if (!exact_)
    exact_ =
        std::make_unique<ExactDeformer>(*model_.model, model_.cage, model_.deformer, model_.method, pool_,
                                        ExactDeformer::Weights::kept, model_.mask, progress, model_.splats);
  deform::ExactModel deformed = exact_->deform(pose.cage, probes(pose), pose.shape, progress);
  take_notes(deformed.report, pose, deformed.warnings);
  std::ranges::move(method_notes(model_.method, deformed.exp_error), std::back_inserter(notes_));
  return deformed;
}

void AnimatedModel::run_fast(double frame) {
  const document::WholePose pose = this->pose(frame);
  deformer_->set_probes(probes(pose));
  deformer_->set_shape(pose.shape);
  deformer_->deform(pose.cage, model_.method);
  error_ = std::max(error_, deformer_->sampled_error());
  take_notes(deformer_->state().report(), pose, deformer_->binding().warnings);
}

void AnimatedModel::take_notes(const pose::LogReport& report, const document::WholePose& pose,
                               const std::vector<std::string>& warnings) {
  notes_ = animation_->notes();
  std::ranges::move(document::pose_notes(report, *model_.cage, pose.cage), std::back_inserter(notes_));
  notes_.insert(notes_.end(), warnings.begin(), warnings.end());
}

std::span<const float> AnimatedModel::floats(double frame) {
  floats_.resize(3 * model_.model->positions.size());
  const auto put = [&](std::size_t v, const mesh::Point& p) {
    for (std::size_t i = 0; i < 3; ++i) {
      floats_[3 * v + i] = static_cast<float>(p[i]);
      rounding_ = std::max(rounding_, std::abs(floats_[3 * v + i] - p[i]));
    }
  };
  if (precision() == Precision::exact) {
    const auto positions = exact(pose(frame)).positions;
    for (std::size_t v = 0; v < positions.size(); ++v) put(v, positions[v]);
    return floats_;
  }
  run_fast(frame);
  const auto vertices = deformer_->vertices();
  const mesh::Vec3 o = deformer_->origin();
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    const float* p = vertices[v].position;
    put(v, {o[0] + p[0], o[1] + p[1], o[2] + p[2]});
  }
  return floats_;
}

std::vector<mesh::Point> AnimatedModel::positions(double frame) {
  if (precision() == Precision::exact) return exact(pose(frame)).positions;
  run_fast(frame);
  return deformer_->positions();
}

}  // namespace viete::files
