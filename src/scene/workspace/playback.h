// What plays: see playing.h.
#pragma once

#include <memory>

#include "scene/document/animation.h"

namespace viete::scene {

/// What plays, and what is known of the motion. Of a workspace.
struct Playback {
  bool playing = false;
  bool backward = false;  ///< as ping-pong comes back
  bool auto_key = false;  ///< what a hand changes becomes a key of its frame
  bool paths = false;     ///< the ways of the selected vertices are drawn
  KnownVectors vectors{};
  std::shared_ptr<const Animation> animation{};  ///< of `timeline`; null where that has no keys
  Timeline timeline{};
  std::shared_ptr<const deform::Cage> cage{};
  std::shared_ptr<const mesh::Surface> model{};
  SharedPose shown{};               ///< as time has put it there; null: not by time
  unsigned long seen_revision = 0;  ///< of the history
  Timeline seen_timeline{};         ///< as it was then
};

}  // namespace viete::scene
