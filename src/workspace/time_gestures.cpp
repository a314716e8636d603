#include "workspace/time_gestures.h"

#include <algorithm>
#include <cmath>
#include "base/error.h"
#include "document/time_edit.h"
#include "workspace/command_conditions.h"
#include "workspace/playing.h"

namespace viete::workspace {

namespace {

bool has_frame(const std::vector<int>& frames, int frame) {
  return std::ranges::binary_search(frames, frame);
}

void toggle_frame(std::vector<int>& frames, int frame) {
  const auto place = std::ranges::lower_bound(frames, frame);
  if (place != frames.end() && *place == frame) {
    frames.erase(place);
  } else {
    frames.insert(place, frame);
  }
}

void drag_keys(Workspace& w, TimeView::Drag& drag, double frame) {
  const int shift = std::clamp(static_cast<int>(std::lround(frame - drag.pressed)),
                               document::Timeline::least_frame - drag.frames.front(),
                               document::Timeline::largest_frame - drag.frames.back());
  if (shift == 0 && !drag.moved) return;
  std::vector<int> to;
  for (const int from : drag.frames) to.push_back(from + shift);
  move_keys(w.document, drag.before, drag.frames, to);
  drag.moved = true;
  w.view.time.selected = std::move(to);
}

void drag_box(Workspace& w, const TimeView::Drag& drag, double frame) {
  const auto [low, high] = std::minmax(drag.pressed, frame);
  std::vector<int> selected = drag.selected;
  for (const int key : key_frames(w.document.timeline()))
    if (key >= low && key <= high && !has_frame(selected, key)) toggle_frame(selected, key);
  w.view.time.selected = std::move(selected);
}

}  // namespace

std::vector<int> selected_keys(const Workspace& w) {
  std::vector<int> selected;
  std::ranges::set_intersection(w.view.time.selected, key_frames(w.document.timeline()),
                                std::back_inserter(selected));
  return selected;
}

std::vector<int> eased_keys(const Workspace& w) {
  std::vector<int> eased;
  const auto& keys = w.document.timeline().keys;
  for (const int frame : selected_keys(w))
    if (key_at(w.document.timeline(), frame) && frame != keys.back().frame) eased.push_back(frame);
  if (!eased.empty()) return eased;
  for (const document::PoseKey& key : keys)
    if (key.frame <= w.document.frame()) eased = {key.frame};
  return eased;
}

void press_keys(Workspace& w, double frame, std::optional<int> key, bool add) {
  TimeView& view = w.view.time;
  view.selected = selected_keys(w);
  if (!key) {
    if (!add) view.selected.clear();
    view.drag = TimeView::Drag{.what = TimeView::What::box, .pressed = frame, .selected = view.selected};
    return;
  }
  if (add) return toggle_frame(view.selected, *key);
  if (!has_frame(view.selected, *key)) view.selected = {*key};
  if (is_dragging(w)) return;
  view.drag = TimeView::Drag{.what = TimeView::What::keys,
                             .pressed = frame,
                             .before = w.document.timeline(),
                             .frames = view.selected};
}

void press_ruler(Workspace& w, double frame) {
  w.playback.playing = false;
  w.view.time.drag = TimeView::Drag{.what = TimeView::What::scrub, .pressed = frame};
  drag_time(w, frame);
}

void press_pan(Workspace& w, double frame) {
  w.view.time.drag = TimeView::Drag{.what = TimeView::What::pan, .pressed = frame, .seen = w.view.time.seen};
}

void drag_time(Workspace& w, double frame) {
  auto& drag = w.view.time.drag;
  if (!drag) return;
  switch (drag->what) {
    case TimeView::What::scrub: {
      const double whole = std::round(frame);
      if (whole != w.document.frame()) go_to_frame(w, whole);
      return;
    }
    case TimeView::What::keys: return drag_keys(w, *drag, frame);
    case TimeView::What::box: return drag_box(w, *drag, frame);
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
    w.view.time.selected = drag->frames;
  }
  if (drag->what == TimeView::What::pan) w.view.time.seen = drag->seen;
  if (drag->what == TimeView::What::box) w.view.time.selected = drag->selected;
  drag.reset();
}

}  // namespace viete::workspace
