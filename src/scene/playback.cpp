#include "scene/playback.h"

#include <algorithm>
#include <cmath>

#include "base/error.h"
#include "scene/cage_editing.h"
#include "scene/command_conditions.h"
#include "scene/edit.h"
#include "scene/time_edit.h"
#include "scene/workspace.h"

namespace viete::scene {

namespace {

// That pose is there. Locked probes are no part of it.
bool is_there(const Workspace& w, const WholePose& pose) {
  if (w.document.has_cage() && !same_pose(pose.cage, real_pose(w.document))) return false;
  const auto& probes = w.document.probes.all;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const deform::ProbePose there = i < pose.probes.size() ? pose.probes[i] : deform::ProbePose{};
    if (!probes[i].locked && !(probes[i].pose == there)) return false;
  }
  return true;
}

// What is known of the motion is of this timeline.
bool is_of_now(const Workspace& w) {
  return w.playback.cage == w.document.cage && w.playback.timeline == w.document.timeline;
}

bool is_shown(const Workspace& w) {
  return w.playback.shown && is_there(w, *w.playback.shown);
}

// What the document's frame looks like, without a word about what was there.
void show_frame(Workspace& w, double frame) {
  w.document.frame = frame;
  if (const auto camera = camera_at(w.document.timeline, frame)) w.camera.set_pose(*camera);
  const auto animation = animation_of(w);
  if (!animation) return;
  end_mix(w.document);
  WholePose pose = animation->at(frame);
  put_whole_pose(w.document, pose);
  w.playback.shown = std::make_shared<const WholePose>(std::move(pose));
}

// An edit that changes the timeline changes what this frame looks like.
void follow_edits(Workspace& w) {
  Playback& p = w.playback;
  const unsigned long revision = w.document.history.revision();
  const bool moves_keys = w.time_view.drag.has_value();  // which is seen at once
  if (revision == p.seen_revision || (in_hand(w) && !moves_keys)) return;
  p.seen_revision = revision;
  const bool retimed = p.timeline != w.document.timeline;
  if (!animation_of(w)) {
    p.shown = nullptr;
    return;
  }
  if (p.auto_key && !retimed && !is_shown(w) && !is_there(w, p.animation->at(w.document.frame))) {
    try {
      add_key_to_edit(w.document, current_frame(w.document));
      p.seen_revision = w.document.history.revision();
    } catch (const base::Error& error) {
      w.messages.error(error.what(), {"key"});
    }
    animation_of(w);
  }
  if (is_there(w, p.animation->at(w.document.frame))) {
    p.shown = shared_pose(w.document);
  } else if (retimed && is_shown(w)) {
    show_frame(w, w.document.frame);
  } else {
    p.playing = false;
  }
}

void play(Workspace& w, double seconds) {
  const auto frame = played(w.document.timeline, w.document.frame, seconds, w.playback.backward);
  if (frame) return show_frame(w, *frame);
  show_frame(w, w.playback.backward ? w.document.timeline.first : w.document.timeline.last);
  stop_playing(w);
}

}  // namespace

std::shared_ptr<const Animation> animation_of(Workspace& w) {
  Playback& p = w.playback;
  const Document& document = w.document;
  if (is_editing_cage(document)) return nullptr;
  if (is_of_now(w) && (p.animation || p.timeline.keys.empty())) return p.animation;
  p.vectors.follow(document.cage);
  p.cage = document.cage;
  p.timeline = document.timeline;
  p.animation = p.timeline.keys.empty() ? nullptr : std::make_shared<const Animation>(p.timeline, p.vectors);
  return p.animation;
}

bool has_unkeyed_pose(const Workspace& w) {
  if (w.document.timeline.keys.empty() || is_editing_cage(w.document) || is_shown(w)) return false;
  const bool known = w.playback.animation && is_of_now(w);
  return !known || !is_there(w, w.playback.animation->at(w.document.frame));
}

void go_to_frame(Workspace& w, double frame) {
  if (in_hand(w) || is_editing_cage(w.document) || std::isnan(frame)) return;
  frame = std::clamp<double>(frame, Timeline::least_frame, Timeline::largest_frame);
  animation_of(w);
  if (has_unkeyed_pose(w) && differs_from_rest(w.document)) {
    w.document.history.record("go to another frame", snapshot_of(w.document));
    w.messages.info("The pose was in no key; undo leads back to it.");
  }
  show_frame(w, frame);
  w.playback.seen_revision = w.document.history.revision();
}

void go_to_key(Workspace& w, bool forward) {
  std::vector<int> frames;
  for (const PoseKey& key : w.document.timeline.keys) frames.push_back(key.frame);
  for (const CameraKey& key : w.document.timeline.cameras) frames.push_back(key.frame);
  if (frames.empty()) return;
  std::ranges::sort(frames);
  const double now = w.document.frame;
  if (forward) {
    const auto next = std::ranges::upper_bound(frames, now);
    return go_to_frame(w, next == frames.end() ? frames.front() : *next);
  }
  const auto here = std::ranges::lower_bound(frames, now);
  go_to_frame(w, here == frames.begin() ? frames.back() : *(here - 1));
}

void start_playing(Workspace& w) {
  Playback& p = w.playback;
  const Timeline& t = w.document.timeline;
  if (t.empty() || is_editing_cage(w.document) || in_hand(w)) return;
  p.playing = true;
  p.backward = false;
  const bool at_end = t.repeat == Repeat::once && w.document.frame >= t.last;
  const bool outside = w.document.frame < t.first || w.document.frame > t.last;
  go_to_frame(w, at_end || outside ? t.first : w.document.frame);
}

void stop_playing(Workspace& w) {
  if (!w.playback.playing) return;
  w.playback.playing = false;
  show_frame(w, std::round(w.document.frame));
}

void follow_time(Workspace& w, double seconds) {
  if (w.playback.playing && (in_hand(w) || is_editing_cage(w.document) || w.document.timeline.empty()))
    w.playback.playing = false;
  follow_edits(w);
  if (w.playback.playing) play(w, seconds);
}

}  // namespace viete::scene
