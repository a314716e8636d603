#include "workspace/time_view.h"

#include <algorithm>

namespace viete::workspace {

FrameWindow fitting(const document::Timeline& timeline) {
  int low = timeline.first, high = timeline.last;
  for (const int frame : key_frames(timeline)) {
    low = std::min(low, frame);
    high = std::max(high, frame);
  }
  const double margin = 0.03 * (high - low) + 0.5;
  return {low - margin, high + margin};
}

FrameWindow zoomed(const FrameWindow& seen, double share, double factor) {
  constexpr double largest = 2.0 * document::Timeline::largest_frame;
  const double length = std::clamp(seen.length() * factor, FrameWindow::least_length, largest);
  const double at = seen.frame_at(share);
  const double first = std::clamp(at - share * length, 1.5 * document::Timeline::least_frame,
                                  1.5 * document::Timeline::largest_frame);
  return {first, first + length};
}

int ruler_step(const FrameWindow& seen, double lines) {
  const double wish = seen.length() / std::max(1.0, lines);
  for (int power = 1; power <= 10'000'000; power *= 10)
    for (const int factor : {1, 2, 5})
      if (factor * power >= wish) return factor * power;
  return 10'000'000;
}

KeyPlaces key_places(const document::Timeline& timeline) {
  KeyPlaces places;
  for_each_track(timeline, [&](const auto& keys, const std::string& name) {
    for (const auto& key : keys) places.emplace_back(key.frame, name);
  });
  std::ranges::sort(places);
  places.erase(std::ranges::unique(places).begin(), places.end());
  return places;
}

std::vector<int> key_frames(const document::Timeline& timeline) {
  std::vector<int> frames;
  for (const document::KeyPlace& place : key_places(timeline)) frames.push_back(place.frame);
  frames.erase(std::ranges::unique(frames).begin(), frames.end());
  return frames;
}

}  // namespace viete::workspace
