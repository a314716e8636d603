#include "workspace/time_view.h"

#include <algorithm>
#include <cmath>

#include "document/time_edit.h"
#include "workspace/playing.h"

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

void show_timeline(Workspace& w) {
  w.preferences.layout.timeline = true;
  w.view.time.seen = fitting(w.document.timeline());
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

namespace {

bool has_key(const KeyPlaces& keys, const document::KeyPlace& key) {
  return std::ranges::binary_search(keys, key);
}

void toggle_key(KeyPlaces& keys, const document::KeyPlace& key) {
  const auto place = std::ranges::lower_bound(keys, key);
  if (place != keys.end() && *place == key) {
    keys.erase(place);
  } else {
    keys.insert(place, key);
  }
}

void drag_keys(Workspace& w, TimeView::Drag& drag, double frame) {
  const int shift = std::clamp(static_cast<int>(std::lround(frame - drag.pressed)),
                               document::Timeline::least_frame - drag.keys.front().frame,
                               document::Timeline::largest_frame - drag.keys.back().frame);
  if (shift == 0 && !drag.moved) return;
  std::vector<int> to;
  w.view.time.selected = drag.keys;
  for (document::KeyPlace& key : w.view.time.selected) to.push_back(key.frame += shift);
  move_keys(w.document, drag.before, drag.keys, to);
  drag.moved = true;
}

void drag_box(Workspace& w, const TimeView::Drag& drag, double frame, std::span<const std::string> rows) {
  const auto [low, high] = std::minmax(drag.pressed, frame);
  KeyPlaces selected = drag.selected;
  for (const document::KeyPlace& key : key_places(w.document.timeline())) {
    const bool inside = key.frame >= low && key.frame <= high &&
                        (rows.empty() || std::ranges::find(rows, key.channel) != rows.end());
    if (inside && !has_key(selected, key)) toggle_key(selected, key);
  }
  w.view.time.selected = std::move(selected);
}

}  // namespace

KeyPlaces selected_keys(const Workspace& w) {
  KeyPlaces selected;
  std::ranges::set_intersection(w.view.time.selected, key_places(w.document.timeline()),
                                std::back_inserter(selected));
  return selected;
}

KeyPlaces eased_keys(const Workspace& w) {
  KeyPlaces eased;
  const KeyPlaces selected = selected_keys(w);
  const document::Timeline& timeline = w.document.timeline();
  for_each_track(timeline, [&](const auto& keys, const std::string& name) {
    for (const auto& key : keys)
      if constexpr (requires { key.easing; })
        if (&key != &keys.back() && has_key(selected, {key.frame, name})) eased.emplace_back(key.frame, name);
  });
  std::ranges::sort(eased);
  if (!eased.empty()) return eased;
  for (const document::PoseKey& key : timeline.keys)
    if (key.frame <= w.document.frame()) eased = {key.frame};
  return eased;
}

void press_keys(Workspace& w, double frame, const std::optional<document::KeyPlace>& key, bool add) {
  TimeView& view = w.view.time;
  view.selected = selected_keys(w);
  if (!key) {
    if (!add) view.selected.clear();
    view.drag = TimeView::Drag{.what = TimeView::What::box, .pressed = frame, .selected = view.selected};
    return;
  }
  if (add) return toggle_key(view.selected, *key);
  if (!has_key(view.selected, *key)) view.selected = {*key};
  if (is_dragging(w)) return;
  view.drag = TimeView::Drag{
      .what = TimeView::What::keys, .pressed = frame, .before = w.document.timeline(), .keys = view.selected};
}

void press_ruler(Workspace& w, double frame) {
  w.playback.playing = false;
  w.view.time.drag = TimeView::Drag{.what = TimeView::What::scrub, .pressed = frame};
  drag_time(w, frame);
}

void press_pan(Workspace& w, double frame) {
  w.view.time.drag = TimeView::Drag{.what = TimeView::What::pan, .pressed = frame, .seen = w.view.time.seen};
}

void drag_time(Workspace& w, double frame, std::span<const std::string> rows) {
  auto& drag = w.view.time.drag;
  if (!drag) return;
  switch (drag->what) {
    case TimeView::What::scrub: {
      const double whole = std::round(frame);
      if (whole != w.document.frame()) go_to_frame(w, whole);
      return;
    }
    case TimeView::What::keys: return drag_keys(w, *drag, frame);
    case TimeView::What::box: return drag_box(w, *drag, frame, rows);
    case TimeView::What::pan: {
      const double shift = drag->pressed - frame;
      w.view.time.seen = {drag->seen.first + shift, drag->seen.last + shift};
      return;
    }
  }
}

void release_time(Workspace& w) {
  w.view.time.drag.reset();
}

void cancel_time(Workspace& w) {
  auto& drag = w.view.time.drag;
  if (!drag) return;
  if (drag->what == TimeView::What::keys && drag->moved) {
    w.document.changed_timeline() = w.document.changed_history().drop_last().timeline;
    w.view.time.selected = drag->keys;
  }
  if (drag->what == TimeView::What::pan) w.view.time.seen = drag->seen;
  if (drag->what == TimeView::What::box) w.view.time.selected = drag->selected;
  drag.reset();
}

}  // namespace viete::workspace
