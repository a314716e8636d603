// Visibility of the cage in a workspace, recomputed when the view changes.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/hand/picking.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// With the drawn model and the cage's faces as occluders.
Sight sight_of(const Workspace& workspace);

/// Caches the Sight of the current view.
class SightCache {
public:
  /// Null if hidden elements can be selected too.
  const Sight* of(const Workspace& workspace);

private:
  struct Picture {
    CameraPose camera;
    Viewport viewport;
    Revisions revisions;
    unsigned long frame;
    const void* vertices;
    bool model;
    std::vector<std::uint32_t> hidden;

    friend bool operator==(const Picture&, const Picture&) = default;
  };
  std::optional<Picture> picture_;
  std::optional<Sight> sight_;
};

}  // namespace viete::scene
