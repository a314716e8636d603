#include "document/probes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "base/error.h"
#include "document/pose_edit.h"
#include "mesh/normals.h"
#include "mesh/point_tree.h"

namespace viete::document {

namespace {

constexpr double usual_radius = 0.2;  // relative to the model's diagonal

std::string label(const char* verb, const Document& document) {
  const std::size_t n = document.selection().size();
  return std::string(verb) + (n == 1 ? " a probe" : ' ' + std::to_string(n) + " probes");
}

// Records an edit. Returns the probes, which the caller then changes.
pose::Probes& edit(Document& document, const std::string& name) {
  record_edit(document, name);
  return document.changed_probes();
}

// Calls `change` for each selected probe that is not locked.
template <class Change>
void change_free(Document& document, const Change& change) {
  auto& all = document.changed_probes().all;
  for (const auto i : document.selection().indices())
    if (!all[i].locked) change(all[i]);
}

template <class Change>
void change_selected(Document& document, const std::string& name, const Change& change) {
  record_edit(document, name);
  change_free(document, change);
}

void select(Document& document, std::size_t first, std::size_t end) {
  std::vector<std::uint32_t> added;
  for (std::size_t i = first; i < end; ++i) added.push_back(static_cast<std::uint32_t>(i));
  document.changed_selection() = Selection(ElementKind::probe, added);
}

std::uint32_t nearest_vertex(const Document& document, const PosedModel& posed, const mesh::Point& at) {
  const mesh::Surface& model = *document.model().surface;
  double least = std::numeric_limits<double>::infinity();
  std::uint32_t nearest = 0;
  for (std::uint32_t v = 0; v < model.positions.size(); ++v) {
    const double distance = mesh::squared_norm(at - posed.at(model, v));
    if (distance < least) {
      least = distance;
      nearest = v;
    }
  }
  return nearest;
}

// Returns the rest position of a point near the displayed model: uses the offset from the nearest vertex.
mesh::Point at_rest(const Document& document, const PosedModel& posed, const mesh::Point& at) {
  const mesh::Surface& model = *document.model().surface;
  const std::uint32_t v = nearest_vertex(document, posed, at);
  return model.positions[v] + (at - posed.at(model, v));
}

pose::Probe probe_at(const Document& document, const mesh::Point& place) {
  pose::Probe probe;
  probe.place = place;
  probe.turn = probe.stretch =
      probe.move = {pose::Falloff::smooth, usual_radius * document.space().diagonal()};
  return probe;
}

pose::Probe pin_of(const Document& document, std::uint32_t vertex) {
  pose::Probe probe = probe_at(document, document.model().surface->positions[vertex]);
  probe.pin = pose::Pin{vertex};
  probe.pose.move = shape_of_vertex(document, vertex) - probe.place;
  return probe;
}

}  // namespace

bool add_probe(Document& document, const PosedModel& posed, const mesh::Point& at) {
  if (document.probes().all.size() >= most_probes) return false;
  const pose::Probe probe = probe_at(document, at_rest(document, posed, at));
  edit(document, "add probe").all.push_back(probe);
  document.put_carried({});
  select(document, document.probes().all.size() - 1, document.probes().all.size());
  return true;
}

bool add_pin(Document& document, const PosedModel& posed, const mesh::Point& at) {
  const std::uint32_t vertex = nearest_vertex(document, posed, at);
  auto& all = document.changed_probes().all;
  const auto pins_it = [&](const pose::Probe& p) { return p.pin && p.pin->vertex == vertex; };
  const auto found = static_cast<std::size_t>(std::ranges::find_if(all, pins_it) - all.begin());
  if (found == all.size()) {
    if (all.size() >= most_probes) return false;
    edit(document, "pin vertex").all.push_back(pin_of(document, vertex));
    document.put_carried({});
  }
  select(document, found, found + 1);
  return true;
}

bool has_pins(const Document& document) {
  return std::ranges::any_of(document.probes().all, [](const pose::Probe& p) { return p.pin.has_value(); });
}

void set_pulls(Document& document, bool pulls) {
  change_selected(document, pulls ? "make pins soft" : "make pins hard", [pulls](pose::Probe& p) {
    if (p.pin) p.pin->pulls = pulls;
  });
}

void remove_probes(Document& document) {
  auto& all = edit(document, label("remove", document)).all;
  const auto& selected = document.selection().indices();
  for (auto i = selected.rbegin(); i != selected.rend(); ++i) {
    if (all[*i].locked) continue;
    all.erase(all.begin() + *i);
    forget_probe(document, *i);
  }
  document.put_carried({});
  document.changed_selection().clear();
}

bool has_free_probes(const Document& document) {
  if (document.selection().kind() != ElementKind::probe) return false;
  return std::ranges::any_of(document.selection().indices(),
                             [&](auto i) { return !document.probes().all[i].locked; });
}

void rest_probes(Document& document) {
  change_selected(document, label("reset", document), [](pose::Probe& p) { p.pose = {}; });
}

int symmetry_axis(const Document& document) {
  constexpr std::size_t samples = 256;
  const auto& points = document.model().surface->positions;
  const mesh::PointTree tree(points, mesh::first_numbers(points.size()));
  const mesh::Point middle = document.model().bounds.center();
  std::array<double, 3> off{};
  for (std::size_t n = 0; n < samples; ++n) {
    const mesh::Point& p = points[n * points.size() / samples];
    for (std::size_t axis = 0; axis < 3; ++axis) {
      mesh::Point image = p;
      image[axis] = 2 * middle[axis] - p[axis];
      off[axis] += mesh::norm(points[tree.nearest(image)] - image);
    }
  }
  return static_cast<int>(std::ranges::min_element(off) - off.begin());
}

bool mirror_probes(Document& document, int axis) {
  const std::size_t before = document.probes().all.size();
  if (before + document.selection().size() > most_probes) return false;
  auto& all = edit(document, label("mirror", document)).all;
  const double middle = document.model().bounds.center()[static_cast<std::size_t>(axis)];
  for (const auto i : document.selection().indices()) all.push_back(pose::mirrored(all[i], axis, middle));
  for (std::size_t i = before; i < all.size(); ++i)
    if (all[i].pin) all[i] = pin_of(document, nearest_vertex(document, {}, all[i].place));
  document.put_carried({});
  select(document, before, all.size());
  return true;
}

void set_locked(Document& document, bool locked) {
  auto& all = edit(document, label(locked ? "lock" : "unlock", document)).all;
  for (const auto i : document.selection().indices()) all[i].locked = locked;
}

namespace {

std::string part_label(Part part) {
  return part == &pose::Probe::turn      ? "change rotation of probes"
         : part == &pose::Probe::stretch ? "change stretch of probes"
                                         : "change translation of probes";
}

}  // namespace

void set_falloff(Document& document, Part part, pose::Falloff falloff) {
  change_selected(document, part_label(part), [&](pose::Probe& p) { (p.*part).falloff = falloff; });
}

void set_radius(Document& document, Part part, double radius) {
  const std::string name = part_label(part) + " (radius)";
  const DocumentState* before = document.history().before_last();
  const std::size_t number = part == &pose::Probe::turn ? 0 : part == &pose::Probe::stretch ? 1 : 2;
  record_step(document, name, {EditKind::probe_radius, number},
              before && before->selection == document.selection());
  change_free(document, [&](pose::Probe& probe) { (probe.*part).radius = radius; });
}

void set_mix(Document& document, pose::ProbeMix mix) {
  if (document.probes().mix != mix) edit(document, "change combination of probes").mix = mix;
}

double least_probe_radius(const Document& document) {
  return 0.01 * document.space().diagonal();
}
double largest_probe_radius(const Document& document) {
  return 2 * document.space().diagonal();
}

namespace {

constexpr int most_steps = 24;    // the largest number of steps after a drag
constexpr double no_step = 1e-5;  // a shorter step ends the iteration

// Returns the named poses that have a shape and in which the cage is at rest.
std::vector<SharedPose> examples_of(const Document& document) {
  std::vector<SharedPose> examples;
  for (const NamedPose& named : document.library().poses) {
    const bool moves_cage =
        document.has_cage() && named.pose->cage.positions != document.cage()->surface.positions;
    if (named.pose->shape && !moves_cage) examples.push_back(named.pose);
  }
  return examples;
}

std::vector<double> weights_of(const Document& document, std::span<const SharedPose> examples) {
  std::vector<double> weights;
  for (const SharedPose& example : examples)
    weights.push_back(std::ranges::find(document.library().poses, example, &NamedPose::pose)->weight);
  return weights;
}

// True if the shape is the weighted sum of the examples.
bool is_mix(const Document& document) {
  const PoseSource& source = document.source();
  if (!document.library().mixes()) return !document.shape();
  return source.kind == PoseSource::Kind::mix && source.base && !source.base->shape &&
         same_shape(source.pose->shape, document.shape());
}

}  // namespace

PinPosing::Pins PinPosing::pins_of(const Document& document) {
  Pins now;
  for (const pose::Probe& probe : document.probes().all) {
    if (!probe.pin) continue;
    now.pins.push_back(*probe.pin);
    now.targets.push_back(probe.place + probe.pose.move);
  }
  return now;
}

bool PinPosing::is_current(const Document& document) const {
  return posing_ && document.shape() == shown_ && examples_of(document) == examples_;
}

bool PinPosing::follow(Document& document, VectorCache& vectors, const Hand& hand) {
  Pins now = pins_of(document);
  const bool put = std::exchange(whole_, document.revisions().whole) != document.revisions().whole;
  const bool freed = std::exchange(freedom_, hand.freedom) != hand.freedom;
  const bool moved = now.targets != seen_.targets &&
                     std::ranges::equal(now.pins, seen_.pins, {}, &pose::Pin::vertex, &pose::Pin::vertex);
  seen_ = std::move(now);
  if (put) posing_.reset();
  if (put || seen_.pins.empty() || is_editing_cage(document)) {
    steps_left_ = 0;
    return false;
  }
  if (moved || (freed && is_current(document))) steps_left_ = most_steps;
  if (steps_left_ == 0) return false;
  try {
    step(document, vectors, hand);
    return true;
  } catch (const base::Error&) {
    steps_left_ = 0;
    posing_.reset();
    move_pins_to_shape(document);
    seen_ = pins_of(document);
    throw;
  }
}

void PinPosing::begin(const Document& document, VectorCache& known) {
  if (!pool_) pool_ = std::make_shared<base::WorkerPool>();
  known.follow_model(document.model().surface);
  posing_.reset();
  space_ = known.shapes(*pool_);
  examples_ = examples_of(document);
  vectors_.clear();
  set_.clear();
  shapes::ShapeReport report;
  for (const SharedPose& example : examples_)
    vectors_.push_back(known.of(example->shape, nullptr, *pool_, report));
  begin_here(document, known);
}

// If the current shape is not a mix of the examples, adds the shape as an example with weight 1.
void PinPosing::begin_here(const Document& document, VectorCache& known) {
  std::vector<double> weights = weights_of(document, examples_);
  if (!is_mix(document) && document.shape()) {
    shapes::ShapeReport report;
    weights.assign(weights.size(), 0);
    weights.push_back(1);
    vectors_.push_back(known.of(document.shape(), nullptr, *pool_, report));
  }
  std::vector<const shapes::LogVector*> vectors;
  for (const auto& vector : vectors_) vectors.push_back(vector.get());
  posing_ = std::make_shared<shapes::ExamplePosing>(*space_, std::move(vectors), *pool_);
  posing_->begin(std::move(weights), document.shape() ? *document.shape() : space_->rest());
}

void PinPosing::step(Document& document, VectorCache& known, const Hand& hand) {
  if (!is_current(document)) begin(document, known);
  if (set_ != seen_.pins) {
    std::vector<shapes::PosingPin> pins;
    for (const pose::Pin& pin : seen_.pins)
      pins.push_back({pin.vertex, pin.pulls ? shapes::usual_pull : shapes::holding});
    posing_->set_pins(std::move(pins));
    set_ = seen_.pins;
  }
  // A larger restraint makes the weights change less.
  const double length = posing_->step(seen_.targets, {.restraint = 1e-3 * std::pow(100, hand.freedom),
                                                      .freedom = vectors_.empty() ? 1 : hand.freedom});
  show(document);
  if (hand.holds) {
    steps_left_ = most_steps;
    return;
  }
  document.changed_history().extend_last();
  steps_left_ = length < no_step ? 0 : steps_left_ - 1;
}

void PinPosing::show(Document& document) {
  std::vector<mesh::Point> positions(posing_->positions().begin(), posing_->positions().end());
  std::vector<shapes::LogTerm> terms;
  for (const auto& vector : vectors_) terms.push_back({vector.get(), 1});
  keep_flat(*space_, terms, positions);
  shown_ = std::make_shared<const std::vector<mesh::Point>>(std::move(positions));
  document.put_posed_shape(shown_);
  PoseLibrary& library = document.changed_library();
  for (std::size_t e = 0; e < examples_.size(); ++e)
    std::ranges::find(library.poses, examples_[e], &NamedPose::pose)->weight =
        std::clamp(posing_->weights()[e], PoseLibrary::least_weight, PoseLibrary::largest_weight);
  document.changed_source() = {PoseSource::Kind::pins, shared_pose(document)};
}

}  // namespace viete::document
