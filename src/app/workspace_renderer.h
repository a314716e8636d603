// Draws a workspace with the layers of `render`, and caches the picture until something changes.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "app/model_layer.h"
#include "render/backdrop.h"
#include "render/framebuffer.h"
#include "render/mark_layers.h"
#include "render/shadow_layer.h"
#include "render/surface_layer.h"
#include "render/view.h"
#include "workspace/workspace.h"

namespace viete::app {

/// All data that determine the view's picture. Equal drawings give equal pictures.
struct ViewDrawing {
  /// One pane of a split view.
  struct Part {
    glm::vec2 low{0, 0}, high{1, 1};  ///< corners as fractions of the window; (0, 0) is its upper left corner
    glm::dmat4 view{1}, projection{1};
    render::SurfaceStyle surface;
    bool cage = true;  ///< false: the cage is not drawn, because this view has another pose

    friend bool operator==(const Part&, const Part&) = default;
  };
  std::vector<Part> parts;  ///< if empty, only the backdrop is drawn
  glm::ivec2 size{1, 1};    ///< window size in device pixels
  float scale = 1;          ///< device pixels per logical pixel
  bool dark = true, transparent = false;
  bool model = false, grid = false, cage = false, ghost = false;  ///< true: visible
  render::ShadowStyle shadow;
  render::GridStyle ground;
  unsigned long content = 0;  ///< increases with each change of the layers' data

  friend bool operator==(const ViewDrawing&, const ViewDrawing&) = default;
};

/// Highlights of selected and hovered elements of the cage.
class CageMarks {
public:
  explicit CageMarks(const render::Gl& gl) : selected_faces_(gl), hovered_face_(gl), edges_(gl) {}

  /// Call in every frame after the cage is posed. Updates the highlights of faces and edges. Returns true if
  /// the highlights have changed.
  bool set(const workspace::Workspace& workspace, const render::Theme& theme);
  /// The next set() updates the highlights even if they have not changed.
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
  static void add_faces(const workspace::Workspace& workspace, Marks& marks);
  static void add_edges(const workspace::Workspace& workspace, const render::Theme& theme, Marks& marks);
  void upload();

  std::optional<Marks> marks_;
  render::FaceLayer selected_faces_, hovered_face_;
  render::LineLayer edges_;
};

/// Highlights of a problem found by the checks.
class FindingMarks {
public:
  explicit FindingMarks(const render::Gl& gl) : faces_(gl), edges_(gl), vertices_(gl) {}

  /// Call in every frame. `posed` is the drawn model. If its positions have changed, `moved` must be true.
  /// Returns true if the highlights change.
  bool set(const workspace::Workspace& workspace, const document::PosedModel& posed, bool moved);
  /// Call last, so that the highlights are visible through other objects.
  void draw(const render::View& view, const render::Theme& theme) const;

private:
  void collect(const workspace::Workspace& workspace);

  render::FaceLayer faces_;
  render::LineLayer edges_;
  render::DiscLayer vertices_;
  std::vector<std::uint32_t> used_;  // for each vertex of the layers, its index in the surface
  unsigned long revision_ = 0;
  bool dark_ = true;
};

class WorkspaceRenderer {
public:
  explicit WorkspaceRenderer(const render::Gl& gl);

  /// Sets a new model and cage, with the model at rest.
  void set_document(const document::Document& document, const ModelShading& shading);
  /// Sets a new cage, with the model at rest.
  void set_another_cage(const document::Document& document, const ModelShading& shading);
  /// Shows the model at rest.
  void set_rest(const document::Document& document, const ModelShading& shading);
  /// Sets the number of views. The models of new views are at rest.
  void set_views(std::size_t count, const document::Document& document, const ModelShading& shading);
  /// Returns the model of a view, whose deformed vertices the caller then sets.
  ModelLayer& changed_model(std::size_t view) {
    ++content_;
    return *models_[view];
  }
  /// Updates the colours of the map or mask. Call before draw().
  void set_colors(const workspace::Workspace& workspace);
  void set_cage(const workspace::Workspace& workspace);
  /// Updates the colours and highlights of the cage.
  void set_hand(const workspace::Workspace& workspace);
  /// The next set_hand() and set_colors() upload all data.
  void forget() {
    hand_.reset();
    marks_.forget();
    for (const auto& model : models_) model->forget();
  }
  /// See FindingMarks::set().
  void set_findings(const workspace::Workspace& workspace, const document::PosedModel& posed, bool moved) {
    if (findings_.set(workspace, posed, moved)) ++content_;
  }

  /// The drawing of the workspace with the current data of the layers. `size` is in device pixels.
  ViewDrawing drawing(const workspace::Workspace& workspace, glm::ivec2 size, float scale) const;
  /// Draws into the bound framebuffer, which must have the size of the drawing. If `coarse`, draws drafts.
  void draw(const ViewDrawing& drawing, bool coarse);

private:
  ViewDrawing::Part part(const workspace::Workspace& workspace, std::size_t view) const;
  void clip_to(const ViewDrawing& drawing, const ViewDrawing::Part& part) const;
  void draw_part(const ViewDrawing& drawing, std::size_t view, const render::Theme& theme, bool coarse);
  void draw_ground(const ViewDrawing& drawing, ModelLayer& model, const render::View& view,
                   const render::Theme& theme);
  void set_cage_faces(const document::Document& document);
  void set_shown_edges(const document::Document& document);
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
  // The colours of the cage's vertices and lines.
  struct Hand {
    bool dark = true;
    std::vector<render::Disc> discs;
    std::vector<glm::vec4> ends;  // colours of line end points; empty: all lines have the cage's colour
    friend bool operator==(const Hand&, const Hand&) = default;
  };
  std::optional<Hand> hand_;
  unsigned long content_ = 0;
  std::vector<std::uint32_t> hidden_;         // hidden vertices when shown_edges_ were computed
  std::vector<render::Segment> shown_edges_;  // drawn edges of the cage
};

/// Quality of a picture. `coarse`: drafts of large models, and half the resolution if wanted. `plain`: full
/// resolution. `smooth`: full resolution with more samples.
enum class Fineness { coarse, plain, smooth };

/// The last picture of the scene, redrawn only if what it shows has changed or a finer one is wanted.
class ViewCache {
public:
  struct Samples {
    int plain = 0, smooth = 0;  ///< samples per pixel; plain 0: no multisampling; smooth 0: no refinement
  };
  ViewCache(const render::Gl& gl, const Samples& samples) : samples_(samples), picture_(gl) {}

  bool shows(const ViewDrawing& drawing) const { return drawn_ == drawing; }
  /// If the picture does not show this drawing in this quality yet, draws the picture and returns true.
  /// `half`: coarse pictures have half the resolution, without multisampling.
  bool draw(WorkspaceRenderer& renderer, const ViewDrawing& drawing, Fineness fineness, bool half);
  const render::Framebuffer& picture() const { return picture_; }

  /// The number of times the picture was drawn.
  unsigned long count() const { return count_; }
  Fineness fineness() const { return fineness_; }
  Fineness finest() const { return samples_.smooth > 0 ? Fineness::smooth : Fineness::plain; }
  /// The next draw() draws in any case.
  void forget() { drawn_.reset(); }

private:
  Samples samples_;
  render::Framebuffer picture_;
  std::optional<ViewDrawing> drawn_;  // the drawing that picture_ shows
  Fineness fineness_ = Fineness::plain;
  unsigned long count_ = 0;
};

}  // namespace viete::app
