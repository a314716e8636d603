#include "document/pin_posing.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.h"
#include "document/pose_edit.h"

namespace viete::document {

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
