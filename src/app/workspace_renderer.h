// Draws a workspace: model, cage and ground through the render room's layers.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/cage_marks.h"
#include "app/finding_marks.h"
#include "app/model_shading.h"
#include "deform/frame_vertex.h"
#include "render/backdrop.h"
#include "render/disc_layer.h"
#include "render/face_layer.h"
#include "render/line_layer.h"
#include "render/shadow_layer.h"
#include "render/surface_layer.h"
#include "scene/workspace.h"

namespace viete::app {

class WorkspaceRenderer {
public:
  explicit WorkspaceRenderer(const render::Gl& gl);

  /// New topology: model and cage of the document, the model at rest.
  void set_document(const scene::Document& document, const ModelShading& shading);
  /// Another cage around the same model, which is at rest again.
  void set_another_cage(const scene::Document& document, const ModelShading& shading);
  /// The model of that document, at rest again.
  void set_rest(const scene::Document& document, const ModelShading& shading);
  /// The deformed model, relative to origin in the file's coordinates.
  void set_model(std::span<const deform::FrameVertex> vertices, const mesh::Point& origin);
  /// log10 of the error per vertex, for the error map; empty: none.
  void set_errors(std::span<const float> errors);
  /// What of the model follows the cage, where that is shown: before draw().
  void set_mask(const scene::Workspace& workspace);
  /// The posed cage and how its vertices look now.
  void set_cage(const scene::Workspace& workspace);
  void set_hand(const scene::Workspace& workspace);
  /// What the checks found; see FindingMarks::set().
  void set_findings(const scene::Workspace& workspace, const PointOfVertex& model_vertex, bool moved) {
    findings_.set(workspace, model_vertex, moved);
  }

  /// Into the bound framebuffer of `size` device pixels.
  void draw(const scene::Workspace& workspace, glm::ivec2 size, float scale);

private:
  void draw_ground(const scene::Workspace& workspace, const render::View& view, const render::Theme& theme);
  void set_shown_edges(const scene::Document& document);
  void draw_cage(const scene::Workspace& workspace, const render::View& view,
                 const render::Theme& theme) const;

  const render::Gl& gl_;
  render::Backdrop backdrop_;
  render::Grid grid_;
  render::ShadowLayer shadow_;
  render::SurfaceLayer model_;
  render::FaceLayer cage_faces_;
  render::LineLayer cage_lines_, ghost_lines_;
  render::DiscLayer cage_vertices_;
  CageMarks marks_;
  FindingMarks findings_;
  std::vector<float> errors_;
  bool file_says_something_ = false;
  // What the model is coloured by; nothing: it is to be uploaded anew.
  struct Colored {
    bool by_mask = false, dark = false;
    deform::Mask mask;
    friend bool operator==(const Colored&, const Colored&) = default;
  };
  std::optional<Colored> colored_;
  std::vector<std::uint32_t> hidden_;         // vertices of the cage, as its lines are drawn
  std::vector<render::Segment> shown_edges_;  // which those are
  std::size_t model_vertices_ = 0;
};

}  // namespace viete::app
