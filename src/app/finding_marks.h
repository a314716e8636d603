// What the checks found, drawn over model and cage.
#pragma once

#include <functional>
#include <vector>

#include "render/mark_layers.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

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
