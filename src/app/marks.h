// Marks over model and cage: selected and hovered parts of the cage, and problems found by the checks.
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

/// Where a vertex of the model is drawn.
using PointOfVertex = std::function<mesh::Point(std::size_t)>;

class FindingMarks {
public:
  explicit FindingMarks(const render::Gl& gl) : faces_(gl), edges_(gl), vertices_(gl) {}

  /// Every frame: follows what the workspace shows. moved: the positions are others than in the last frame.
  /// Returns whether there is something else to draw than before.
  bool set(const scene::Workspace& workspace, const PointOfVertex& model_vertex, bool moved);
  /// After everything else: it is seen through what hides it.
  void draw(const render::View& view, const render::Theme& theme) const;

private:
  void collect(const scene::Workspace& workspace);

  render::FaceLayer faces_;
  render::LineLayer edges_;
  render::DiscLayer vertices_;
  std::vector<std::uint32_t> used_;  // the surface's vertices that the layers hold, in their order
  unsigned long revision_ = 0;
  bool dark_ = true;
};

}  // namespace viete::app
