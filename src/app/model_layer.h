// The model in one view: its surface, colours and shadow.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deform/binding.h"
#include "deform/rows.h"
#include "lab/field.h"
#include "mesh/formats/attributes.h"
#include "mesh/surface.h"
#include "render/mark_layers.h"
#include "render/shadow_layer.h"
#include "render/surface_layer.h"
#include "scene/workspace/workspace.h"

namespace viete::app {

struct ModelLooks {
  std::vector<mesh::Triangle> triangles;  ///< triangles of the surface, grouped by look
  render::SurfaceLooks looks;             ///< one look per group
  bool has_looks = false;                 ///< it has colours, images, or materials that are not grey
  std::vector<std::string> warnings;      ///< about images that cannot be shown, one line each
};

/// normals: of the vertices at rest. Decodes images and reads external image files; a damaged image is
/// skipped. Triangles are flat shaded if their group is flat in the file, or if the file's normals are
/// perpendicular to them. Thread-safe.
ModelLooks looks_of(const mesh::Surface& surface, const mesh::Attributes& attributes,
                    std::span<const mesh::Point> normals);

/// Data for drawing a model besides its surface, computed once per model.
struct ModelShading {
  std::shared_ptr<const mesh::Surface> surface;  ///< the model it belongs to; null: none
  std::vector<base::PackedNormal> normals;       ///< at rest
  std::vector<float> occlusion;                  ///< see mesh/cavity.h
  ModelLooks looks;                              ///< empty if the file has no materials
  std::vector<mesh::Triangle> coarse;            ///< for motion; empty: draw all
};

/// A model with more than `moving` triangles gets coarse ones. Linear time, on all processors, plus decoding
/// images. Thread-safe.
ModelShading shading_of(const scene::OpenedSurface& model, std::size_t moving);

class ModelLayer {
public:
  explicit ModelLayer(const render::Gl& gl) : surface_(gl), shadow_(gl) {}

  /// New topology, at rest.
  void set_document(const scene::Document& document, const ModelShading& shading);
  void set_rest(const scene::Document& document, const ModelShading& shading);
  /// Deformed positions, relative to origin in file coordinates.
  void set_model(std::span<const deform::FrameVertex> vertices, const mesh::Point& origin);
  /// Colours the mesh by its mask if that is shown, else by the field if it has values. Returns true on a
  /// change.
  bool set_colors(const scene::Workspace& workspace, lab::Field field, const scene::FieldView& shown);
  /// Forces an upload in the next set_colors().
  void forget() { colored_.reset(); }
  /// Sets the colour range in the surface's style.
  void span(render::SurfaceStyle& style, const scene::FieldView& shown) const;

  void draw(const render::View& view, const render::Theme& theme, const render::SurfaceStyle& style) const {
    surface_.draw(view, theme, style);
  }
  void draw_shadow(const render::View& view, const render::Theme& theme, const render::ShadowStyle& style) {
    shadow_.draw(view, theme, style);
  }

private:
  render::SurfaceLayer surface_;
  render::ShadowLayer shadow_;
  std::size_t vertices_ = 0;
  // The current colouring; nullopt: upload again.
  struct Colored {
    bool by_mask = false, dark = false;
    deform::Mask mask;
    std::shared_ptr<const std::vector<float>> field;
    bool symmetric = false;
    friend bool operator==(const Colored&, const Colored&) = default;
  };
  std::optional<Colored> colored_;
};

}  // namespace viete::app
