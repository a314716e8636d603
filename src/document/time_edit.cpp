#include "document/time_edit.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/error.h"

namespace viete::document {

namespace {

constexpr double whole_turn = 2 * std::numbers::pi;

void check_frame(int frame) {
  if (frame < Timeline::least_frame || frame > Timeline::largest_frame)
    throw base::Error("", "frame " + std::to_string(frame) + " is out of range",
                      "choose a frame from " + std::to_string(Timeline::least_frame) + " to " +
                          std::to_string(Timeline::largest_frame));
}

bool among(std::span<const KeyPlace> places, const KeyPlace& place) {
  return std::ranges::find(places, place) != places.end();
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

template <class Key>
void move_in(std::vector<Key>& keys, const std::string& name, std::span<const KeyPlace> places,
             std::span<const int> to) {
  std::vector<Key> moved;
  std::erase_if(keys, [&](const Key& key) {
    const auto found = std::ranges::find(places, KeyPlace(key.frame, name));
    if (found == places.end()) return false;
    moved.push_back(key);
    moved.back().frame = to[static_cast<std::size_t>(found - places.begin())];
    return true;
  });
  for (Key& key : moved) key_for(keys, key.frame) = key;
}

}  // namespace

int current_frame(const Document& document) {
  return static_cast<int>(std::lround(document.frame()));
}

Timeline with_weight_key(Timeline timeline, const NamedPose& named, int frame, double weight) {
  check_frame(frame);
  auto channel = std::ranges::find(timeline.channels, named.name, &Channel::name);
  if (channel == timeline.channels.end())
    channel = timeline.channels.insert(channel, {named.name, named.pose});
  key_for(channel->keys, frame).weight =
      std::clamp(weight, -Channel::largest_weight, Channel::largest_weight);
  include(timeline, frame);
  return timeline;
}

Timeline with_key(const Document& document, int frame, std::span<const double> weights,
                  VectorCache* vectors) {
  check_frame(frame);
  Timeline timeline = document.timeline();
  const auto& poses = document.library().poses;
  PoseLibrary keyed = document.library(), others = keyed;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double weight = weights.empty() ? poses[i].weight : weights[i];
    const bool has_channel = channel_of(timeline, poses[i].name) != nullptr;
    keyed.poses[i].weight = has_channel ? weight : 0;
    others.poses[i].weight = has_channel ? 0 : weight;
    if (has_channel && weight_at(document.timeline(), poses[i].name, frame) != weight)
      timeline = with_weight_key(std::move(timeline), poses[i], frame, weight);
  }
  VectorCache own;
  PoseKey& key = key_for(timeline.keys, frame);
  key.pose = pose_without(document, vectors ? *vectors : own, keyed);
  key.mix = mixed_poses(others);
  include(timeline, frame);
  return timeline;
}

void set_key(Document& document, int frame, std::span<const double> weights, VectorCache* vectors) {
  put_timeline(document, with_key(document, frame, weights, vectors), "set key");
}

void set_weight_key(Document& document, std::size_t pose, int frame, double weight) {
  const NamedPose& named = document.library().poses[pose];
  put_timeline(document, with_weight_key(document.timeline(), named, frame, weight),
               "set key of " + named.name);
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

void remove_keys(Document& document, std::span<const KeyPlace> places) {
  Timeline timeline = document.timeline();
  for_each_track(timeline, [&](auto& keys, const std::string& name) {
    std::erase_if(keys, [&](const auto& key) { return among(places, {key.frame, name}); });
  });
  std::erase_if(timeline.channels, [](const Channel& channel) { return channel.keys.empty(); });
  if (timeline != document.timeline()) put_timeline(document, std::move(timeline), "delete keys");
}

void move_keys(Document& document, const Timeline& before, std::span<const KeyPlace> places,
               std::span<const int> to) {
  for (const int frame : to) check_frame(frame);
  const DocumentState* last = document.history().before_last();
  record_step(document, "move keys", {EditKind::keys}, last && last->timeline == before);
  Timeline timeline = before;
  for_each_track(timeline, [&](auto& keys, const std::string& name) { move_in(keys, name, places, to); });
  for (const int frame : to) include(timeline, frame);
  document.changed_timeline() = std::move(timeline);
}

void set_easing(Document& document, std::span<const KeyPlace> places, Easing easing) {
  Timeline timeline = document.timeline();
  for_each_track(timeline, [&](auto& keys, const std::string& name) {
    for (auto& key : keys)
      if constexpr (requires { key.easing; })
        if (among(places, {key.frame, name})) key.easing = easing;
  });
  if (timeline != document.timeline()) put_timeline(document, std::move(timeline), "change easing");
}

std::optional<Easing> easing_at(const Timeline& timeline, const KeyPlace& place) {
  const auto easing_of = [](const auto* key) { return key ? std::optional(key->easing) : std::nullopt; };
  if (place.channel.empty()) return easing_of(key_at(timeline, place.frame));
  const Channel* channel = channel_of(timeline, place.channel);
  return channel ? easing_of(key_at(channel->keys, place.frame)) : std::nullopt;
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
