// Poses in time: keys, how one comes to the next, and what plays.
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
#include "scene/document/camera.h"

namespace viete::scene {

using base::Choice, base::entry_of, base::next_choice, base::value_of_word;

using deform::SharedShape;

inline bool same_shape(const SharedShape& a, const SharedShape& b) {
  return a == b || (a && b && *a == *b);
}

/// All that moves the model: its shape, the cage, and probes by their number (those that are missing are at
/// rest).
struct WholePose {
  deform::Pose cage;
  std::vector<deform::ProbePose> probes;
  SharedShape shape{};

  friend bool operator==(const WholePose& a, const WholePose& b) {
    return a.cage.positions == b.cage.positions && a.cage.turns == b.cage.turns && a.probes == b.probes &&
           same_shape(a.shape, b.shape);
  }
};
/// Never null; the same pointer is the same pose.
using SharedPose = std::shared_ptr<const WholePose>;

/// How a key comes to the next one.
enum class Easing { smooth, linear, hold };
std::span<const Choice> choices(Easing);

/// What happens after the last frame.
enum class Repeat { once, loop, ping_pong };
std::span<const Choice> choices(Repeat);

/// How much of a pose with that name a key has mixed in.
struct MixedPose {
  std::string name;
  double weight;

  friend bool operator==(const MixedPose&, const MixedPose&) = default;
};

struct PoseKey {
  int frame;
  SharedPose pose{};
  Easing easing = Easing::smooth;  ///< up to the next key
  std::vector<MixedPose> mix{};    ///< the named poses that it was made of, while these are unchanged

  friend bool operator==(const PoseKey&, const PoseKey&) = default;
};

struct CameraKey {
  int frame;
  CameraPose camera{};

  friend bool operator==(const CameraKey&, const CameraKey&) = default;
};

struct Timeline {
  static constexpr int least_frame = -1'000'000, largest_frame = 1'000'000;
  static constexpr double least_rate = 1, largest_rate = 240;
  static constexpr std::size_t most_keys = 10'000;

  std::vector<PoseKey> keys;       ///< by frame, each frame once
  std::vector<CameraKey> cameras;  ///< likewise
  std::vector<PoseKey> unkeyed{};  ///< poses in no key that something else took the place of; oldest first
  int first = 1, last = 60;        ///< what plays; last > first
  double rate = 24;                ///< frames a second
  Repeat repeat = Repeat::loop;
  bool straight = false;  ///< vertices of the cage go straight from key to key, as in other programs

  bool empty() const { return keys.empty() && cameras.empty(); }
  friend bool operator==(const Timeline&, const Timeline&) = default;
};

/// The key of that frame, or null.
const PoseKey* key_at(const Timeline& timeline, int frame);

/// A key's share in the pose of a moment; all of them sum to 1.
struct KeyShare {
  std::size_t key;
  double factor;
};
/// What a moment is made of: four keys at most. from and to are those around it, the same where it is one key
/// alone.
struct Moment {
  std::vector<KeyShare> shares;
  std::size_t from = 0, to = 0;
};

/// At any frame, also between two: the first key before all of them, the last one after. Requires a key.
///
/// `smooth` flows through keys: cubic Hermite pieces with the slopes of E. Catmull and R. Rom (A class of
/// local interpolating splines, 1974; of keys at uneven times as in P. J. Barry and R. N. Goldman, 1988); it
/// comes to rest at the first and the last key, unless it loops and both are the same pose, and where the
/// other side holds; beside `linear` it has that one's slope.
Moment moment_at(const Timeline& timeline, double frame);

/// The frame after `seconds` of playing from `frame`, forward or backward (which ping-pong turns round);
/// nothing where it has come to the end.
std::optional<double> played(const Timeline& timeline, double frame, double seconds, bool& backward);

/// Between camera keys, smoothly; nothing where there are none. It comes to rest at the first and the last
/// one, unless it is there again after whole turns, or loops and is there again.
std::optional<CameraPose> camera_at(const Timeline& timeline, double frame);

}  // namespace viete::scene
