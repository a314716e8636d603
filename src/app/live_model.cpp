#include "app/live_model.h"

#include <utility>

#include "scene/binding_plan.h"
#include "scene/edit.h"
#include "scene/pose_notes.h"

namespace viete::app {

bool LiveModel::follow(scene::Workspace& workspace) {
  const scene::Document& document = workspace.document;
  const scene::Revisions& now = document.revisions;
  const bool new_surfaces = std::exchange(surfaces_, now.surfaces) != now.surfaces;
  const bool new_weights = std::exchange(weights_, now.weights) != now.weights;
  if (new_surfaces) follow_surfaces(workspace);
  if (new_surfaces || new_weights) follow_weights(document);
  // Other elements or another blend sum other rows over the same weights.
  if (deformer_ && deformer_->scheme().weighting == document.scheme.weighting) follow_blend(document.scheme);
  // The staged engine's weights are made when a method asks for them, and a stitching when a scheme does;
  // until then method `fast` serves, not stitched.
  if (deformer_ && !binder_.running() && !deformer_->engine(document.method)) start_binding(document);
  take_binding(workspace, false);
  follow_mask(document);
  workspace.binding = {binder_.running(), binding_text_, binder_.done(), binder_.seconds(),
                       binder_.seconds()};
  return new_surfaces;
}

void LiveModel::follow_mask(const scene::Document& document) {
  if (!deformer_ || deformer_->mask() == document.mask) return;
  deformer_->set_mask(document.mask);
  derived_.reset();
}

void LiveModel::follow_blend(const deform::Scheme& scheme) {
  if (deformer_->scheme() == scheme) return;
  deform::Scheme bound = deformer_->scheme();
  bound.amounts = scheme.amounts;
  if (bound != scheme) return make_deformer(scheme);
  deformer_->set_amounts(scheme.amounts);
  derived_.reset();
}

// Everything that was derived from the old ones goes.
void LiveModel::follow_surfaces(scene::Workspace& workspace) {
  binder_.cancel();
  deformer_.reset();
  bound_ = {};
  workspace.pose_notes.clear();
  if (Bound bound = files_.take_bound(); bound.binds(workspace.document))
    install(workspace, std::move(bound));
}

void LiveModel::follow_weights(const scene::Document& document) {
  binder_.cancel();
  const bool bound = deformer_ && deformer_->scheme().weighting == document.scheme.weighting;
  if (document.has_cage() && !bound) start_binding(document);
}

void LiveModel::start_binding(const scene::Document& document) {
  binding_text_ = scene::text(scene::binding_plan(document, document.scheme.weighting));
  binder_.start([model = document.model.surface, cage = document.cage, scheme = document.scheme,
                 method = document.method, known = bound_,
                 saved = files_.take_saved()](base::Progress& progress) {
    return bind(model, cage, scheme, method, known, saved, progress);
  });
}

void LiveModel::take_binding(scene::Workspace& workspace, bool wait) {
  auto result = binder_.poll(wait);
  if (!result) return;
  if (!result->value) return stop_binding(workspace, result->problem, scene::Severity::error);
  install(workspace, *std::move(result->value));
}

void LiveModel::install(scene::Workspace& workspace, Bound bound) {
  for (const auto& warning : bound.binding->warnings) workspace.messages.warn(warning);
  if (!bound.problem.empty()) workspace.messages.error(bound.problem);
  files_.keep_binding(bound);
  bound_ = std::move(bound);
  make_deformer(workspace.document.scheme);
  follow_mask(workspace.document);
}

void LiveModel::make_deformer(const deform::Scheme& scheme) {
  deformer_ = std::make_unique<deform::Deformer>(bound_.cage, bound_.binding, scheme, pool_,
                                                 bound_.stitches(scheme) ? bound_.stitching : nullptr);
  derived_.reset();
  unprepared_ = true;
  dragging_ = false;
}

void LiveModel::stop_binding(scene::Workspace& workspace, const std::string& why, scene::Severity severity) {
  binder_.cancel();
  scene::Document& document = workspace.document;
  if (deformer_) {
    deform::Scheme served = deformer_->scheme();
    if (!bound_.stitches(served)) served.iterations = 0;
    scene::give_up_scheme(document, served);
    weights_ = document.revisions.weights;  // they are those that are bound
    if (!deformer_->engine(document.method)) scene::set_method(document, sym3::Method::fast);
  }
  workspace.messages.say(severity, why);
}

void LiveModel::finish_binding(scene::Workspace& workspace) {
  follow(workspace);
  take_binding(workspace, true);
}

bool LiveModel::deforms(const scene::Document& document) const {
  return deformer_ && derived_ != Derived{document.revisions.pose, document.revisions.method};
}

bool LiveModel::is_due(const scene::Document& document) const {
  return surfaces_ != document.revisions.surfaces || weights_ != document.revisions.weights ||
         deforms(document) || (deformer_ && deformer_->mask() != document.mask);
}

bool LiveModel::deform(scene::Workspace& workspace, scene::FrameTimes& times) {
  prepared_ = false;
  if (!deformer_) return false;
  scene::Document& document = workspace.document;
  const auto& drag = workspace.interaction.drag;
  if (dragging_ && !drag) {
    deformer_->end_drag();
    derived_.reset();  // the frame at rest depends on the pose alone
  }
  const bool deformed = deforms(document);
  if (deformed) {
    deformer_->deform(document.pose,
                      deformer_->engine(document.method) ? document.method : sym3::Method::fast);
    scene::take_report(workspace, deformer_->state().report());
    times.links = deformer_->times();
    derived_ = {document.revisions.pose, document.revisions.method};
    ++frames_;
    prepared_ = std::exchange(unprepared_, false);
    if (prepared_) derived_.reset();
  }
  // From the next frame on: only what was deformed whole can be followed in parts.
  if (drag && !dragging_ && deformer_->ran()) deformer_->begin_drag(drag->vertices());
  dragging_ = drag.has_value();
  return deformed;
}

mesh::Point LiveModel::vertex(const scene::Document& document, std::size_t index) const {
  if (!deformer_ || !deformer_->ran()) return document.model.surface->positions[index];
  const auto& p = deformer_->vertices()[index].position;
  return mesh::operator+(deformer_->origin(), mesh::Point{p[0], p[1], p[2]});
}

}  // namespace viete::app
