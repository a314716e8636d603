// The timeline: keys, easing, and playback settings.
#pragma once

#include <algorithm>
#include <compare>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/choice.h"
#include "document/camera.h"
#include "pose/cage.h"
#include "pose/probe.h"
#include "weights/binding.h"

namespace viete::document {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

using weights::SharedShape;

inline bool same_shape(const SharedShape& a, const SharedShape& b) {
  return a == b || (a && b && *a == *b);
}

/// The complete pose of a document: the cage, the probes and the model's shape. Missing probes are at rest.
struct WholePose {
  pose::Pose cage;
  std::vector<pose::ProbePose> probes;
  SharedShape shape{};

  pose::ProbePose probe(std::size_t i) const { return i < probes.size() ? probes[i] : pose::ProbePose{}; }
  friend bool operator==(const WholePose& a, const WholePose& b) {
    return a.cage.positions == b.cage.positions && a.cage.turns == b.cage.turns && a.probes == b.probes &&
           same_shape(a.shape, b.shape);
  }
};
/// A shared pose. Never null.
using SharedPose = std::shared_ptr<const WholePose>;

/// The interpolation from a key to the next key.
enum class Easing { smooth, constant_speed, hold };
std::span<const Choice> choices(Easing);

/// The behaviour after the last frame.
enum class Repeat { once, loop, ping_pong };
std::span<const Choice> choices(Repeat);

struct MixedPose {
  std::string name;
  double weight;

  friend bool operator==(const MixedPose&, const MixedPose&) = default;
};

struct PoseKey {
  int frame;
  SharedPose pose{};
  Easing easing = Easing::smooth;  ///< from this key to the next key
  std::vector<MixedPose> mix{};    ///< the named poses in the pose, except those edited later

  friend bool operator==(const PoseKey&, const PoseKey&) = default;
};

struct CameraKey {
  int frame;
  CameraPose camera{};

  friend bool operator==(const CameraKey&, const CameraKey&) = default;
};

/// A key of a named pose's weight.
struct WeightKey {
  int frame;
  double weight = 0;
  Easing easing = Easing::smooth;  ///< from this key to the next key

  friend bool operator==(const WeightKey&, const WeightKey&) = default;
};

/// The keyed weight of a named pose. The weighted pose is added to the pose of the keys.
struct Channel {
  static constexpr double largest_weight = 5;  ///< the largest absolute weight of a key

  std::string name;  ///< of the pose
  SharedPose pose{};
  std::vector<WeightKey> keys{};  ///< not empty; sorted by frame; one key per frame

  friend bool operator==(const Channel&, const Channel&) = default;
};

/// Identifies the pose key and the camera key of a frame or, with a name, a key of this named pose's weight.
struct KeyPlace {
  KeyPlace(int frame, std::string channel = {}) : frame(frame), channel(std::move(channel)) {}

  int frame;
  std::string channel;

  friend auto operator<=>(const KeyPlace&, const KeyPlace&) = default;
};
using KeyPlaces = std::vector<KeyPlace>;

struct Playing {
  int first = 1, last = 60;  ///< the playback range; last > first
  double rate = 24;          ///< in frames per second
  Repeat repeat = Repeat::loop;
  bool linear = false;  ///< true: blends vertex positions linearly; false: blends in log space

  friend bool operator==(const Playing&, const Playing&) = default;
};

struct Timeline : Playing {
  static constexpr int least_frame = -1'000'000, largest_frame = 1'000'000;
  static constexpr double least_rate = 1, largest_rate = 240;
  static constexpr std::size_t most_keys = 10'000;

  std::vector<PoseKey> keys;       ///< sorted by frame; one key per frame
  std::vector<CameraKey> cameras;  ///< sorted by frame; one key per frame
  std::vector<PoseKey> unkeyed{};  ///< edited poses without a key, saved when the frame changed; oldest first
  std::vector<Channel> channels{};  ///< one per keyed weight

  /// True if keys give a pose.
  bool has_poses() const { return !keys.empty() || !channels.empty(); }
  bool empty() const { return !has_poses() && cameras.empty(); }
  friend bool operator==(const Timeline&, const Timeline&) = default;
};

/// Calls act(keys, name) for the pose keys and the camera keys, with an empty name, and for each channel.
template <class AnyTimeline, class Act>
void for_each_track(AnyTimeline& timeline, const Act& act) {
  act(timeline.keys, std::string());
  act(timeline.cameras, std::string());
  for (auto& channel : timeline.channels) act(channel.keys, channel.name);
}

/// Returns the places of all keys, ascending. A pose key and a camera key of one frame have one place.
KeyPlaces key_places(const Timeline& timeline);
/// Returns the frames of all keys, ascending.
std::vector<int> key_frames(const Timeline& timeline);

/// Returns the key of the frame; null if the frame has no key.
template <class Key>
const Key* key_at(const std::vector<Key>& keys, int frame) {
  const auto found = std::ranges::lower_bound(keys, frame, {}, &Key::frame);
  return found != keys.end() && found->frame == frame ? &*found : nullptr;
}
inline const PoseKey* key_at(const Timeline& timeline, int frame) {
  return key_at(timeline.keys, frame);
}

/// Returns the channel of a named pose; null if its weight has no keys.
const Channel* channel_of(const Timeline& timeline, const std::string& name);
/// Returns the weight of a channel at any frame, interpolated like the poses of moment_at().
double weight_at(const Timeline& timeline, const Channel& channel, double frame);
/// Returns the weight of a named pose's channel; 0 without a channel.
double weight_at(const Timeline& timeline, const std::string& name, double frame);

/// A key and its factor in the interpolated pose.
struct KeyShare {
  std::size_t key;
  double factor;
};
/// The interpolation of the keys at a frame.
struct Moment {
  std::vector<KeyShare> shares;  ///< at most four; the sum of the factors is 1
  std::size_t from = 0;          ///< the key at or before the frame; if there is none, the first key
};

/// Returns the interpolation at any frame, also between whole frames. Requires a pose key. Before the first
/// key, uses the first key's pose. After the last key, uses the last key's pose.
///
/// `smooth` is a cubic Hermite spline. Its slope at a key is:
/// - at the first and the last key: 0, unless the timeline loops and both keys have equal poses
/// - otherwise, next to a `linear` interval: the slope of this interval
/// - otherwise, next to a `hold` interval: 0
/// - otherwise: the slope of E. Catmull and R. Rom (A class of local interpolating splines, 1974),
///   non-uniform as in P. J. Barry and R. N. Goldman, 1988
Moment moment_at(const Timeline& timeline, double frame);

/// Returns the frame after `seconds` of playing. If playing ends (see Repeat::once), returns nullopt.
/// `backward` is the direction of a ping-pong timeline; it changes at both ends of the range.
std::optional<double> played(const Timeline& timeline, double frame, double seconds, bool& backward);

/// Returns the smoothly interpolated camera; nullopt without camera keys. At the first and the last key, the
/// speed is 0 unless the motion is closed: both cameras are equal except for whole turns of the yaw, and the
/// timeline loops or there is at least one whole turn.
std::optional<CameraPose> camera_at(const Timeline& timeline, double frame);

}  // namespace viete::document
