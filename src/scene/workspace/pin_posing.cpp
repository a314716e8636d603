#include "scene/workspace/pin_posing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "scene/document/pose_edit.h"
#include "scene/document/probes.h"
#include "scene/document/shape_mix.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

namespace {

constexpr int most_steps = 24;    // after the hand has come to rest
constexpr double at_rest = 1e-5;  // a step that is none
constexpr double pull = 0.3;      // beside a stiffness of about 1 between neighbours

// From weights that go as far as the pins ask, to those that hardly go at all.
deform::PosingSettings settings_of(double freedom, bool has_examples) {
  return {.restraint = 1e-3 * std::pow(100, freedom), .freedom = has_examples ? freedom : 1};
}

// Poses that are shapes alone, of all of the model.
std::vector<SharedPose> examples_of(const Document& document) {
  std::vector<SharedPose> examples;
  for (const NamedPose& named : document.library.poses) {
    const bool moves_cage =
        document.has_cage() && named.pose->cage.positions != document.cage->surface.positions;
    if (named.pose->shape && named.part.empty() && !moves_cage) examples.push_back(named.pose);
  }
  return examples;
}

// Of the examples.
std::vector<double> weights_of(const Document& document, std::span<const SharedPose> examples) {
  std::vector<double> weights;
  for (const SharedPose& example : examples)
    weights.push_back(std::ranges::find(document.library.poses, example, &NamedPose::pose)->weight);
  return weights;
}

// The sliders say what the shape is.
bool is_mix(const Document& document) {
  const PoseLibrary& library = document.library;
  if (!library.mixes()) return !document.shape;
  return library.mixed && library.unmixed && !library.unmixed->shape &&
         same_shape(library.mixed->shape, document.shape);
}

}  // namespace

PinPosing::Pins PinPosing::pins_of(const Document& document) {
  Pins now;
  for (const deform::Probe& probe : document.probes.all) {
    if (!probe.pin) continue;
    now.pins.push_back(*probe.pin);
    now.targets.push_back(probe.place + probe.pose.move);
  }
  return now;
}

bool PinPosing::is_of_now(const Document& document) const {
  return posing_ && document.shape == shown_ && examples_of(document) == examples_;
}

void PinPosing::follow(Workspace& w) {
  Pins now = pins_of(w.document);
  const bool put = std::exchange(whole_, w.document.revisions().whole) != w.document.revisions().whole;
  const bool freed = std::exchange(freedom_, w.handling.freedom) != w.handling.freedom;
  const bool moved = now.targets != seen_.targets &&
                     std::ranges::equal(now.pins, seen_.pins, {}, &deform::Pin::vertex, &deform::Pin::vertex);
  seen_ = std::move(now);
  if (put) posing_.reset();
  if (put || seen_.pins.empty() || is_editing_cage(w.document)) {
    steps_left_ = 0;
    return;
  }
  if (moved || (freed && is_of_now(w.document))) steps_left_ = most_steps;
  if (steps_left_ == 0) return;
  try {
    step(w);
    w.messages.succeeded("pins");
  } catch (const base::Error& error) {
    steps_left_ = 0;
    posing_.reset();
    take_pins_along(w.document);
    seen_ = pins_of(w.document);
    w.messages.error(error.what(), {"pins"});
  }
}

void PinPosing::begin(Workspace& w) {
  if (!pool_) pool_ = std::make_shared<base::WorkerPool>();
  KnownVectors& known = w.playback.vectors;
  known.follow_model(w.document.model.surface);
  posing_.reset();
  space_ = known.shapes(*pool_);
  examples_ = examples_of(w.document);
  vectors_.clear(), set_.clear();
  deform::ShapeReport report;
  for (const SharedPose& example : examples_)
    vectors_.push_back(known.of(example->shape, nullptr, *pool_, report));
  begin_here(w);
}

// A shape that is no mix is an example itself.
void PinPosing::begin_here(Workspace& w) {
  const Document& document = w.document;
  std::vector<double> weights = weights_of(document, examples_);
  if (!is_mix(document) && document.shape) {
    deform::ShapeReport report;
    weights.assign(weights.size(), 0);
    weights.push_back(1);
    vectors_.push_back(w.playback.vectors.of(document.shape, nullptr, *pool_, report));
  }
  std::vector<const deform::LogVector*> vectors;
  for (const auto& vector : vectors_) vectors.push_back(vector.get());
  posing_ = std::make_shared<deform::ExamplePosing>(*space_, std::move(vectors), *pool_);
  posing_->begin(std::move(weights), document.shape ? *document.shape : space_->logs().rest());
}

void PinPosing::step(Workspace& w) {
  if (!is_of_now(w.document)) begin(w);
  if (set_ != seen_.pins) {
    constexpr double holds = std::numeric_limits<double>::infinity();
    std::vector<deform::PosingPin> pins;
    for (const deform::Pin& pin : seen_.pins) pins.push_back({pin.vertex, pin.pulls ? pull : holds});
    posing_->set_pins(std::move(pins));
    set_ = seen_.pins;
  }
  const double length = posing_->step(seen_.targets, settings_of(w.handling.freedom, !vectors_.empty()));
  show(w.document);
  if (w.interaction.drag) {
    steps_left_ = most_steps;
    return;
  }
  w.document.history.go_on();
  steps_left_ = length < at_rest ? 0 : steps_left_ - 1;
}

void PinPosing::show(Document& document) {
  std::vector<mesh::Point> positions(posing_->positions().begin(), posing_->positions().end());
  std::vector<deform::LogTerm> terms;
  for (const auto& vector : vectors_) terms.push_back({vector.get(), 1});
  keep_flat(space_->logs().rest(), terms, positions);
  shown_ = std::make_shared<const std::vector<mesh::Point>>(std::move(positions));
  document.put_posed_shape(shown_);
  PoseLibrary& library = document.library;
  for (std::size_t e = 0; e < examples_.size(); ++e)
    std::ranges::find(library.poses, examples_[e], &NamedPose::pose)->weight =
        std::clamp(posing_->weights()[e], PoseLibrary::least_weight, PoseLibrary::largest_weight);
  library.unmixed = library.mixed = nullptr;
}

}  // namespace viete::scene
