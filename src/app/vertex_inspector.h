// Data of the vertex inspector, computed with each displayed frame.
#pragma once

#include <cstdint>
#include <optional>

#include "app/live_model.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// Takes well under a millisecond. Call from one thread.
class VertexInspector {
public:
  /// Call after a frame is deformed. Returns true if the displayed data changed.
  bool follow(scene::Workspace& workspace, const LiveModel& model);
  bool is_due(const scene::Workspace& workspace, const LiveModel& model) const;

private:
  struct Key {
    std::optional<std::uint32_t> vertex;
    unsigned long frame = 0;
    const deform::Deformer* deformer = nullptr;
    friend bool operator==(const Key&, const Key&) = default;
  };
  static Key key_of(const scene::Workspace& workspace, const LiveModel& model);

  Key key_;
};

}  // namespace viete::app
