// The sum at the vertex that a person has picked: computed with each frame that shows it.
#pragma once

#include <cstdint>
#include <optional>

#include "app/live_model.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// Well under a millisecond. Call from one thread.
class VertexInspector {
public:
  /// After a frame is deformed. Says whether what the workspace shows is another sum than before.
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
