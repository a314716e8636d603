#include "app/side_views.h"

#include <algorithm>
#include <utility>

#include "base/clock.h"
#include "base/error.h"
#include "scene/workspace/playing.h"
#include "sym3/reference.h"

namespace viete::app {

namespace {

// Where it cannot be made, the document's own serves.
scene::SharedPose other_pose(scene::Workspace& w) {
  try {
    return scene::pose_by_other_lines(w);
  } catch (const base::Error&) {
    return nullptr;
  }
}

}  // namespace

SideModel::Made SideModel::made_of(const scene::SideView& side, const scene::Workspace& w) {
  return {w.document.revisions().pose,
          w.document.has_cage() ? side.scheme : deform::no_motion(),
          side.method,
          w.document.mask,
          w.view.same_path,
          side.other_lines};
}

bool SideModel::serves(const Made& made) const {
  if (!deformer_ || deformer_->scheme() != made.scheme) return false;
  return deformer_->all_staged() == made.staged && deformer_->engine(made.method).has_value();
}

void SideModel::bind_for(const Made& made, const Bound& known) {
  const sym3::Method method = made.staged ? sym3::Method::diag : made.method;
  const bool own = bound_.binding && bound_.binding->weighting == made.scheme.weighting;
  binder_.start([model = known.model, cage = known.cage, scheme = made.scheme, method,
                 known = own ? bound_ : known](base::Progress& progress) {
    return app::bind(model, cage, scheme, method, known, SavedBindings(), progress);
  });
}

void SideModel::install(const Made& made, base::WorkerPool& pool) {
  deformer_ = std::make_unique<deform::Deformer>(bound_.cage, bound_.binding, made.scheme, pool,
                                                 bound_.stitches(made.scheme) ? bound_.stitching : nullptr);
  deformer_->set_all_staged(made.staged);
  made_.reset();
  drag_ = {};
}

void SideModel::forget() {
  binder_.cancel();
  deformer_.reset();
  bound_ = {};
  made_.reset(), refused_.reset();
  drag_ = {};
}

bool SideModel::is_due(const scene::SideView& side, const scene::Workspace& w, const LiveModel& first) const {
  if (!first.bound().binding) return false;
  const Made wanted = made_of(side, w);
  return binder_.has_result() ||
         (made_ != wanted && refused_ != wanted && !binder_.running() && first.deformer()->ran());
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
  if (auto result = binder_.poll(wait)) {
    side.problem = result->problem;
    if (result->value) {
      bound_ = *std::move(result->value);
      install(wanted, pool);
    }
    if (!serves(wanted)) refused_ = wanted;
  }
  side.binding = binder_.running();
  if (made_ == wanted || refused_ == wanted || binder_.running() || !first.deformer()->ran()) return false;
  if (!serves(wanted)) {
    if (bound_.binding->weighting == wanted.scheme.weighting) install(wanted, pool);
    if (!serves(wanted)) {
      deformer_.reset();
      bind_for(wanted, known);
      side.binding = true;
      return false;
    }
  }
  const auto& drag = w.interaction.drag;
  drag_.before(*deformer_, drag);
  const scene::SharedPose other = side.other_lines ? other_pose(w) : nullptr;
  const deform::Pose& pose = other ? other->cage : w.document.pose;
  deformer_->set_mask(w.document.mask);
  deformer_->set_probes(w.document.probes);
  deformer_->set_shape(other ? other->shape : w.document.shape);
  base::Stopwatch watch;
  deformer_->deform(w.document.has_cage() ? pose : deform::rest_pose(*bound_.cage), side.method);
  drag_.after(*deformer_, drag);
  side.stats.add({.when = base::wall_seconds(), .links = deformer_->times(), .frame = watch.lap_ms()});
  made_ = wanted;
  ++frames_;
  return true;
}

scene::PosedModel SideModel::posed() const {
  if (!deformer_ || !deformer_->ran()) return {};
  return {deformer_->vertices(), deformer_->origin(), frames_};
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

// Deformers end before the pool that they use.
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
