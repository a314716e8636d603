#include "deform/deformer.h"

#include <cassert>
#include <utility>

#include "deform/vertex_sample.h"

namespace viete::deform {

Deformer::Deformer(std::shared_ptr<const Cage> cage, std::shared_ptr<const Binding> binding,
                   const Scheme& scheme, base::WorkerPool& pool)
    : binding_(std::move(binding)),
      scheme_(scheme),
      state_(cage, scheme.weighting.elements, scheme.blend),
      weigher_(state_.cage(), binding_->weighting) {
  state_.set_amounts(scheme.amounts);
  const RowForm form = state_.rows().form;
  if (binding_->tiles) fused_ = std::make_unique<FusedEngine>(binding_->tiles, form, pool);
  if (!binding_->weights.empty()) staged_ = std::make_unique<StagedEngine>(binding_, form, pool);
}

std::optional<EngineKind> Deformer::engine(sym3::Method method) const {
  if (fused_ && (!scheme_.exponential() || method == sym3::Method::fast)) return EngineKind::fused;
  if (staged_) return EngineKind::staged;
  return std::nullopt;
}

void Deformer::set_amounts(const Amounts& amounts) {
  scheme_.amounts = amounts;
  state_.set_amounts(amounts);
}

void Deformer::deform(const Pose& pose, sym3::Method method) {
  const auto kind = engine(method);
  assert(kind);
  state_.set_pose(pose);
  Engine& chosen = *kind == EngineKind::fused ? static_cast<Engine&>(*fused_) : *staged_;
  chosen.run(state_, method);
  ran_ = kind;
}

const Engine& Deformer::last() const {
  return ran_ == EngineKind::fused ? static_cast<const Engine&>(*fused_) : *staged_;
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
  for (const FrameVertex& v : vertices())
    all.push_back(origin() + Vec3{v.position[0], v.position[1], v.position[2]});
  return all;
}

std::vector<mesh::Point> Deformer::normals() const {
  if (ran_ == EngineKind::staged) return {staged_->normals().begin(), staged_->normals().end()};
  std::vector<mesh::Point> all;
  for (const FrameVertex& v : vertices()) all.push_back({v.normal[0], v.normal[1], v.normal[2]});
  return all;
}

std::vector<sym3::Sym3<double>> Deformer::sample_matrices(std::size_t limit) const {
  return ran_ ? sample_stretches(weigher_, *binding_, state_.rows(), limit)
              : std::vector<sym3::Sym3<double>>();
}

double Deformer::sampled_error() const {
  if (ran_ != EngineKind::fused) return 0;
  return deform::sampled_error(weigher_, *binding_, state_.rows(), vertices());
}

}  // namespace viete::deform
