// Draws a workspace with the layers of the render room, and caches the picture until something changes.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "app/model_layer.h"
#include "deform/rows.h"
#include "render/backdrop.h"
#include "render/framebuffer.h"
#include "render/mark_layers.h"
#include "render/shadow_layer.h"
#include "render/surface_layer.h"
#include "render/view.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

/// Everything that determines the view's picture: equal drawings give equal pictures.
struct ViewDrawing {
  /// One pane of a split view.
  struct Part {
    glm::vec2 low{0, 0}, high{1, 1};  ///< corners as fractions of the window from its upper left
    glm::dmat4 view{1}, projection{1};
    render::SurfaceStyle surface;
    bool cage = true;  ///< false: not drawn, since this view's pose differs

    friend bool operator==(const Part&, const Part&) = default;
  };
  std::vector<Part> parts;  ///< empty: no model, only the backdrop is drawn
  glm::ivec2 size{1, 1};    ///< window size in device pixels
  float scale = 1;          ///< device pixels per logical pixel
  bool dark = true, transparent = false;
  bool model = false, grid = false, cage = false, ghost = false;  ///< visible
  render::ShadowStyle shadow;
  render::GridStyle ground;
  unsigned long content = 0;  ///< increases with each change of the layers' data

  friend bool operator==(const ViewDrawing&, const ViewDrawing&) = default;
};

/// Highlights of selected and hovered elements of the cage.
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

/// Findings of the checks.
class FindingMarks {
public:
  explicit FindingMarks(const render::Gl& gl) : faces_(gl), edges_(gl), vertices_(gl) {}

  /// Call every frame: updates from the shown finding. posed: the model as drawn; moved: positions changed
  /// since the last frame. Returns true if the drawing changes.
  bool set(const scene::Workspace& workspace, const scene::PosedModel& posed, bool moved);
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

class WorkspaceRenderer {
public:
  explicit WorkspaceRenderer(const render::Gl& gl);

  /// New topology: model and cage of the document, the model at rest.
  void set_document(const scene::Document& document, const ModelShading& shading);
  /// Another cage around the same model, which is at rest again.
  void set_another_cage(const scene::Document& document, const ModelShading& shading);
  /// The document's model, at rest again.
  void set_rest(const scene::Document& document, const ModelShading& shading);
  /// Sets the number of views; models of new views are at rest.
  void set_views(std::size_t count, const scene::Document& document, const ModelShading& shading);
  /// The deformed model of that view, relative to origin in file coordinates.
  void set_model(std::size_t view, std::span<const deform::FrameVertex> vertices, const mesh::Point& origin);
  /// Updates the colours of the map or mask; call before draw().
  void set_colors(const scene::Workspace& workspace);
  /// The posed cage and the colours of its vertices.
  void set_cage(const scene::Workspace& workspace);
  void set_hand(const scene::Workspace& workspace);
  /// Forces a complete upload in the next set_hand() and set_colors().
  void forget() {
    hand_.reset(), marks_.forget();
    for (const auto& model : models_) model->forget();
  }
  /// Findings of the checks; see FindingMarks::set().
  void set_findings(const scene::Workspace& workspace, const scene::PosedModel& posed, bool moved) {
    if (findings_.set(workspace, posed, moved)) ++content_;
  }

  /// The drawing of the workspace on `size` device pixels with the layers' current data.
  ViewDrawing drawing(const scene::Workspace& workspace, glm::ivec2 size, float scale) const;
  /// Draws into the bound framebuffer of that size. Depends only on the drawing.
  void draw(const ViewDrawing& drawing);

private:
  ViewDrawing::Part part(const scene::Workspace& workspace, std::size_t view) const;
  void clip_to(const ViewDrawing& drawing, const ViewDrawing::Part& part) const;
  void draw_part(const ViewDrawing& drawing, std::size_t view, const render::Theme& theme);
  void set_cage_faces(const scene::Document& document);
  void set_shown_edges(const scene::Document& document);
  void draw_cage(const ViewDrawing& drawing, const render::View& view, const render::Theme& theme) const;

  const render::Gl& gl_;
  render::Backdrop backdrop_;
  render::Grid grid_;
  std::vector<std::unique_ptr<ModelLayer>> models_;  // one per view
  render::FaceLayer cage_faces_;
  render::LineLayer cage_lines_, ghost_lines_;
  render::DiscLayer cage_vertices_;
  CageMarks marks_;
  FindingMarks findings_;
  bool file_has_looks_ = false;
  // Appearance of the cage's vertices and lines; nullopt: upload again.
  struct Hand {
    bool dark = true;
    std::vector<render::Disc> discs;
    std::vector<glm::vec4> ends;  // colours of line ends; empty: all in the cage's colour
    friend bool operator==(const Hand&, const Hand&) = default;
  };
  std::optional<Hand> hand_;
  unsigned long content_ = 0;
  std::vector<std::uint32_t> hidden_;         // hidden vertices of the cage in the drawn lines
  std::vector<render::Segment> shown_edges_;  // the drawn edges
};

/// Quality of a picture: software rendering draws motion at half the resolution, and large models coarsely.
enum class Fineness { coarse, plain, smooth };

class ViewCache {
public:
  struct Samples {
    int plain = 0, smooth = 0;  ///< samples; 0: no multisampling; smooth 0: no refinement
  };
  ViewCache(const render::Gl& gl, const Samples& samples) : samples_(samples), picture_(gl) {}

  bool shows(const ViewDrawing& drawing) const { return drawn_ == drawing; }
  /// Draws, unless the picture already shows this drawing at this fineness. Returns true if it drew.
  bool draw(WorkspaceRenderer& renderer, const ViewDrawing& drawing, Fineness fineness);
  const render::Framebuffer& picture() const { return picture_; }

  /// The number of pictures drawn.
  unsigned long count() const { return count_; }
  Fineness fineness() const { return fineness_; }
  Fineness finest() const { return samples_.smooth > 0 ? Fineness::smooth : Fineness::plain; }
  /// Forces the next draw().
  void forget() { drawn_.reset(); }

private:
  Samples samples_;
  render::Framebuffer picture_;
  std::optional<ViewDrawing> drawn_;  // the drawing it shows, at any fineness
  Fineness fineness_ = Fineness::plain;
  unsigned long count_ = 0;
};

}  // namespace viete::app
