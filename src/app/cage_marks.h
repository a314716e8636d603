// Selected and hovered edges and faces of the cage, drawn over its lines.
#pragma once

#include "render/face_layer.h"
#include "render/line_layer.h"
#include "scene/workspace.h"

namespace viete::app {

class CageMarks {
public:
  explicit CageMarks(const render::Gl& gl) : selected_faces_(gl), hovered_face_(gl), edges_(gl) {}

  /// Every frame, after the cage was posed: what the workspace's selection and pointer say now. Vertices are
  /// not marked here.
  void set(const scene::Workspace& workspace, const render::Theme& theme);
  /// After the cage's lines.
  void draw(const render::View& view, const render::Theme& theme) const;

private:
  void set_faces(const scene::Workspace& workspace);
  void set_edges(const scene::Workspace& workspace, const render::Theme& theme);

  render::FaceLayer selected_faces_, hovered_face_;
  render::LineLayer edges_;
};

}  // namespace viete::app
