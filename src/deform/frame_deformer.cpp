#include "deform/frame_deformer.h"

#include <cassert>
#include <type_traits>
#include <utility>

#include "base/clock.h"
#include "deform/vertex_sample.h"
#include "pose/deformer.h"

namespace viete::deform {

namespace {

template <class Indices>
std::vector<Vec3> positions_at(std::span<const pose::FrameVertex> vertices, const Indices& indices) {
  std::vector<Vec3> some;
  for (const auto i : indices) {
    const auto& p = vertices[i].position;
    some.push_back({p[0], p[1], p[2]});
  }
  return some;
}

template <class T>
std::vector<std::remove_const_t<T>> copied(std::span<T> all) {
  return {all.begin(), all.end()};
}

}  // namespace

FrameDeformer::FrameDeformer(std::shared_ptr<const pose::Cage> cage,
                             std::shared_ptr<const weights::Binding> binding, const pose::Deformer& deformer,
                             base::WorkerPool& pool, std::shared_ptr<const Stitching> stitching)
    : cage_(cage),
      pool_(pool),
      binding_(std::move(binding)),
      deformer_(deformer),
      state_(cage, deformer.weighting.elements, deformer.blend),
      weigher_(state_.cage(), binding_->weighting),
      layer_(*binding_->rest, pool) {
  state_.set_amounts(deformer.amounts);
  const pose::RowForm form = state_.rows().form;
  if (!binding_->weights.empty()) staged_ = std::make_unique<StagedEngine>(binding_, form, pool);
  if (deformer.stitched() && stitching && binding_->tiles) {
    stitched_ =
        std::make_unique<StitchedEngine>(binding_, std::move(stitching), form, deformer.iterations, pool);
  } else if (binding_->tiles) {
    fused_ = std::make_unique<FusedEngine>(binding_, form, pool);
  }
  set_mask(nullptr);
}

std::optional<pose::EngineKind> FrameDeformer::engine(sym3::Method method) const {
  const pose::EngineKind wanted = engine_for(deformer_, method, all_staged_);
  if (wanted == pose::EngineKind::stitched) return stitched_ ? std::optional(wanted) : std::nullopt;
  if (wanted == pose::EngineKind::fused && fused_) return wanted;
  return staged_ ? std::optional(pose::EngineKind::staged) : std::nullopt;
}

void FrameDeformer::set_amounts(const pose::Amounts& amounts) {
  deformer_.amounts = amounts;
  state_.set_amounts(amounts);
}

template <class Act>
void FrameDeformer::for_engines(const Act& act) {
  if (staged_) act(*staged_);
  if (fused_) act(*fused_);
  if (stitched_) act(*stitched_);
}

void FrameDeformer::set_mask(weights::Mask mask) {
  mask_ = std::move(mask);
  all_mask_ = binding_->tip_step > 0 ? with_tips(mask_) : mask_;
  layer_.set(layer_.probes(), all_mask_);
  const bool partial = !binding_->shares.empty() || (binding_->tiles && !binding_->tiles->shares.empty());
  state_.keep_origin(mask_ || partial);
  for_engines([&](Engine& engine) { engine.set_mask(all_mask_); });
}

void FrameDeformer::set_shape(const weights::SharedShape& shape) {
  if (shape == shape_) return;
  shape_ = shape;
  displacements_ = weights::displacements_of(
      binding_->tip_step > 0 ? with_tips(shape, binding_->tip_step) : shape, *binding_->rest);
  if (shape && !follower_ && ShapeFollower::is_for(deformer_))
    follower_ = std::make_unique<ShapeFollower>(cage_);
  show_displacements(displacements_);
}

void FrameDeformer::show_displacements(std::span<const Vec3> displacements) {
  shown_displacements_ = displacements;
  for_engines([&](Engine& engine) { engine.set_shape(displacements); });
}

void FrameDeformer::set_probes(const pose::Probes& probes) {
  layer_.set(probes, all_mask_);
}

void FrameDeformer::set_splats(std::shared_ptr<const mesh::Splats> splats) {
  splats_.reset();
  if (splats) splats_.emplace(std::move(splats));
}

Engine& FrameDeformer::of(pose::EngineKind kind) const {
  switch (kind) {
    case pose::EngineKind::staged: return *staged_;
    case pose::EngineKind::fused: return *fused_;
    case pose::EngineKind::stitched: return *stitched_;
  }
  return *fused_;
}

void FrameDeformer::deform(const pose::Pose& pose, sym3::Method method) {
  const pose::EngineKind kind = engine(method).value_or(pose::EngineKind::fused);
  assert(kind != pose::EngineKind::fused || fused_);
  state_.set_pose(pose);
  if (follower_ && !displacements_.empty()) {
    follower_->set_pose(pose);
    show_displacements(follower_->followed(binding_, all_mask_, displacements_, pool_));
  }
  of(kind).set_layer(layer_.moves() ? &layer_ : nullptr);
  of(kind).run(state_, method);
  ran_ = kind;
  // If no probe moves the model, engines skip the layer. Therefore the probes follow the model here.
  if (!layer_.moves()) layer_.carry(positions_at(last().vertices(), layer_.anchors()), origin());
  if (!splats_) return;
  base::Stopwatch watch;
  splats_->run(last().vertices(), binding_->tip_step, pool_);
  splats_ms_ = watch.lap_ms();
}

std::span<const pose::FrameVertex> FrameDeformer::vertices() const {
  return ran_ ? last().vertices().first(binding_->model_vertices()) : std::span<const pose::FrameVertex>();
}

pose::StageTimes FrameDeformer::times() const {
  pose::StageTimes times;
  if (!ran_) return times;
  times += state_.times();
  times += last().times();
  times[pose::Stage::splats] = splats_ms_;
  return times;
}

std::vector<mesh::Point> FrameDeformer::positions() const {
  const auto own = [this](const auto& all) { return all.first(binding_->model_vertices()); };
  if (ran_ == pose::EngineKind::staged) return copied(own(std::span(staged_->positions())));
  std::vector<mesh::Point> all;
  if (ran_ == pose::EngineKind::stitched && !layer_.moves()) {
    for (const Vec3& p : own(std::span(stitched_->positions()))) all.push_back(origin() + p);
    return all;
  }
  for (const pose::FrameVertex& v : vertices())
    all.push_back(origin() + Vec3{v.position[0], v.position[1], v.position[2]});
  return all;
}

std::vector<mesh::Point> FrameDeformer::normals() const {
  if (ran_ == pose::EngineKind::staged)
    return copied(std::span(staged_->normals()).first(binding_->model_vertices()));
  std::vector<mesh::Point> all;
  for (const pose::FrameVertex& v : vertices()) all.push_back(base::unpack_normal(v.normal));
  return all;
}

std::vector<sym3::Sym3<double>> FrameDeformer::sample_matrices(std::size_t limit) const {
  return ran_ ? sample_stretches(weigher_, *binding_, all_mask_, state_.rows(), limit)
              : std::vector<sym3::Sym3<double>>();
}

double FrameDeformer::sampled_error() const {
  if (!ran_ || ran_ == pose::EngineKind::staged) return 0;
  const auto measured = [&](const ProbeLayer* layer, std::span<const Vec3> shown) {
    return deform::sampled_error(weigher_, *binding_, all_mask_, shown_displacements_, state_.rows(), layer,
                                 shown);
  };
  if (ran_ == pose::EngineKind::stitched) return measured(nullptr, stitched_->blended_sample());
  return measured(&layer_, positions_at(last().vertices(),
                                        weights::spread_vertices(binding_->vertices, weights::error_sample)));
}

}  // namespace viete::deform
