#include "app/view_model.h"

#include <algorithm>

#include "base/clock.h"
#include "base/error.h"
#include "base/os.h"
#include "document/checks.h"
#include "document/edit.h"
#include "mesh/normals.h"
#include "pose/cage.h"
#include "pose/deformer.h"
#include "pose/maps.h"
#include "sym3/eigenvalues.h"
#include "sym3/exp.h"
#include "sym3/polar.h"
#include "sym3/small_matrices.h"
#include "weights/bind.h"
#include "weights/tiled_binding.h"
#include "workspace/playing.h"

namespace viete::app {

namespace {

std::shared_ptr<const weights::Binding> bind_draft(const std::shared_ptr<const mesh::Draft>& draft,
                                                   const pose::Cage& cage, const weights::TiledBinding& whole,
                                                   base::WorkerPool& pool, base::Progress& progress) {
  const auto slots = weights::slots_of(whole.leaves);
  const auto row = [&](std::uint32_t v, std::span<double> weights) {
    whole.kept_row(slots[draft->vertices[v]], weights);
  };
  progress.section(progress.done(), 1);
  auto tiles = std::make_shared<const weights::TiledBinding>(weights::bind_tiles(
      draft->surface, cage, whole.weighting, pool, weights::usual_tolerance, &progress, {}, row));
  const std::shared_ptr<const mesh::Surface> surface(draft, &draft->surface);
  return std::make_shared<const weights::Binding>(weights::with_tiles(surface, cage, std::move(tiles)));
}

// Returns the matrix, or only its rotation if the matrix is nearly singular, because drags invert the matrix.
sym3::Mat3<double> away_from_flat(const sym3::Mat3<double>& map) {
  constexpr double flattest = 0.05;
  const auto [rotation, stretch] = sym3::polar(map);
  const auto [least, middle, largest] = sym3::eigenvalues(stretch);
  return least > flattest * largest ? map : rotation;
}

// The document's pose with the other interpolation (linear or log space), or null on an error.
document::SharedPose other_pose(workspace::Workspace& w) {
  try {
    return workspace::pose_by_other_blending(w);
  } catch (const base::Error&) {
    return nullptr;
  }
}

}  // namespace

Bound bind(const Pair& pair, const pose::Deformer& deformer, sym3::Method method, const Bound& known,
           base::Progress& progress, const std::shared_ptr<const mesh::Draft>& draft) {
  using pose::EngineKind;
  const auto& [given, cage, splats] = pair;
  const double tip_step = splats ? deform::tip_step(*given, *cage, deform::tip_in_float) : 0;
  const auto model =
      splats ? std::make_shared<const mesh::Surface>(deform::with_tips(*given, tip_step)) : given;
  const auto with_tip_step = [&](weights::Binding binding) {
    binding.tip_step = tip_step;
    return std::make_shared<const weights::Binding>(std::move(binding));
  };
  const pose::Weighting& weighting = deformer.weighting;
  base::WorkerPool pool;
  const bool same = known.binding && known.model == given && known.cage == cage;
  const bool shared = same && known.binding->weighting == weighting;
  Bound bound{pair, shared ? known.binding : nullptr, same ? known.stitching : nullptr,
              shared ? known.draft : nullptr};
  auto& binding = bound.binding;
  const bool staged = pose::engine_for(deformer, method) == EngineKind::staged;
  if (!binding || !binding->tiles) {
    if (staged) progress.section(0, 0.5);
    binding =
        with_tip_step(weights::bind(model, *cage, weighting, EngineKind::fused, nullptr, pool, &progress));
  }
  if (staged && binding->weights.empty()) {
    progress.section(progress.done(), 1);
    binding = with_tip_step(
        weights::bind(model, *cage, weighting, EngineKind::staged, binding.get(), pool, &progress));
  }
  if (draft && !bound.draft) bound.draft = bind_draft(draft, *cage, *binding->tiles, pool, progress);
  if (deformer.stitched() && !bound.stitches(deformer)) {
    progress.section(progress.done(), 1);
    bound.stitching =
        std::make_shared<const deform::Stitching>(deform::stitch(*model, *cage, pool, deformer, &progress));
  }
  base::os::release_freed_memory();
  return bound;
}

LiveModel::Changed LiveModel::follow(workspace::Workspace& w, const std::shared_ptr<const mesh::Draft>& draft,
                                     Bound known) {
  model_draft_ = draft;
  const document::Document& document = w.document;
  const document::Revisions& now = document.revisions();
  const bool new_surfaces = std::exchange(surfaces_, now.surfaces) != now.surfaces;
  const bool new_cage = std::exchange(cage_revision_, now.cage) != now.cage;
  const bool new_weights = std::exchange(weights_, now.weights) != now.weights;
  if (new_surfaces || new_cage) follow_surfaces(w, std::move(known));
  if (new_surfaces || new_cage || new_weights) {
    binder_.cancel();
    given_up_.reset();
    const bool served = deformer_ && document.has_cage();
    if (served && deformer_->deformer().weighting != document.deformer().weighting) start_binding(document);
  }
  // Binds if a cage, probe or shape can move the model. While a cage is being generated, waits.
  if (!deformer_ && !binder_.running() && !w.jobs.making_cage.running && given_up_ != now.pose &&
      document.is_movable())
    start_binding(document);
  // If only the blend has changed, the weights stay valid.
  const pose::Deformer deformer = deformer_of(document);
  if (deformer_ && deformer_->deformer().weighting == deformer.weighting) follow_blend(deformer);
  // If the staged engine's weights, the stitching or the draft are missing, starts to compute the missing
  // data. Until then, the method is `fast`, without stitching.
  const bool lacks_draft = !bound_.draft && draft_of(document) && undrafted_ != bound_.binding;
  if (deformer_ && !binder_.running() && (!deformer_->engine(document.method()) || lacks_draft))
    start_binding(document);
  take_binding(w, false);
  w.jobs.binding = binder_.state();
  return {new_surfaces, new_cage};
}

// The document's cage, or the substitute if the document has no cage.
std::shared_ptr<const pose::Cage> LiveModel::cage_of(const document::Document& document) {
  if (document.has_cage()) return document.cage();
  if (!no_cage_) no_cage_ = std::make_shared<const pose::Cage>(pose::no_cage(document.model().bounds));
  return no_cage_;
}

pose::Deformer LiveModel::deformer_of(const document::Document& document) {
  return document.has_cage() ? document.deformer() : pose::no_motion();
}

void LiveModel::follow_blend(const pose::Deformer& deformer) {
  if (deformer_->deformer() == deformer) return;
  pose::Deformer bound = deformer_->deformer();
  bound.amounts = deformer.amounts;
  if (bound != deformer) return renew_deformer(deformer);
  deformer_->set_amounts(deformer.amounts);
  if (draft_) draft_->set_amounts(deformer.amounts);
}

// Discards all data computed from the old surfaces.
void LiveModel::follow_surfaces(workspace::Workspace& w, Bound bound) {
  binder_.cancel();
  deformer_.reset();
  draft_.reset();
  bound_ = {};
  no_cage_.reset();
  around_ = {};
  given_up_.reset();
  w.frame.notes.clear();
  w.frame.report = {};
  if (bound.binds(w.document)) install(w, std::move(bound));
}

void LiveModel::start_binding(const document::Document& document) {
  bind_for({deformer_of(document), document.method()},
           {document.model().surface, cage_of(document), document.model().splats}, bound_,
           document.has_cage() ? document::binding_plan(document, document.deformer().weighting)
                               : "Preparing the model for probes",
           draft_of(document));
}

void LiveModel::take_binding(workspace::Workspace& w, bool wait) {
  auto result = binder_.poll(wait);
  if (!result) return;
  if (!result->value) return stop_binding(w, result->problem, workspace::Severity::error);
  install(w, *std::move(result->value));
}

constexpr workspace::Concern of_cage{"bind", workspace::Scope::cage};

std::shared_ptr<const mesh::Draft> LiveModel::draft_of(const document::Document& document) {
  const bool moves = document.has_cage() && !document.deformer().stitched();
  return moves ? model_draft_ : nullptr;
}

void LiveModel::install(workspace::Workspace& w, Bound bound) {
  for (const auto& warning : bound.binding->warnings) w.messages.warn(warning, of_cage);
  w.messages.succeeded(of_cage.topic);
  bound_ = std::move(bound);
  renew_deformer(deformer_of(w.document));
}

void LiveModel::share(const std::shared_ptr<const weights::Binding>& binding) {
  if (bound_.binding && bound_.binding->tiles == binding->tiles) bound_.binding = binding;
}

void LiveModel::renew_deformer(const pose::Deformer& deformer) {
  make_deformer(deformer, pool_);
  draft_ = bound_.draft ? std::make_unique<deform::FrameDeformer>(bound_.cage, bound_.draft, deformer, pool_)
                        : nullptr;
  derived_.reset();
  drafted_.reset();
  unprepared_ = true;
}

void LiveModel::stop_binding(workspace::Workspace& w, const std::string& why, workspace::Severity severity) {
  binder_.cancel();
  undrafted_ = bound_.binding;  // does not bind the draft again
  document::Document& document = w.document;
  if (!deformer_) given_up_ = document.revisions().pose;  // binds again after the next change of the pose
  if (deformer_ && document.has_cage()) {
    pose::Deformer served = deformer_->deformer();
    if (!bound_.stitches(served)) served.iterations = 0;
    document::revert_deformer(document, served);
    weights_ = document.revisions().weights;  // prevents another binding
    if (!deformer_->engine(document.method())) document.put_method(sym3::Method::fast);
  }
  w.messages.say(severity, why, of_cage);
}

bool LiveModel::deforms(const document::Document& document) const {
  return deformer_ && derived_ != derived_of(document);
}

bool LiveModel::binding_is_due(const document::Document& document) const {
  return surfaces_ != document.revisions().surfaces || cage_revision_ != document.revisions().cage ||
         weights_ != document.revisions().weights || binder_.has_result();
}

bool LiveModel::deform(workspace::Workspace& w, workspace::FrameTimes& times) {
  prepared_ = false;
  if (!deformer_) return false;
  document::Document& document = w.document;
  const auto& drag = w.view.interaction.drag;
  if (!draft_ && drag_.before(*deformer_, drag)) derived_.reset();  // a complete frame after the drag
  const bool editing = changes_rest(w);
  if (editing) derived_ = derived_of(document);
  const bool deformed = !editing && deforms(document);
  if (deformed) {
    times.method = deformer_->engine(document.method()) ? document.method() : sym3::Method::fast;
    const auto cost = pool_.cost();
    deform_pose(document, document.pose(), document.shape(), times.method);
    times.cost = pool_.cost() - cost;
    take_carried(document);
    if (document.has_cage()) workspace::take_report(w, deformer_->state().report());
    times.stages = deformer_->times();
    derived_ = derived_of(document);
    prepared_ = std::exchange(unprepared_, false);
    if (prepared_) derived_.reset();
  }
  if (!draft_) drag_.after(*deformer_, drag);  // with a draft, drags do not deform the whole model
  return deformed;
}

bool LiveModel::shows_draft(const document::Document& document) const {
  return deforms(document) && drafted_ == derived_of(document);
}

bool LiveModel::deform_draft(workspace::Workspace& w, workspace::FrameTimes& times) {
  const document::Document& document = w.document;
  const bool plain = document.has_cage() && !document.kept_pose() && !document.mask() && !document.shape() &&
                     document.probes().all.empty();
  if (!draft_ || !derived_ || !plain || !draft_->engine(document.method())) return deform(w, times);
  if (!deforms(document) || shows_draft(document)) return false;
  draft_->deform(document.pose(), document.method());
  workspace::take_report(w, draft_->state().report());
  drafted_ = derived_of(document);
  return draft_news_ = true;
}

void LiveModel::take_carried(document::Document& document) {
  std::vector<document::Carried> carried;
  for (const mesh::Point& place : deformer_->probes().places()) {
    const pose::Probe& probe = document.probes().all[carried.size()];
    carried.push_back(probe.pin ? carried_pin(document, probe) : document::Carried{place});
  }
  document.put_carried(std::move(carried));
}

// Transforms the pin's target from the shape to the drawn model, with the matrix of map_at().
document::Carried LiveModel::carried_pin(const document::Document& document, const pose::Probe& probe) {
  const std::uint32_t v = probe.pin->vertex;
  const mesh::Surface& surface = *document.model().surface;
  if (around_.starts.empty()) around_ = mesh::vertex_triangles(surface.positions.size(), surface.triangles);
  document::Carried carried;
  const auto is_pin = [](const pose::Probe& p) { return p.pin.has_value(); };
  if (document.has_cage() || !std::ranges::all_of(document.probes().all, is_pin))
    carried.map = map_at(document, v);  // a cage or a probe deforms the shape
  const mesh::Vec3 off = probe.place - document::shape_of_vertex(document, v);
  carried.place = vertex(document, v) + pose::times(carried.map, off);
  return carried;
}

// Returns the matrix from the shape to the drawn model: the mean over a vertex's triangles, weighted by area.
sym3::Mat3<double> LiveModel::map_at(const document::Document& document, std::uint32_t v) const {
  sym3::Mat3<double> sum{};
  double area = 0;
  for (const std::uint32_t t : around_.of(v)) {
    std::array<mesh::Point, 3> shape, drawn;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t corner = document.model().surface->triangles[t][k];
      shape[k] = document::shape_of_vertex(document, corner);
      drawn[k] = vertex(document, corner);
    }
    const pose::RestBasis from = pose::rest_basis(shape, {0, 1, 2});
    const auto to = pose::triangle_basis(drawn, {0, 1, 2}, from.corner);
    const double share = mesh::norm(mesh::cross(from.u, from.v));
    sum = sym3::plus(sum, share, pose::linear_map(from, to.u, to.v, to.n));
    area += share;
  }
  return area > 0 ? away_from_flat(sym3::times(1 / area, sum)) : document::Carried{}.map;
}

