#include "app/field_maker.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "deform/exact.h"
#include "deform/vertex_sample.h"
#include "document/elements.h"
#include "shapes/example_posing.h"

namespace viete::app {

namespace {

using analysis::Field, analysis::FieldValues, analysis::Source;

std::vector<mesh::Point> drawn_positions(const document::PosedModel& posed, const mesh::Surface& rest) {
  if (posed.vertices.size() != rest.positions.size()) return rest.positions;
  std::vector<mesh::Point> positions(rest.positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v) positions[v] = posed.at(rest, v);
  return positions;
}

class FrameInDouble {
public:
  FrameInDouble(const FrameInput& frame, base::Progress& progress)
      : frame_(frame),
        progress_(progress),
        deformer_(*frame.bound.model, frame.bound.cage, frame.deformer, frame.method, pool_,
                  deform::ExactDeformer::Weights::kept, frame.mask, &progress) {}

  std::vector<mesh::Point> positions(const pose::Pose& pose, const pose::Probes& probes) {
    return deformer_.deform(pose, probes, frame_.shape, &progress_).positions;
  }

private:
  const FrameInput& frame_;
  base::Progress& progress_;
  base::WorkerPool pool_{1};  // one thread, so that frames stay fast
  deform::ExactDeformer deformer_;
};

// Computes how strongly each vertex follows the selection: the displacement of the vertex divided by a small
// displacement of the selected elements. For selected pins, calls ExamplePosing::reach().
struct Influence {
  FrameInput frame;
  document::Selection selection;
  std::vector<std::uint32_t> vertices;  // cage vertices that move with the selection

  std::vector<double> shares(base::Progress& progress) const {
    std::vector<double> all(frame.bound.model->positions.size());
    const bool of_probes = selection.kind() == document::ElementKind::probe;
    if (of_probes ? selection.empty() : vertices.empty()) return all;
    if (of_probes && is_of_pins()) return of_pins();
    constexpr double small = 1e-4;
    const double step = small * mesh::bounds(frame.bound.model->positions).diagonal();
    FrameInDouble deformer(frame, progress);
    const auto before = deformer.positions(frame.pose, frame.probes);
    pose::Pose pose = frame.pose;
    pose::Probes probes = frame.probes;
    const mesh::Vec3 shift = step / std::sqrt(3.0) * mesh::Vec3{1, 1, 1};
    for (const auto v : vertices) pose.positions[v] = pose.positions[v] + shift;
    if (of_probes)
      for (const auto i : selection.indices()) {
        pose::ProbePose& moved = probes.all[i].pose;
        moved.move = moved.move + shift;
      }
    const auto after = deformer.positions(pose, probes);
    for (std::size_t v = 0; v < all.size(); ++v) all[v] = mesh::norm(after[v] - before[v]) / step;
    return all;
  }

private:
  bool is_of_pins() const {
    return std::ranges::all_of(selection.indices(),
                               [&](std::uint32_t i) { return frame.probes.all[i].pin.has_value(); });
  }

