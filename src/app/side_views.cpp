#include "app/side_views.h"

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

SideModel::Made SideModel::made_of(const scene::SideView& side, const scene::Workspace& w) {
  const Need need{w.document.has_cage() ? side.scheme : deform::no_motion(), side.method, w.view.same_path};
  return {need, w.document.revisions().pose, w.document.mask, side.other_blending};
}

bool SideModel::serves(const Need& need) const {
  if (!deformer_ || deformer_->scheme() != need.scheme) return false;
  return deformer_->all_staged() == need.staged && deformer_->engine(need.method).has_value();
}

void SideModel::bind_for(const Need& need, const Bound& known) {
  asked_ = need;
  const sym3::Method method = need.staged ? sym3::Method::diag : need.method;
  const bool own = bound_.binding && bound_.binding->weighting == need.scheme.weighting;
  binder_.start([model = known.model, cage = known.cage, scheme = need.scheme, method,
                 known = own ? bound_ : known](base::Progress& progress) {
    return app::bind(model, cage, scheme, method, known, progress);
  });
}

void SideModel::install(const Need& need, base::WorkerPool& pool) {
  deformer_ = std::make_unique<deform::Deformer>(bound_.cage, bound_.binding, need.scheme, pool,
                                                 bound_.stitches(need.scheme) ? bound_.stitching : nullptr);
  deformer_->set_all_staged(need.staged);
  made_.reset();
  drag_ = {};
}

// The requirement may have changed since: then binds again.
void SideModel::take_binding(scene::SideView& side, const Need& need, base::WorkerPool& pool, bool wait) {
  auto result = binder_.poll(wait);
  if (!result) return;
  side.problem = result->problem;
  if (result->value) {
    bound_ = *std::move(result->value);
    install(asked_, pool);
  }
  if (asked_ == need && !serves(need)) refused_ = need;
}

// True if a frame can be computed now; otherwise starts binding.
bool SideModel::prepare(const Need& need, const Bound& known, base::WorkerPool& pool) {
  if (serves(need)) return true;
  if (bound_.binding->weighting == need.scheme.weighting) install(need, pool);
  if (serves(need)) return true;
  deformer_.reset();
  bind_for(need, known);
  return false;
}

void SideModel::forget() {
  binder_.cancel();
  deformer_.reset();
  bound_ = {};
  made_.reset(), refused_.reset();
  drag_ = {};
}

bool SideModel::is_due(const scene::SideView& side, const scene::Workspace& w, const LiveModel& first) const {
  if (!first.bound().binding || changes_rest(w)) return false;
  const Made wanted = made_of(side, w);
  return binder_.has_result() || (made_ != wanted && refused_ != wanted.need && !binder_.running() &&
                                  first.deformer() && first.deformer()->ran());
}

bool SideModel::follow(scene::SideView& side, scene::Workspace& w, const LiveModel& first,
                       base::WorkerPool& pool, bool wait) {
  const Bound& known = first.bound();
  if (!known.binding) return false;
  if (bound_.model != known.model || bound_.cage != known.cage) {
    forget();
    bound_ = known;
  }
  const Made wanted = made_of(side, w);
  take_binding(side, wanted.need, pool, wait);
  side.binding = binder_.running();
  const bool due = made_ != wanted && refused_ != wanted.need && !side.binding && !changes_rest(w);
  if (!due || !first.deformer() || !first.deformer()->ran()) return false;
  side.binding = !prepare(wanted.need, known, pool);
  if (side.binding) return false;
  const auto& drag = w.interaction.drag;
  drag_.before(*deformer_, drag);
  const scene::SharedPose other = side.other_blending ? other_pose(w) : nullptr;
  const deform::Pose& pose = other ? other->cage : w.document.pose;
  deformer_->set_mask(w.document.mask);
  deformer_->set_probes(w.document.probes);
  deformer_->set_shape(other ? other->shape : w.document.shape);
  base::Stopwatch watch;
  deformer_->deform(w.document.has_cage() ? pose : deform::rest_pose(*bound_.cage), side.method);
  if (!side.other_blending) drag_.after(*deformer_, drag);  // another mix may move the whole cage
  side.stats.add({.when = base::wall_seconds(), .links = deformer_->times(), .frame = watch.lap_ms()});
  made_ = wanted;
  ++frames_;
  return true;
}

bool SideViews::follow(scene::Workspace& w, const LiveModel& first, bool wait) {
  const auto& sides = w.split.sides;
  if (sides.empty()) {
    if (pool_) forget();
    return false;
  }
  if (!pool_) pool_ = std::make_unique<base::WorkerPool>();
  bool any = false;
  for (std::size_t i = 0; i < models_.size(); ++i) {
    if (i >= sides.size()) {
      models_[i].forget();
    } else if (models_[i].follow(w.split.sides[i], w, first, *pool_, wait)) {
      any = news_[i] = true;
    }
  }
  return any;
}

bool SideViews::follow(scene::Workspace& w, const LiveModel& first) {
  return follow(w, first, false);
}

void SideViews::finish(scene::Workspace& w, const LiveModel& first) {
  while (is_due(w, first) || binding(w)) follow(w, first, true);
}

bool SideViews::measure(scene::Workspace& w) {
  constexpr double rest_seconds = 0.3;
  constexpr std::size_t sample = 256;
  if (w.split.sides.empty() || base::wall_seconds() - measured_at_ < rest_seconds) return false;
  bool any = false;
  for (std::size_t i = 0; i < w.split.sides.size(); ++i) {
    const deform::Deformer* deformer = models_[i].deformer();
    if (!deformer || !deformer->ran() || measured_[i] == models_[i].frames()) continue;
    measured_[i] = models_[i].frames();
    scene::SideView& side = w.split.sides[i];
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
  for (std::size_t i = 0; i < w.split.sides.size(); ++i)
    if (models_[i].is_due(w.split.sides[i], w, first)) return true;
  return w.split.sides.empty() && pool_;
}

bool SideViews::binding(const scene::Workspace& w) const {
  for (std::size_t i = 0; i < w.split.sides.size(); ++i)
    if (models_[i].binding()) return true;
  return false;
}

}  // namespace viete::app
