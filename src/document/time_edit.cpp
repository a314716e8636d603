#include "document/time_edit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"
#include "document/record.h"

namespace viete::document {

namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

void check_frame(int frame) {
  if (frame < Timeline::least_frame || frame > Timeline::largest_frame)
    throw base::Error("", "frame " + std::to_string(frame) + " is out of range",
                      "choose a frame from " + std::to_string(Timeline::least_frame) + " to " +
                          std::to_string(Timeline::largest_frame));
}

bool among(std::span<const int> frames, int frame) {
  return std::ranges::find(frames, frame) != frames.end();
}

template <class Key>
Key& key_for(std::vector<Key>& keys, int frame) {
  const auto place = std::ranges::lower_bound(keys, frame, {}, &Key::frame);
  if (place != keys.end() && place->frame == frame) return *place;
  if (keys.size() >= Timeline::most_keys) throw base::Error("", "the timeline is full", "delete some keys");
  return *keys.insert(place, Key{frame});
}

void include(Timeline& timeline, int frame) {
  timeline.first = std::min(timeline.first, frame);
  timeline.last = std::max(timeline.last, frame);
}

void put_key(Timeline& timeline, int frame, const Document& document, std::span<const double> weights) {
  check_frame(frame);
  PoseKey& key = key_for(timeline.keys, frame);
  key.pose = shared_pose(document);
  key.mix = mixed_poses(document.library(), weights);
  include(timeline, frame);
}

template <class Key>
void move_in(std::vector<Key>& keys, std::span<const int> frames, std::span<const int> to) {
  std::vector<Key> moved;
  std::erase_if(keys, [&](const Key& key) {
    const auto found = std::ranges::find(frames, key.frame);
    if (found == frames.end()) return false;
    moved.push_back(key);
    moved.back().frame = to[static_cast<std::size_t>(found - frames.begin())];
    return true;
  });
  for (Key& key : moved) key_for(keys, key.frame) = key;
}

}  // namespace

int current_frame(const Document& document) {
  return static_cast<int>(std::lround(document.frame()));
}

void set_key(Document& document, int frame, std::span<const double> weights) {
  Timeline timeline = document.timeline();
  put_key(timeline, frame, document, weights);
  put_timeline(document, std::move(timeline), "set key");
}

void add_key_to_edit(Document& document, int frame) {
  put_key(document.changed_timeline(), frame, document, {});
  document.changed_history().extend_last();
}

void set_camera_key(Document& document, int frame, const CameraPose& camera) {
  check_frame(frame);
  Timeline timeline = document.timeline();
  CameraKey& key = key_for(timeline.cameras, frame);
  key.camera = camera;
  if (&key != &timeline.cameras.front()) {
    const float before = (&key)[-1].camera.yaw;
    key.camera.yaw = before + static_cast<float>(std::remainder(double(camera.yaw) - before, whole_turn));
  }
  include(timeline, frame);
  put_timeline(document, std::move(timeline), "set camera key");
}

void set_turntable(Document& document, const CameraPose& camera) {
  record_edit(document, "create turntable");
  Timeline& t = document.changed_timeline();
  const int middle = t.first + (t.last - t.first) / 2;
  t.cameras.clear();
  for (const int frame : {t.first, middle, t.last}) {
    if (!t.cameras.empty() && t.cameras.back().frame == frame) continue;
    CameraPose pose = camera;
    const double share = double(frame - t.first) / (t.last - t.first);
    pose.yaw = static_cast<float>(std::remainder(double(camera.yaw), whole_turn) + share * whole_turn);
    t.cameras.push_back({frame, pose});
  }
}

void remove_keys(Document& document, std::span<const int> frames) {
  Timeline timeline = document.timeline();
  const auto gone = [&](const auto& key) { return among(frames, key.frame); };
  if (std::erase_if(timeline.keys, gone) + std::erase_if(timeline.cameras, gone) > 0)
    put_timeline(document, std::move(timeline), "delete keys");
}

void move_keys(Document& document, const Timeline& before, std::span<const int> frames,
               std::span<const int> to) {
  for (const int frame : to) check_frame(frame);
  const DocumentState* last = document.history().before_last();
  record_step(document, "move keys", {EditKind::keys}, last && last->timeline == before);
  Timeline timeline = before;
  move_in(timeline.keys, frames, to);
  move_in(timeline.cameras, frames, to);
  for (const int frame : to) include(timeline, frame);
  document.changed_timeline() = std::move(timeline);
}

void set_easing(Document& document, std::span<const int> frames, Easing easing) {
  const auto changes = [&](const PoseKey& key) { return among(frames, key.frame) && key.easing != easing; };
  if (std::ranges::none_of(document.timeline().keys, changes)) return;
  record_edit(document, "change easing");
  for (PoseKey& key : document.changed_timeline().keys)
    if (among(frames, key.frame)) key.easing = easing;
}

void put_timeline(Document& document, Timeline timeline, const std::string& label) {
  record_edit(document, label);
  document.changed_timeline() = std::move(timeline);
}

void set_play(Document& document, const Playing& play) {
  if (play == document.timeline()) return;
  record_step(document, "change playback", {EditKind::play});
  Timeline& t = document.changed_timeline();
  static_cast<Playing&>(t) = play;
  t.first = std::clamp(play.first, Timeline::least_frame, Timeline::largest_frame - 1);
  t.last = std::clamp(play.last, t.first + 1, Timeline::largest_frame);
  // If the rate is NaN, uses the least rate.
  t.rate = std::min(std::max(Timeline::least_rate, play.rate), Timeline::largest_rate);
}

}  // namespace viete::document
