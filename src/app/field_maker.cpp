#include "app/field_maker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "deform/exact.h"
#include "deform/example_posing.h"
#include "deform/vertex_sample.h"
#include "scene/document/elements.h"

namespace viete::app {

namespace {

using lab::Field, lab::FieldValues, lab::Source;

std::vector<mesh::Point> drawn_positions(const scene::PosedModel& posed, const mesh::Surface& rest) {
  if (posed.vertices.size() != rest.positions.size()) return rest.positions;
  std::vector<mesh::Point> positions(rest.positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = posed.at(rest, v);
  return positions;
}

// All that a job needs to deform the model once more.
struct Frame {
  std::shared_ptr<const mesh::Surface> model;
  std::shared_ptr<const deform::Cage> cage;
  deform::Scheme scheme;
  deform::Mask mask;
  deform::SharedShape shape;
  deform::Probes probes;
  deform::Pose pose;
  sym3::Method method;
};

Frame frame_of(const scene::Document& document, const LiveModel& model) {
  const deform::Deformer& deformer = *model.deformer();
  const auto& cage = model.bound().cage;
  return {document.model.surface,
          cage,
          deformer.scheme(),
          deformer.mask(),
          document.shape,
          document.probes,
          document.has_cage() ? document.pose : deform::rest_pose(*cage),
          document.method};
}

class FrameInDouble {
public:
  FrameInDouble(const Frame& frame, base::Progress& progress)
      : frame_(frame),
        progress_(progress),
        deformer_(*frame.model, frame.cage, frame.scheme, frame.method, pool_,
                  deform::ExactDeformer::Weights::kept, frame.mask, &progress) {}

  std::vector<mesh::Point> positions(const deform::Pose& pose, const deform::Probes& probes) {
    return deformer_.deform(pose, probes, frame_.shape, &progress_).positions;
  }

private:
  const Frame& frame_;
  base::Progress& progress_;
  base::WorkerPool pool_{1};  // beside the frames
  deform::ExactDeformer deformer_;
};

// How far each vertex goes when the selection goes a small way, over that way; of pins, when they do.
struct Influence {
  Frame frame;
  scene::Selection selection;
  std::vector<std::uint32_t> vertices;  // of the cage, that move

  std::vector<double> shares(base::Progress& progress) const {
    std::vector<double> all(frame.model->positions.size());
    const bool of_probes = selection.kind() == scene::ElementKind::probe;
    if (of_probes && is_of_pins()) return of_pins();
    if (of_probes ? selection.empty() : vertices.empty()) return all;
    constexpr double small = 1e-4;
    const double way = small * mesh::bounds(frame.model->positions).diagonal();
    FrameInDouble deformer(frame, progress);
    const auto before = deformer.positions(frame.pose, frame.probes);
    deform::Pose pose = frame.pose;
    deform::Probes probes = frame.probes;
    const mesh::Vec3 shift = way / std::sqrt(3.0) * mesh::Vec3{1, 1, 1};
    for (const auto v : vertices) pose.positions[v] = pose.positions[v] + shift;
    if (of_probes)
      for (const auto i : selection.indices()) {
        deform::ProbePose& moved = probes.all[i].pose;
        moved.move = moved.move + shift;
      }
    const auto after = deformer.positions(pose, probes);
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = mesh::norm(after[v] - before[v]) / way;
    return all;
  }

private:
  bool is_of_pins() const {
    return std::ranges::all_of(selection.indices(),
                               [&](std::uint32_t i) { return frame.probes.all[i].pin.has_value(); });
  }

  std::vector<double> of_pins() const {
    base::WorkerPool pool(1);
    const deform::ShapeSpace space(*frame.model, pool);
    deform::ExamplePosing posing(space, {}, pool);
    std::vector<deform::PosingPin> pins;
    std::vector<std::size_t> moved;
    for (std::uint32_t i = 0; i < frame.probes.all.size(); ++i) {
      const auto& pin = frame.probes.all[i].pin;
      if (!pin) continue;
      if (selection.contains(i)) moved.push_back(pins.size());
      pins.push_back({pin->vertex, pin->pulls ? deform::usual_pull : deform::holding});
    }
    posing.set_pins(std::move(pins));
    return posing.reach(moved);
  }
};

lab::FieldInput input_of(const lab::Strain& strain, sym3::Method method) {
  lab::FieldInput input;
  input.strain = &strain;
  input.method = method;
  return input;
}

}  // namespace

FieldMaker::Subject FieldMaker::subject_of(const scene::Workspace& w, const LiveModel& model) {
  Subject subject{scene::shown_field(w), model.frames(), w.view.deformed, {}};
  if (subject.field == Field::influence) subject.selection = w.document.selection;
  return subject;
}

bool FieldMaker::is_due(const scene::Workspace& w, const LiveModel& model) const {
  const Source source = lab::entry(scene::shown_field(w)).source;
  if (source == Source::nothing) return w.field.values != nullptr;
  if (subject_of(w, model) == subject_) return false;
  if (source == Source::surface) return true;
  return !job_.running() && model.deformer() && model.deformer()->ran();
}

bool FieldMaker::follow(scene::Workspace& w, const LiveModel& model, bool wait) {
  bool news = false;
  if (auto result = job_.poll(wait);
      result && result->value && result->value->stats.field == scene::shown_field(w)) {
    take(w, *std::move(result->value));
    news = true;
  }
  if (!is_due(w, model)) return news;
  subject_ = subject_of(w, model);
  const lab::FieldEntry& entry = lab::entry(subject_.field);
  if (entry.source == Source::nothing) {
    job_.cancel();
    w.field = {};
    surface_.reset(), strain_.reset(), pool_.reset();
    return true;
  }
  if (w.field.stats.field != subject_.field) w.field = {.stats = {.field = subject_.field}};
  if (entry.source != Source::surface) {
    begin(w, model);
    return news;
  }
  const auto drawn = drawn_positions(w.posed, *w.document.model.surface);
  if (!pool_) pool_ = std::make_unique<base::WorkerPool>();
  const auto strain = strain_of(w.document);
  lab::FieldInput input = input_of(*strain, w.document.method);
  input.drawn = drawn, input.pool = pool_.get();
  take(w, lab::measure(subject_.field, input));
  return true;
}

void FieldMaker::begin(const scene::Workspace& w, const LiveModel& model) {
  const auto strain = strain_of(w.document);
  const Field field = subject_.field;
  const sym3::Method method = w.document.method;
  if (lab::entry(field).source == Source::matrices) {
    const deform::Rows rows = model.deformer()->state().rows();
    return job_.start(
        [=, bound = model.bound(), mask = model.deformer()->mask(), form = rows.form, origin = rows.origin,
         values = std::vector(rows.values.begin(), rows.values.end())](base::Progress& progress) {
          const deform::Weigher weigher(*bound.cage, bound.binding->weighting);
          const auto matrices = deform::sample_stretches(
              weigher, *bound.binding, mask, {form, values, origin}, bound.binding->vertices, &progress);
          lab::FieldInput input = input_of(*strain, method);
          input.matrices = matrices, input.progress = &progress;
          return lab::measure(field, input);
        });
  }
  const Frame frame = frame_of(w.document, model);
  if (field == Field::influence) {
    std::vector<std::uint32_t> vertices;
    if (w.document.selection.kind() != scene::ElementKind::probe) vertices = moving_vertices(w.document);
    return job_.start(
        [=, influence = Influence{frame, w.document.selection, vertices}](base::Progress& progress) {
          const auto shares = influence.shares(progress);
          lab::FieldInput input = input_of(*strain, method);
          input.shares = shares;
          return lab::measure(field, input);
        });
  }
  job_.start([=, drawn = drawn_positions(w.posed, *w.document.model.surface)](base::Progress& progress) {
    const auto exact = FrameInDouble(frame, progress).positions(frame.pose, frame.probes);
    lab::FieldInput input = input_of(*strain, method);
    input.drawn = drawn, input.exact = exact;
    return lab::measure(field, input);
  });
}

void FieldMaker::take(scene::Workspace& w, FieldValues&& made) {
  if (made.values.size() != w.document.model.surface->positions.size()) return;
  if (w.field.holds_range && w.field.values) {
    made.stats.low = w.field.stats.low, made.stats.high = w.field.stats.high;
    lab::fit_counts(made.values, made.stats);
  }
  w.field.stats = made.stats;
  w.field.values = std::make_shared<const std::vector<float>>(std::move(made.values));
}

void FieldMaker::finish(scene::Workspace& w, const LiveModel& model) {
  while (is_due(w, model) || job_.running()) follow(w, model, true);
}

void FieldMaker::forget() {
  job_.cancel();
  subject_ = {};
}

bool FieldMaker::has_news(const scene::Workspace& w, const LiveModel& model) const {
  return job_.has_result() || is_due(w, model);
}

std::shared_ptr<const lab::Strain> FieldMaker::strain_of(const scene::Document& document) {
  if (surface_ != document.model.surface) {
    surface_ = document.model.surface;
    strain_ = std::make_shared<const lab::Strain>(*surface_);
  }
  return strain_;
}

}  // namespace viete::app