mesh::Point LiveModel::vertex(const document::Document& document, std::size_t index) const {
  if (!ran()) return document.model().surface->positions[index];
  const auto& p = deformer_->vertices()[index].position;
  return deformer_->origin() + mesh::Point{p[0], p[1], p[2]};
}

SideModel::Made SideModel::made_of(const workspace::SplitView& side, const workspace::Workspace& w) {
  const Need need{w.document.has_cage() ? side.deformer : pose::no_motion(), side.method};
  return {need, w.document.revisions().pose, w.document.mask(), side.other_blending};
}

bool SideModel::serves(const Need& need) const {
  return deformer_ && deformer_->deformer() == need.deformer && deformer_->engine(need.method);
}

void SideModel::forget() {
  binder_.cancel();
  deformer_.reset();
  bound_ = {};
  made_.reset();
  refused_.reset();
  drag_ = {};
}

bool SideModel::is_due(const workspace::SplitView& side, const workspace::Workspace& w,
                       const LiveModel& first) const {
  return first.bound().binding && !changes_rest(w) &&
         (binder_.has_result() || lacks(made_of(side, w), first));
}

// True if another frame, or the binding that it needs, must be computed.
bool SideModel::lacks(const Made& wanted, const LiveModel& first) const {
  return made_ != wanted && refused_ != wanted.need && !binder_.running() && first.ran();
}

