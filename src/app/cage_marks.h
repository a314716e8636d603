// Selected and hovered edges and faces of the cage, drawn over its lines.
#pragma once

#include <optional>
#include <vector>

#include "render/mark_layers.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

class CageMarks {
public:
  explicit CageMarks(const render::Gl& gl) : selected_faces_(gl), hovered_face_(gl), edges_(gl) {}

  /// Every frame, after the cage was posed: what the workspace's selection and pointer say now. Vertices are
  /// not marked here. Returns whether that is something else than before.
  bool set(const scene::Workspace& workspace, const render::Theme& theme);
  /// The next set() finds something else.
  void forget() { marks_.reset(); }
  /// After the cage's lines.
  void draw(const render::View& view, const render::Theme& theme) const;

private:
  struct Marks {
    std::vector<render::Triangle> selected, hovered;  // faces
    std::vector<render::Segment> edges;
    std::vector<glm::vec4> colors;  // of these
    std::vector<mesh::Point> positions;
    friend bool operator==(const Marks&, const Marks&) = default;
  };
  static void add_faces(const scene::Workspace& workspace, Marks& marks);
  static void add_edges(const scene::Workspace& workspace, const render::Theme& theme, Marks& marks);
  void upload();

  std::optional<Marks> marks_;
  render::FaceLayer selected_faces_, hovered_face_;
  render::LineLayer edges_;
};

}  // namespace viete::app
