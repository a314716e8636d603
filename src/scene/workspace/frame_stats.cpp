#include "scene/workspace/frame_stats.h"

#include <algorithm>
#include <utility>

#include "base/median.h"

namespace viete::scene {

namespace {

constexpr std::size_t history_limit = 240;
constexpr double window_seconds = 0.5;

template <class Value>
double median_of(const std::vector<const FrameTimes*>& frames, Value value) {
  std::vector<double> values;
  values.reserve(frames.size());
  for (const auto* frame : frames) values.push_back(value(*frame));
  return base::median(std::move(values));
}

FrameTimes recent_median(const std::deque<FrameTimes>& frames) {
  std::vector<const FrameTimes*> recent;
  for (const auto& frame : frames) {
    if (frame.when >= frames.back().when - window_seconds) recent.push_back(&frame);
  }
  FrameTimes result;
  result.when = frames.back().when;
  for (std::size_t i = 0; i < deform::link_count; ++i) {
    result.links.ms[i] = median_of(recent, [i](const FrameTimes& f) { return f.links.ms[i]; });
  }
  result.upload = median_of(recent, [](const FrameTimes& f) { return f.upload; });
  result.draw = median_of(recent, [](const FrameTimes& f) { return f.draw; });
  result.panels = median_of(recent, [](const FrameTimes& f) { return f.panels; });
  result.frame = median_of(recent, [](const FrameTimes& f) { return f.frame; });
  return result;
}

}  // namespace

void FrameStats::add(const FrameTimes& times) {
  const bool deformed = times.links.total() > 0;
  if (deformed) since_.clear();
  std::deque<FrameTimes>& frames = deformed ? history_ : since_;
  frames.push_back(times);
  if (frames.size() > history_limit) frames.pop_front();
}

std::optional<FrameTimes> FrameStats::median() const {
  if (history_.empty()) return std::nullopt;
  return recent_median(since_.empty() ? history_ : since_);
}

std::optional<FrameTimes> FrameStats::deforming_median() const {
  if (history_.empty()) return std::nullopt;
  return recent_median(history_);
}

}  // namespace viete::scene