bool SideModel::follow(workspace::SplitView& side, workspace::Workspace& w, const LiveModel& first,
                       base::WorkerPool& pool, bool wait) {
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
      make_deformer(asked_.deformer, pool);
      made_.reset();
    }
    if (asked_ == need && !serves(need)) refused_ = need;  // binding has failed: does not try again
  }
  side.binding = binder_.running();
  if (changes_rest(w) || !lacks(wanted, first)) return false;
  const bool same_weights = bound_.binding->weighting == need.deformer.weighting;
  if (!serves(need) && same_weights) make_deformer(need.deformer, pool);
  if (!serves(need)) {
    deformer_.reset();
    made_.reset();
    asked_ = need;
    bind_for(need, known, same_weights ? bound_ : known);
    side.binding = true;
    return false;
  }
  const auto& drag = w.view.interaction.drag;
  drag_.before(*deformer_, drag);
  const document::SharedPose other = side.other_blending ? other_pose(w) : nullptr;
  const pose::Pose& pose = other ? other->cage : w.document.pose();
  base::Stopwatch watch;
  const auto cost = pool.cost();
  deform_pose(w.document, pose, other ? other->shape : w.document.shape(), side.method);
  if (!side.other_blending) drag_.after(*deformer_, drag);  // the other blending can move the whole cage
  side.stats.add({.when = base::wall_seconds(),
                  .stages = deformer_->times(),
                  .frame = watch.lap_ms(),
                  .cost = pool.cost() - cost});
  made_ = wanted;
  return true;
}

