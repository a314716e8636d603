// The timeline: keys, their easing, and the playback settings.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/choice.h"
#include "deform/binding.h"
#include "deform/cage.h"
#include "deform/probe.h"
#include "document/camera.h"

namespace viete::document {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

using deform::SharedShape;

inline bool same_shape(const SharedShape& a, const SharedShape& b) {
  return a == b || (a && b && *a == *b);
}

/// Everything that moves the model: its shape, the cage, and the probes by index (missing ones are at rest).
struct WholePose {
  deform::Pose cage;
  std::vector<deform::ProbePose> probes;
  SharedShape shape{};

  deform::ProbePose probe(std::size_t i) const { return i < probes.size() ? probes[i] : deform::ProbePose{}; }
  friend bool operator==(const WholePose& a, const WholePose& b) {
    return a.cage.positions == b.cage.positions && a.cage.turns == b.cage.turns && a.probes == b.probes &&
           same_shape(a.shape, b.shape);
  }
};
/// Never null; equal pointers are equal poses.
using SharedPose = std::shared_ptr<const WholePose>;

/// The interpolation to the next key.
enum class Easing { smooth, linear, hold };
std::span<const Choice> choices(Easing);

/// The behaviour after the last frame.
enum class Repeat { once, loop, ping_pong };
std::span<const Choice> choices(Repeat);

/// The weight of a named pose in a key.
struct MixedPose {
  std::string name;
  double weight;

  friend bool operator==(const MixedPose&, const MixedPose&) = default;
};

struct PoseKey {
  int frame;
  SharedPose pose{};
  Easing easing = Easing::smooth;  ///< up to the next key
  std::vector<MixedPose> mix{};    ///< named poses it was mixed from, without those changed since

  friend bool operator==(const PoseKey&, const PoseKey&) = default;
};

struct CameraKey {
  int frame;
  CameraPose camera{};

  friend bool operator==(const CameraKey&, const CameraKey&) = default;
};

struct Playing {
  int first = 1, last = 60;  ///< playback range; last > first
  double rate = 24;          ///< frames per second
  Repeat repeat = Repeat::loop;
  bool straight = false;  ///< linear blending of the cage's vertices, as in other programs

  friend bool operator==(const Playing&, const Playing&) = default;
};

struct Timeline : Playing {
  static constexpr int least_frame = -1'000'000, largest_frame = 1'000'000;
  static constexpr double least_rate = 1, largest_rate = 240;
  static constexpr std::size_t most_keys = 10'000;

  std::vector<PoseKey> keys;       ///< sorted by frame, unique
  std::vector<CameraKey> cameras;  ///< likewise
  std::vector<PoseKey> unkeyed{};  ///< replaced poses that had no key; oldest first

  bool empty() const { return keys.empty() && cameras.empty(); }
  friend bool operator==(const Timeline&, const Timeline&) = default;
};

/// The key of that frame, or null.
const PoseKey* key_at(const Timeline& timeline, int frame);

/// A key's share in the pose of a frame; the shares sum to 1.
struct KeyShare {
  std::size_t key;
  double factor;
};
/// The factors of the keys at a frame: at most four; `from` is the key at or before the frame, or the first.
struct Moment {
  std::vector<KeyShare> shares;
  std::size_t from = 0;
};

/// Any frame, also fractional: the first key before all keys, the last key after them. Requires a key.
///
/// `smooth` passes through keys: cubic Hermite pieces with the slopes of E. Catmull and R. Rom (A class of
/// local interpolating splines, 1974; non-uniform as in P. J. Barry and R. N. Goldman, 1988). The slope is 0
/// at the first and the last key, unless it loops and both are the same pose, and next to a `hold` interval;
/// next to a `linear` interval it is that interval's slope.
Moment moment_at(const Timeline& timeline, double frame);

/// The frame after playing for `seconds` from `frame`; `backward` is the direction, which ping-pong reverses.
/// Nullopt at the end.
std::optional<double> played(const Timeline& timeline, double frame, double seconds, bool& backward);

/// Smooth interpolation of camera keys; nullopt without any. The speed is 0 at the first and last key, unless
/// the camera returns to its start, by full turns or by looping.
std::optional<CameraPose> camera_at(const Timeline& timeline, double frame);

}  // namespace viete::document
