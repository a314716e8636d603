#include "app/view_model.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "scene/workspace/playing.h"
#include "sym3/reference.h"

namespace viete::app {

namespace {

// Falls back to the document's own pose if it fails.
scene::SharedPose other_pose(scene::Workspace& w) {
  try {
    return scene::pose_by_other_blending(w);
  } catch (const base::Error&) {
    return nullptr;
  }
}

}  // namespace

SideModel::Made SideModel::made_of(const scene::View& side, const scene::Workspace& w) {
  const Need need{w.document.has_cage() ? side.scheme : deform::no_motion(), side.method, w.view.same_path};
  return {need, w.document.revisions().pose, w.document.mask, side.other_blending};
}

bool SideModel::serves(const Need& need) const {
  if (!deformer_ || deformer_->scheme() != need.scheme) return false;
  return deformer_->all_staged() == need.staged && deformer_->engine(need.method).has_value();
}

void SideModel::forget() {
  binder_.cancel();
  deformer_.reset();
  bound_ = {};
  made_.reset(), refused_.reset();
  drag_ = {};
}

bool SideModel::is_due(const scene::View& side, const scene::Workspace& w, const LiveModel& first) const {
  if (!first.bound().binding || changes_rest(w)) return false;
  const Made wanted = made_of(side, w);
  return binder_.has_result() ||
         (made_ != wanted && refused_ != wanted.need && !binder_.running() && first.ran());
}

bool SideModel::follow(scene::View& side, scene::Workspace& w, const LiveModel& first, base::WorkerPool& pool,
                       bool wait) {
  const Bound& known = first.bound();
  if (!known.binding) return false;
  if (bound_.model != known.model || bound_.cage != known.cage) {
    forget();
    bound_ = known;
  }
  const Made wanted = made_of(side, w);
  const Need& need = wanted.need;
  if (auto result = binder_.poll(wait)) {
    side.problem = result->problem;
    if (result->value) {
      bound_ = *std::move(result->value);
      make_deformer(asked_.scheme, asked_.staged, pool);
      made_.reset();
    }
    if (asked_ == need && !serves(need)) refused_ = need;  // otherwise it has changed since: binds again
  }
  side.binding = binder_.running();
  const bool due = made_ != wanted && refused_ != need && !side.binding && !changes_rest(w);
  if (!due || !first.ran()) return false;
  const bool same_weights = bound_.binding->weighting == need.scheme.weighting;
  if (!serves(need) && same_weights) make_deformer(need.scheme, need.staged, pool);
  if (!serves(need)) {
    deformer_.reset(), made_.reset();
    asked_ = need;
    bind_for(need, known.model, known.cage, same_weights ? bound_ : known);
    side.binding = true;
    return false;
  }
  const auto& drag = w.interaction.drag;
  drag_.before(*deformer_, drag);
  const scene::SharedPose other = side.other_blending ? other_pose(w) : nullptr;
  const deform::Pose& pose = other ? other->cage : w.document.pose;
  base::Stopwatch watch;
  run(w.document, pose, other ? other->shape : w.document.shape, side.method);
  if (!side.other_blending) drag_.after(*deformer_, drag);  // another mix may move the whole cage
  side.stats.add({.when = base::wall_seconds(), .links = deformer_->times(), .frame = watch.lap_ms()});
  made_ = wanted;
  return true;
}

bool SideViews::follow(scene::Workspace& w, const LiveModel& first, bool wait) {
  const auto sides = w.split.sides();
  if (sides.empty()) {
    if (pool_) forget();
    return false;
  }
  if (!pool_) pool_ = std::make_unique<base::WorkerPool>();
  bool any = false;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    if (i >= sides.size())
      models_[i].forget();
    else
      any |= models_[i].follow(sides[i], w, first, *pool_, wait);
  }
  return any;
}

void SideViews::finish(scene::Workspace& w, const LiveModel& first) {
  while (is_due(w, first) || binding(w)) follow(w, first, true);
}

bool SideViews::measure(scene::Workspace& w) {
  constexpr double rest_seconds = 0.3;
  constexpr std::size_t sample = 256;
  if (!w.split.on() || base::wall_seconds() - measured_at_ < rest_seconds) return false;
  bool any = false;
  for (std::size_t i = 0; i < w.split.sides().size(); ++i) {
    const deform::Deformer* deformer = models_[i].deformer();
    if (!models_[i].ran() || measured_[i] == models_[i].frames()) continue;
    measured_[i] = models_[i].frames();
    scene::View& side = w.split.sides()[i];
    side.fused_error = deformer->sampled_error();
    side.exp_error.reset();
    for (const auto& matrix : deformer->sample_matrices(sample))
      side.exp_error =
          std::max(side.exp_error.value_or(0), sym3::relative_error(sym3::exp(matrix, side.method), matrix));
    any = true;
  }
  if (any) measured_at_ = base::wall_seconds();
  return any;
}

// Deformers must be destroyed before their pool.
void SideViews::forget() {
  for (SideModel& model : models_) model.forget();
  pool_.reset();
}

bool SideViews::is_due(const scene::Workspace& w, const LiveModel& first) const {
  for (std::size_t i = 0; i < w.split.sides().size(); ++i)
    if (models_[i].is_due(w.split.sides()[i], w, first)) return true;
  return !w.split.on() && pool_;
}

bool SideViews::binding(const scene::Workspace& w) const {
  for (std::size_t i = 0; i < w.split.sides().size(); ++i)
    if (models_[i].binding()) return true;
  return false;
}

}  // namespace viete::app
