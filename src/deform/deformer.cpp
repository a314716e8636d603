#include "deform/deformer.h"

#include <cassert>
#include <utility>

#include "deform/scheme.h"
#include "deform/vertex_sample.h"

namespace viete::deform {

namespace {

template <class Indices>
std::vector<Vec3> positions_at(std::span<const FrameVertex> vertices, const Indices& indices) {
  std::vector<Vec3> some;
  for (const auto i : indices) {
    const auto& p = vertices[i].position;
    some.push_back({p[0], p[1], p[2]});
  }
  return some;
}

}  // namespace

Deformer::Deformer(std::shared_ptr<const Cage> cage, std::shared_ptr<const Binding> binding,
                   const Scheme& scheme, base::WorkerPool& pool, std::shared_ptr<const Stitching> stitching)
    : cage_(cage),
      pool_(pool),
      binding_(std::move(binding)),
      scheme_(scheme),
      state_(cage, scheme.weighting.elements, scheme.blend),
      weigher_(state_.cage(), binding_->weighting),
      layer_(*binding_->rest, pool) {
  state_.set_amounts(scheme.amounts);
  const RowForm form = state_.rows().form;
  if (!binding_->weights.empty()) staged_ = std::make_unique<StagedEngine>(binding_, form, pool);
  if (scheme.stitched() && stitching && binding_->tiles) {
    stitched_ =
        std::make_unique<StitchedEngine>(binding_, std::move(stitching), form, scheme.iterations, pool);
  } else if (binding_->tiles) {
    fused_ = std::make_unique<FusedEngine>(binding_, form, pool);
  }
  set_mask(nullptr);
}

std::optional<EngineKind> Deformer::engine(sym3::Method method) const {
  const EngineKind wanted = engine_for(scheme_, method, all_staged_);
  if (wanted == EngineKind::stitched) return stitched_ ? std::optional(wanted) : std::nullopt;
  if (wanted == EngineKind::fused && fused_) return wanted;
  return staged_ ? std::optional(EngineKind::staged) : std::nullopt;
}

void Deformer::set_amounts(const Amounts& amounts) {
  scheme_.amounts = amounts;
  state_.set_amounts(amounts);
}

template <class Act>
void Deformer::for_engines(const Act& act) {
  if (staged_) act(*staged_);
  if (fused_) act(*fused_);
  if (stitched_) act(*stitched_);
}

void Deformer::set_mask(Mask mask) {
  mask_ = std::move(mask);
  layer_.set(layer_.probes(), mask_);
  const bool partial = !binding_->shares.empty() || (binding_->tiles && !binding_->tiles->shares.empty());
  state_.keep_origin(mask_ || partial);
  for_engines([&](Engine& engine) { engine.set_mask(mask_); });
}

void Deformer::set_shape(const SharedShape& shape) {
  if (shape == shape_) return;
  shape_ = shape;
  ways_ = ways_of(shape, *binding_->rest);
  if (shape && !follower_ && ShapeFollower::is_for(scheme_))
    follower_ = std::make_unique<ShapeFollower>(cage_);
  show_ways(ways_);
}

void Deformer::show_ways(std::span<const Vec3> ways) {
  shown_ways_ = ways;
  for_engines([&](Engine& engine) { engine.set_shape(ways); });
}

void Deformer::set_probes(const Probes& probes) {
  layer_.set(probes, mask_);
}

Engine& Deformer::of(EngineKind kind) const {
  switch (kind) {
    case EngineKind::staged: return *staged_;
    case EngineKind::fused: return *fused_;
    case EngineKind::stitched: return *stitched_;
  }
  return *fused_;
}

void Deformer::deform(const Pose& pose, sym3::Method method) {
  const EngineKind kind = engine(method).value_or(EngineKind::fused);
  assert(kind != EngineKind::fused || fused_);
  state_.set_pose(pose);
  if (follower_ && !ways_.empty()) {
    follower_->set_pose(pose);
    show_ways(follower_->followed(binding_, mask_, ways_, pool_));
  }
  of(kind).set_layer(layer_.moves() ? &layer_ : nullptr);
  of(kind).run(state_, method);
  ran_ = kind;
  // If no probe moves the model, engines skip the layer. Therefore the probes follow the model here.
  if (!layer_.moves()) layer_.carry(positions_at(vertices(), layer_.anchors()), origin());
}

std::span<const FrameVertex> Deformer::vertices() const {
  return ran_ ? last().vertices() : std::span<const FrameVertex>();
}

LinkTimes Deformer::times() const {
  LinkTimes times;
  if (!ran_) return times;
  times += state_.times();
  times += last().times();
  return times;
}

std::vector<mesh::Point> Deformer::positions() const {
  if (ran_ == EngineKind::staged) return {staged_->positions().begin(), staged_->positions().end()};
  std::vector<mesh::Point> all;
  if (ran_ == EngineKind::stitched && !layer_.moves()) {
    for (const Vec3& p : stitched_->positions()) all.push_back(origin() + p);
    return all;
  }
  for (const FrameVertex& v : vertices())
    all.push_back(origin() + Vec3{v.position[0], v.position[1], v.position[2]});
  return all;
}

std::vector<mesh::Point> Deformer::normals() const {
  if (ran_ == EngineKind::staged) return {staged_->normals().begin(), staged_->normals().end()};
  std::vector<mesh::Point> all;
  for (const FrameVertex& v : vertices()) all.push_back(base::unpack_normal(v.normal));
  return all;
}

std::vector<sym3::Sym3<double>> Deformer::sample_matrices(std::size_t limit) const {
  return ran_ ? sample_stretches(weigher_, *binding_, mask_, state_.rows(), limit)
              : std::vector<sym3::Sym3<double>>();
}

double Deformer::sampled_error() const {
  if (!ran_ || ran_ == EngineKind::staged) return 0;
  const auto measured = [&](const ProbeLayer* layer, std::span<const Vec3> shown) {
    return deform::sampled_error(weigher_, *binding_, mask_, shown_ways_, state_.rows(), layer, shown);
  };
  if (ran_ == EngineKind::stitched) return measured(nullptr, stitched_->blended_sample());
  return measured(&layer_, positions_at(vertices(), spread_vertices(binding_->vertices, error_sample)));
}

}  // namespace viete::deform
