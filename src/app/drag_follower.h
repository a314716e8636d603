// A deformer that follows a drag in parts, once a whole frame of it is there.
#pragma once

#include <optional>

#include "deform/deformer.h"
#include "scene/hand/transform_drag.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// The hand changes the cage itself: models stay as they are at rest.
inline bool changes_rest(const scene::Workspace& w) {
  const auto& drag = w.interaction.drag;
  return drag && w.document.kept_pose && !drag->vertices().empty();
}

class DragFollower {
public:
  using Drag = std::optional<scene::TransformDrag>;

  /// Before a frame. True where a drag has ended, or moves others than it did: the next frame must be whole.
  bool before(deform::Deformer& deformer, const Drag& drag) {
    if (!dragging_ || (drag && drag->softened() == softened_)) return false;
    deformer.end_drag();
    dragging_ = false;
    return true;
  }
  /// After it: from the next frame on only what was deformed whole can be followed in parts.
  void after(deform::Deformer& deformer, const Drag& drag) {
    if (drag && !dragging_ && deformer.ran() && !drag->vertices().empty())
      deformer.begin_drag(drag->vertices());
    dragging_ = drag.has_value();
    softened_ = drag ? drag->softened() : 0;
  }

private:
  bool dragging_ = false;
  int softened_ = 0;  // of the drag that is followed
};

}  // namespace viete::app
