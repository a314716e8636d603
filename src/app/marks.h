// Highlights on model and cage: selected and hovered elements of the cage, and findings of the checks.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "render/mark_layers.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

class CageMarks {
public:
  explicit CageMarks(const render::Gl& gl) : selected_faces_(gl), hovered_face_(gl), edges_(gl) {}

  /// Call every frame after the cage was posed: updates from the selection and pointer. Vertices are drawn
  /// elsewhere. Returns true on a change.
  bool set(const scene::Workspace& workspace, const render::Theme& theme);
  /// Forces an update in the next set().
  void forget() { marks_.reset(); }
  /// Call after drawing the cage's lines.
  void draw(const render::View& view, const render::Theme& theme) const;

private:
  struct Marks {
    std::vector<render::Triangle> selected, hovered;  // faces
    std::vector<render::Segment> edges;
    std::vector<glm::vec4> colors;  // one per edge
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

/// The drawn position of a model vertex.
using PointOfVertex = std::function<mesh::Point(std::size_t)>;

class FindingMarks {
public:
  explicit FindingMarks(const render::Gl& gl) : faces_(gl), edges_(gl), vertices_(gl) {}

  /// Call every frame: updates from the shown finding. moved: positions changed since the last frame. Returns
  /// true if the drawing changes.
  bool set(const scene::Workspace& workspace, const PointOfVertex& model_vertex, bool moved);
  /// Call last: drawn on top, visible through other objects.
  void draw(const render::View& view, const render::Theme& theme) const;

private:
  void collect(const scene::Workspace& workspace);

  render::FaceLayer faces_;
  render::LineLayer edges_;
  render::DiscLayer vertices_;
  std::vector<std::uint32_t> used_;  // vertices of the surface in the layers, in order
  unsigned long revision_ = 0;
  bool dark_ = true;
};

}  // namespace viete::app