bool SideModels::follow(workspace::Workspace& w, const LiveModel& first, bool wait) {
  const auto sides = w.view.split.sides();
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

void SideModels::finish(workspace::Workspace& w, const LiveModel& first) {
  while (is_due(w, first) || binding(w)) follow(w, first, true);
}

bool SideModels::lacks_error(std::size_t i) const {
  return models_[i].ran() && measured_[i] != models_[i].frames();
}

double SideModels::measuring_in(const workspace::Workspace& w) const {
  constexpr double rest_seconds = 0.3;  // shortest interval between measurements
  for (std::size_t i = 0; i < w.view.split.sides().size(); ++i)
    if (lacks_error(i)) return base::seconds_until(measured_at_ + rest_seconds);
  return base::never;
}

bool SideModels::measure(workspace::Workspace& w) {
  constexpr std::size_t sample = 256;
  if (measuring_in(w) > 0) return false;
  for (std::size_t i = 0; i < w.view.split.sides().size(); ++i) {
    if (!lacks_error(i)) continue;
    const deform::FrameDeformer* deformer = models_[i].deformer();
    measured_[i] = models_[i].frames();
    workspace::SplitView& side = w.view.split.sides()[i];
    side.fused_error = deformer->sampled_error();
    side.exp_error.reset();
    for (const auto& matrix : deformer->sample_matrices(sample))
      side.exp_error =
          std::max(side.exp_error.value_or(0), sym3::relative_error(sym3::exp(matrix, side.method), matrix));
  }
  measured_at_ = base::wall_seconds();
  return true;
}

// Destroys FrameDeformers before their pool.
void SideModels::forget() {
  for (SideModel& model : models_) model.forget();
  pool_.reset();
}

bool SideModels::is_due(const workspace::Workspace& w, const LiveModel& first) const {
  for (std::size_t i = 0; i < w.view.split.sides().size(); ++i)
    if (models_[i].is_due(w.view.split.sides()[i], w, first)) return true;
  return !w.view.split.on() && pool_;
}

bool SideModels::binding(const workspace::Workspace& w) const {
  for (std::size_t i = 0; i < w.view.split.sides().size(); ++i)
    if (models_[i].binding()) return true;
  return false;
}

}  // namespace viete::app
