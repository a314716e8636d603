#include "workspace/frame_stats.h"

#include <utility>

#include "base/median.h"

namespace viete::workspace {

namespace {

constexpr double window_seconds = 0.5, refresh_seconds = 0.25;

bool is_busy(std::span<const FrameTimes> frames) {
  double wall = 0, waited = 0;
  for (const FrameTimes& frame : frames) {
    wall += frame.cost.wall;
    waited += frame.cost.wall - frame.cost.longest;
  }
  return waited > 0.25 * wall && waited > 5e-4 * static_cast<double>(frames.size());
}

}  // namespace

FrameTimes median_of(std::span<const FrameTimes> frames) {
  const auto median = [&](auto value) {
    std::vector<double> values;
    for (const auto& frame : frames) values.push_back(value(frame));
    return base::median(std::move(values));
  };
  FrameTimes result = frames.back();
  for (std::size_t i = 0; i < pose::stage_count; ++i)
    result.stages.ms[i] = median([i](const FrameTimes& f) { return f.stages.ms[i]; });
  for (const auto part : {&FrameTimes::upload, &FrameTimes::draw, &FrameTimes::panels, &FrameTimes::frame})
    result.*part = median([part](const FrameTimes& f) { return f.*part; });
  result.busy = is_busy(frames);
  return result;
}

void FrameStats::add(const FrameTimes& times) {
  const bool deformed = times.stages.total() > 0, first = deformed != drawing_.empty();
  if (deformed) drawing_.clear();
  const bool another = deformed && !deforming_.empty() && deforming_.back().method != times.method;
  if (another) deforming_.clear();
  std::vector<FrameTimes>& frames = deformed ? deforming_ : drawing_;
  frames.push_back(times);
  std::erase_if(frames, [&](const FrameTimes& frame) { return frame.when < times.when - window_seconds; });
  if (deforming_.empty() || (times.when < due_ && !first && !another)) return;
  due_ = times.when + refresh_seconds;
  median_ = median_of(frames);
  if (deformed) deforming_median_ = median_;
}

}  // namespace viete::workspace
