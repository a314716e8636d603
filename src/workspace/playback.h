// The state of playback, see playing.h.
#pragma once

#include <memory>

#include "document/animation.h"

namespace viete::workspace {

/// The pose of the keys at a frame.
struct TimedPose {
  std::shared_ptr<const document::Animation> animation{};
  double frame = 0;
  document::SharedPose pose{};
};

struct Playback {
  bool playing = false;
  bool backward = false;  ///< direction, for ping-pong
  bool auto_key = false;  ///< edits of the pose set a key at the current frame
  document::VectorCache vectors{};
  std::shared_ptr<const document::Animation> animation{};  ///< for `timeline`; null without keys
  document::Timeline timeline{};
  std::shared_ptr<const deform::Cage> cage{};
  std::shared_ptr<const mesh::Surface> model{};
  mutable TimedPose by_time{};         ///< the pose that was computed last
  document::SharedPose shown{};        ///< the pose that the timeline has set; null: none
  unsigned long seen_revision = 0;     ///< the last revision of the history that playback has handled
  document::Timeline seen_timeline{};  ///< the timeline at that revision
};

}  // namespace viete::workspace