  std::vector<double> of_pins() const {
    base::WorkerPool pool(1);
    const shapes::ShapeSpace space(*frame.bound.model, pool);
    shapes::ExamplePosing posing(space, {}, pool);
    std::vector<shapes::PosingPin> pins;
    std::vector<std::size_t> moved;
    for (std::uint32_t i = 0; i < frame.probes.all.size(); ++i) {
      const auto& pin = frame.probes.all[i].pin;
      if (!pin) continue;
      if (selection.contains(i)) moved.push_back(pins.size());
      pins.push_back({pin->vertex, pin->pulls ? shapes::usual_pull : shapes::holding});
    }
    posing.set_pins(std::move(pins));
    return posing.reach(moved);
  }
};

void take(FieldValues&& made, const document::Document& document, workspace::FieldView& shown) {
  if (made.values.size() != document.model().surface->positions.size()) return;
  if (shown.holds_range && shown.values) {
    made.stats.low = shown.stats.low;
    made.stats.high = shown.stats.high;
    analysis::fit_counts(made.values, made.stats);
  }
  shown.stats = made.stats;
  shown.own_range = {made.stats.low, made.stats.high};
  shown.values = std::make_shared<const std::vector<float>>(std::move(made.values));
}

analysis::FieldInput input_of(const analysis::Strain& strain, sym3::Method method) {
  analysis::FieldInput input;
  input.strain = &strain;
  input.method = method;
  return input;
}

}  // namespace

FieldMaker::Key FieldMaker::key_of(const FieldSubject& s) {
  Key key{s.field, s.posed.frame, 0, s.posed.vertices.data(), s.document.model().surface.get(), s.method, {}};
  if (analysis::entry(s.field).source == Source::first) key.first = s.first.frame;
  if (s.field == Field::influence) key.selection = s.document.selection();
  return key;
}

bool FieldMaker::is_due(std::size_t view, const FieldSubject& s, const workspace::FieldView& shown) const {
  const View& v = views_[view];
  if (v.job.has_result()) return true;
  const Source source = analysis::entry(s.field).source;
  if (source == Source::nothing) return shown.values != nullptr;
  if (key_of(s) == v.key) return false;
  if (source == Source::surface || source == Source::first) return true;
  return !v.job.running() && s.model.ran();
}

bool FieldMaker::follow(std::size_t view, const FieldSubject& s, workspace::FieldView& shown, bool wait) {
  View& v = views_[view];
  const analysis::FieldEntry& entry = analysis::entry(s.field);
  bool news = false;
  if (auto result = v.job.poll(wait); result && v.key.field == s.field) {
    shown.problem = result->problem;
    if (result->value) {
      take(*std::move(result->value), s.document, shown);
    } else {
      shown.values.reset();
    }
    news = true;
  }
  if (!is_due(view, s, shown)) return news;
  v.key = key_of(s);
  if (entry.source == Source::nothing) {
    v.job.cancel();
    shown = {};
    return true;
  }
  if (shown.stats.field != s.field) {
    shown = {};
    shown.stats.field = s.field;
  }
  if (entry.source != Source::surface && entry.source != Source::first) {
    begin(v, s);
    return news;
  }
  const mesh::Surface& rest = *s.document.model().surface;
  const auto drawn = drawn_positions(s.posed, rest), first = drawn_positions(s.first, rest);
  if (!pool_) pool_ = std::make_unique<base::WorkerPool>();
  const auto strain = strain_of(s.document);
  analysis::FieldInput input = input_of(*strain, s.method);
  input.drawn = drawn;
  input.first = first;
  input.pool = pool_.get();
  take(analysis::measure(s.field, input), s.document, shown);
  return true;
}

void FieldMaker::begin(View& view, const FieldSubject& s) {
  const auto strain = strain_of(s.document);
  const Field field = s.field;
  const sym3::Method method = s.method;
  if (analysis::entry(field).source == Source::matrices) {
    const pose::Rows rows = s.model.deformer()->state().rows();
    return view.job.start([=, bound = s.model.bound(), mask = s.model.deformer()->mask(), form = rows.form,
                           origin = rows.origin,
                           values = std::vector(rows.values.begin(), rows.values.end())](
                              base::Progress& progress) {
      const weights::Weigher weigher(*bound.cage, bound.binding->weighting);
      const auto matrices = deform::sample_stretches(weigher, *bound.binding, mask, {form, values, origin},
                                                     bound.binding->model_vertices(), &progress);
      analysis::FieldInput input = input_of(*strain, method);
      input.matrices = matrices;
      input.progress = &progress;
      return analysis::measure(field, input);
    });
  }
  const FrameInput frame = s.model.input(s.document, method);
  if (field == Field::influence) {
    std::vector<std::uint32_t> vertices;
    if (s.document.selection().kind() != document::ElementKind::probe)
      vertices = document::moving_vertices(s.document);
    return view.job.start(
        [=, influence = Influence{frame, s.document.selection(), vertices}](base::Progress& progress) {
          const auto shares = influence.shares(progress);
          analysis::FieldInput input = input_of(*strain, method);
          input.shares = shares;
          return analysis::measure(field, input);
        });
  }
  view.job.start([=, drawn = drawn_positions(s.posed, *frame.bound.model)](base::Progress& progress) {
    const auto exact = FrameInDouble(frame, progress).positions(frame.pose, frame.probes);
    analysis::FieldInput input = input_of(*strain, method);
    input.drawn = drawn;
    input.exact = exact;
    return analysis::measure(field, input);
  });
}

void FieldMaker::finish(std::size_t view, const FieldSubject& s, workspace::FieldView& shown) {
  while (is_due(view, s, shown) || views_[view].job.running()) follow(view, s, shown, true);
}

void FieldMaker::forget() {
  for (View& view : views_) {
    view.job.cancel();
    view.key = {};
  }
}

std::shared_ptr<const analysis::Strain> FieldMaker::strain_of(const document::Document& document) {
  if (surface_ != document.model().surface) {
    surface_ = document.model().surface;
    strain_ = std::make_shared<const analysis::Strain>(*surface_);
  }
  return strain_;
}

}  // namespace viete::app
