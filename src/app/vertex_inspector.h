// The vertex inspector: how the cage's elements move the inspected vertex.
#pragma once

#include <cstdint>
#include <optional>

#include "app/view_model.h"
#include "workspace/workspace.h"

namespace viete::app {

/// Updates View::vertex. Not thread-safe.
class VertexInspector {
public:
  /// If the inspected vertex or the frame of the model has changed, updates the view and returns true.
  bool follow(workspace::Workspace& workspace, const LiveModel& model);
  /// True if follow() would do something now.
  bool is_due(const workspace::Workspace& w, const LiveModel& model) const {
    return (w.view.vertex.vertex || shown_.vertex) && shown_ != key_of(w, model);
  }

private:
  struct Key {
    std::optional<std::uint32_t> vertex;
    unsigned long frame = 0;
    const deform::FrameDeformer* deformer = nullptr;
    friend bool operator==(const Key&, const Key&) = default;
  };
  static Key key_of(const workspace::Workspace& w, const LiveModel& model) {
    return {w.view.vertex.vertex, model.frames(), model.deformer()};
  }

  Key shown_;
};

}  // namespace viete::app
