// Draws a workspace through the layers of the render room, and keeps the picture while nothing changes.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/marks.h"
#include "app/model_layer.h"
#include "deform/frame_vertex.h"
#include "render/backdrop.h"
#include "render/framebuffer.h"
#include "render/mark_layers.h"
#include "render/shadow_layer.h"
#include "render/surface_layer.h"
#include "render/view.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// All that decides how the view looks: the same drawing again gives the same picture.
struct ViewDrawing {
  /// One of the views that it is split in.
  struct Part {
    glm::vec2 low{0, 0}, high{1, 1};  ///< where, as parts of the window from its upper left
    glm::dmat4 view{1}, projection{1};
    render::SurfaceStyle surface;
    bool cage = true;  ///< stands where this view's pose has it

    friend bool operator==(const Part&, const Part&) = default;
  };
  std::vector<Part> parts;  ///< none: there is no model, and only the backdrop is drawn
  glm::ivec2 size{1, 1};    ///< of the window, device pixels
  float scale = 1;          ///< device pixels per logical pixel
  bool dark = true, transparent = false;
  float cage_width = 1.25f;                                       ///< of its lines, logical pixels
  bool model = false, grid = false, cage = false, ghost = false;  ///< are shown
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
  /// In so many views; the model of new ones is at rest.
  void set_views(std::size_t count, const scene::Document& document, const ModelShading& shading);
  /// The deformed model of that view, relative to origin in the file's coordinates.
  void set_model(std::size_t view, std::span<const deform::FrameVertex> vertices, const mesh::Point& origin);
  /// The map, or what of the model follows the cage, where these are shown: before draw().
  void set_colors(const scene::Workspace& workspace);
  /// The posed cage and how its vertices look now.
  void set_cage(const scene::Workspace& workspace);
  void set_hand(const scene::Workspace& workspace);
  /// The next set_hand() and set_colors() upload all anew.
  void forget() {
    hand_.reset(), marks_.forget();
    for (const auto& model : models_) model->forget();
  }
  /// What the checks found; see FindingMarks::set().
  void set_findings(const scene::Workspace& workspace, const PointOfVertex& model_vertex, bool moved) {
    if (findings_.set(workspace, model_vertex, moved)) ++content_;
  }

  /// How the workspace is to be drawn on `size` device pixels, with what the layers hold now.
  ViewDrawing drawing(const scene::Workspace& workspace, glm::ivec2 size, float scale) const;
  /// Into the bound framebuffer of that size. Depends on nothing but the drawing.
  void draw(const ViewDrawing& drawing);

private:
  ViewDrawing::Part part(const scene::Workspace& workspace, std::size_t view) const;
  void clip_to(const ViewDrawing& drawing, const ViewDrawing::Part& part) const;
  void draw_background(const ViewDrawing& drawing, const render::Theme& theme) const;
  void draw_part(const ViewDrawing& drawing, std::size_t view, const render::Theme& theme);
  void set_shown_edges(const scene::Document& document);
  void draw_cage(const ViewDrawing& drawing, const render::View& view, const render::Theme& theme) const;
  render::SurfaceStyle surface_style(const scene::Workspace& workspace) const;

  const render::Gl& gl_;
  render::Backdrop backdrop_;
  render::Grid grid_;
  std::vector<std::unique_ptr<ModelLayer>> models_;  // one a view
  render::FaceLayer cage_faces_;
  render::LineLayer cage_lines_, ghost_lines_;
  render::DiscLayer cage_vertices_;
  CageMarks marks_;
  FindingMarks findings_;
  bool file_says_something_ = false;
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
};

/// How finely a picture is drawn: a software rasteriser draws what moves at half the resolution.
enum class Fineness { coarse, plain, smooth };

class KeptView {
public:
  struct Samples {
    int plain = 0, smooth = 0;  ///< 0 none; smooth: no finer than plain
  };
  KeptView(const render::Gl& gl, const Samples& samples) : samples_(samples), picture_(gl) {}

  bool shows(const ViewDrawing& drawing) const { return drawn_ == drawing; }
  /// Draws, unless that is what it shows and as finely. Returns whether it did.
  bool draw(WorkspaceRenderer& renderer, const ViewDrawing& drawing, Fineness fineness);
  const render::Framebuffer& picture() const { return picture_; }

  /// How often it was drawn.
  unsigned long count() const { return count_; }
  Fineness fineness() const { return fineness_; }
  Fineness finest() const { return samples_.smooth > 0 ? Fineness::smooth : Fineness::plain; }
  /// The next draw() does.
  void forget() { drawn_.reset(); }

private:
  Samples samples_;
  render::Framebuffer picture_;
  std::optional<ViewDrawing> drawn_;  // what it shows, whatever the fineness
  Fineness fineness_ = Fineness::plain;
  unsigned long count_ = 0;
};

}  // namespace viete::app
