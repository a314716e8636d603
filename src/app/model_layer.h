// The model as one view shows it: its surface, colours and shadow.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deform/binding.h"
#include "deform/frame_vertex.h"
#include "lab/field.h"
#include "mesh/formats/attributes.h"
#include "mesh/surface.h"
#include "render/mark_layers.h"
#include "render/shadow_layer.h"
#include "render/surface_layer.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

struct ModelLooks {
  std::vector<mesh::Triangle> triangles;  ///< of the surface, those that look alike together
  render::SurfaceLooks looks;             ///< of these
  bool says_something = false;            ///< there are colours, images, or materials that are not grey
  std::vector<std::string> warnings;      ///< of images that cannot be shown, one line each
};

/// normals: of the vertices, at rest. Images are decoded, those of files beside are read; what is wrong with
/// one costs that image. Triangles of a group that is flat in the file, or whose normals there stand across
/// an edge, are flat. Thread-safe.
ModelLooks looks_of(const mesh::Surface& surface, const mesh::Attributes& attributes,
                    std::span<const mesh::Point> normals);

/// What drawing a model needs besides its surface, computed once per model.
struct ModelShading {
  std::shared_ptr<const mesh::Surface> surface;  ///< the model it belongs to; null: none
  std::vector<mesh::Point> normals;              ///< at rest
  std::vector<float> occlusion;                  ///< see mesh/cavity.h
  ModelLooks looks;                              ///< empty where the file says nothing
};

/// attributes: null for none. Linear time, a third of a second for a million triangles, and what images take.
/// Thread-safe.
ModelShading shading_of(std::shared_ptr<const mesh::Surface> surface, const mesh::Attributes* attributes);

class ModelLayer {
public:
  explicit ModelLayer(const render::Gl& gl) : surface_(gl), shadow_(gl), strokes_(gl) {}

  /// New topology, at rest.
  void set_document(const scene::Document& document, const ModelShading& shading);
  void set_rest(const scene::Document& document, const ModelShading& shading);
  /// Deformed, relative to origin in the file's coordinates.
  void set_model(std::span<const deform::FrameVertex> vertices, const mesh::Point& origin);
  /// What the mesh is coloured by: its mask where that is shown, else the field, if there are values of it.
  /// Says whether that is another one than before.
  bool set_colors(const scene::Workspace& workspace, lab::Field field, const scene::FieldView& shown);
  /// The next set_colors() uploads them anew.
  void forget() { colored_.reset(); }
  /// Of the surface's style: what the colours span.
  void span(render::SurfaceStyle& style, const scene::FieldView& shown) const;

  void draw(const render::View& view, const render::Theme& theme, const render::SurfaceStyle& style) const {
    surface_.draw(view, theme, style);
    if (colored_ && colored_->strokes) strokes_.draw(view, {1.25f, 0.75f, 0});
  }
  void draw_shadow(const render::View& view, const render::Theme& theme, const render::ShadowStyle& style) {
    shadow_.draw(view, theme, style);
  }

private:
  void set_strokes(std::span<const mesh::Point> ends);

  render::SurfaceLayer surface_;
  render::ShadowLayer shadow_;
  render::LineLayer strokes_;
  std::size_t vertices_ = 0;
  // What the model is coloured by; nothing: it is to be uploaded anew.
  struct Colored {
    bool by_mask = false, dark = false;
    deform::Mask mask;
    std::shared_ptr<const std::vector<float>> field;
    std::shared_ptr<const std::vector<mesh::Point>> strokes;
    bool symmetric = false;
    friend bool operator==(const Colored&, const Colored&) = default;
  };
  std::optional<Colored> colored_;
};

}  // namespace viete::app
