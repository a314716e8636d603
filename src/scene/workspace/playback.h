// What plays: see playing.h.
#pragma once

#include <memory>

#include "scene/document/animation.h"

namespace viete::scene {

/// What keys make of a frame.
struct TimedPose {
  std::shared_ptr<const Animation> animation{};
  double frame = 0;
  SharedPose pose{};
};

/// What plays, and what is known of the motion. Of a workspace.
struct Playback {
  bool playing = false;
  bool backward = false;  ///< as ping-pong comes back
  bool auto_key = false;  ///< what a hand changes becomes a key of its frame
  KnownVectors vectors{};
  std::shared_ptr<const Animation> animation{};  ///< of `timeline`; null where that has no keys
  Timeline timeline{};
  std::shared_ptr<const deform::Cage> cage{};
  std::shared_ptr<const mesh::Surface> model{};
  mutable TimedPose by_time{};      ///< the last one that was asked for
  SharedPose shown{};               ///< as time has put it there; null: not by time
  unsigned long seen_revision = 0;  ///< of the history
  Timeline seen_timeline{};         ///< as it was then
};

}  // namespace viete::scene
