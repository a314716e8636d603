// Draws a workspace: model, cage and ground through the render room's layers.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/cage_marks.h"
#include "app/finding_marks.h"
#include "app/model_looks.h"
#include "deform/frame_vertex.h"
#include "render/backdrop.h"
#include "render/disc_layer.h"
#include "render/face_layer.h"
#include "render/line_layer.h"
#include "render/shadow_layer.h"
#include "render/surface_layer.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// All that decides how the view looks: the same drawing again gives the same picture.
struct ViewDrawing {
  render::View view;
  bool dark = true;
  bool open = false;  ///< there is a model; else only the backdrop
  bool model = false, grid = false, cage = false, ghost = false;  ///< are shown
  render::SurfaceStyle surface;
  render::ShadowStyle shadow;
  render::GridStyle ground;
  unsigned long content = 0;  ///< of the layers; grows with each change of what they hold

  friend bool operator==(const ViewDrawing&, const ViewDrawing&) = default;
};

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
  /// The map, or what of the model follows the cage, where these are shown: before draw().
  void set_colors(const scene::Workspace& workspace);
  /// The posed cage and how its vertices look now.
  void set_cage(const scene::Workspace& workspace);
  void set_hand(const scene::Workspace& workspace);
  /// The next set_hand() and set_colors() upload all anew.
  void forget() { hand_.reset(), colored_.reset(), marks_.forget(); }
  /// What the checks found; see FindingMarks::set().
  void set_findings(const scene::Workspace& workspace, const PointOfVertex& model_vertex, bool moved) {
    if (findings_.set(workspace, model_vertex, moved)) ++content_;
  }

  /// How the workspace is to be drawn on `size` device pixels, with what the layers hold now.
  ViewDrawing drawing(const scene::Workspace& workspace, glm::ivec2 size, float scale) const;
  /// Into the bound framebuffer of that size. Depends on nothing but the drawing.
  void draw(const ViewDrawing& drawing);

private:
  void draw_ground(const ViewDrawing& drawing, const render::Theme& theme);
  void set_shown_edges(const scene::Document& document);
  void draw_cage(const ViewDrawing& drawing, const render::Theme& theme) const;
  render::SurfaceStyle surface_style(const scene::Workspace& workspace) const;

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
  bool file_says_something_ = false;
  // What the model is coloured by; nothing: it is to be uploaded anew.
  struct Colored {
    bool by_mask = false, dark = false;
    deform::Mask mask;
    std::shared_ptr<const std::vector<float>> field;
    bool symmetric = false;
    friend bool operator==(const Colored&, const Colored&) = default;
  };
  std::optional<Colored> colored_;
  // How the cage's vertices and lines look; nothing: it is to be uploaded anew.
  struct Hand {
    bool dark = true;
    std::vector<render::Disc> discs;
    std::vector<glm::vec4> ends;  // colours of the ends of lines; empty: all as the cage
    friend bool operator==(const Hand&, const Hand&) = default;
  };
  std::optional<Hand> hand_;
  unsigned long content_ = 0;
  std::vector<std::uint32_t> hidden_;         // vertices of the cage, as its lines are drawn
  std::vector<render::Segment> shown_edges_;  // which those are
  std::size_t model_vertices_ = 0;
};

}  // namespace viete::app
