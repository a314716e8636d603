// What of the cage is seen in a workspace, made anew where the view shows another picture.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "scene/hand/picking.h"
#include "scene/workspace/workspace.h"

namespace viete::scene {

/// Of the model as it is drawn and the faces of the cage.
Sight sight_of(const Workspace& workspace);

/// Makes it where the view shows another picture than the last time.
class SightKeeper {
public:
  /// Null where all can be selected, seen or not.
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
