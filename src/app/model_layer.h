// The model in one view: its surface, colours and shadow.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "analysis/field.h"
#include "formats/attributes.h"
#include "mesh/drawing.h"
#include "mesh/splats.h"
#include "mesh/surface.h"
#include "pose/rows.h"
#include "render/mark_layers.h"
#include "render/shadow_layer.h"
#include "render/splat_layer.h"
#include "render/surface_layer.h"
#include "weights/binding.h"
#include "workspace/workspace.h"

namespace viete::app {

struct ModelLooks {
  std::vector<mesh::Triangle> triangles;  ///< triangles of the surface, sorted by material, then by shading
  render::SurfaceLooks looks;             ///< one run for each combination of material and shading
  std::vector<mesh::Triangle> draft_triangles;  ///< the same for the draft, with the images of `looks`
  render::SurfaceLooks draft_looks;
  bool has_looks = false;             ///< true if the model has colours, images or coloured materials
  std::vector<std::string> warnings;  ///< one line for each image that cannot be shown
};

/// Converts colours, materials and images. Reads image files; skips damaged images. `normals` are the vertex
/// normals at rest. A triangle gets flat shading if its group is flat in the file, or if its corner normals
/// in the file equal the face normal and a vertex normal does not. A draft's triangles have the looks of the
/// triangles that they replace; `draft` may be null. Thread-safe.
ModelLooks looks_of(const mesh::Surface& surface, const formats::Attributes& attributes,
                    std::span<const mesh::Point> normals, const mesh::Draft* draft = nullptr);

/// The splats of a capture at rest.
struct ModelSplats {
  std::shared_ptr<const render::SplatLooks> looks;
  std::vector<render::SplatShape> shapes;
};

/// Converts the splats of a capture. The result shares the harmonics. Quaternions of length 0 are no
/// rotation. Thread-safe.
ModelSplats splats_of(const std::shared_ptr<const mesh::Splats>& splats);

/// Data for drawing a model, computed once per model.
struct ModelShading {
  std::shared_ptr<const mesh::Surface> surface;  ///< the model, or null
  std::vector<base::PackedNormal> normals;       ///< vertex normals at rest
  std::vector<float> occlusion;                  ///< see mesh/drawing.h
  ModelLooks looks;                              ///< empty if the file has no materials
  std::shared_ptr<const mesh::Draft> draft;      ///< to draw in motion; null: draw the model itself
  std::shared_ptr<const ModelSplats> splats;     ///< null if the model is not a capture
  std::size_t draft_step = 1;  ///< in motion, draws every draft_step-th splat; 1 without splats
  double spacing = 0;          ///< without triangles: see mesh::point_spacing()

  bool has_draft() const { return draft || draft_step > 1; }
};

/// If the model has more than `moving` triangles, or a capture more than a fraction of it, adds a draft.
/// Takes linear time on all processors, plus the time to decode images. Thread-safe.
ModelShading shading_of(const document::OpenedSurface& model, std::size_t moving);

class ModelLayer {
public:
  explicit ModelLayer(const render::Gl& gl) : surface_(gl), coarse_(gl), shadow_(gl), gl_(gl) {}

  /// Sets the model of the document, at rest.
  void set_document(const document::Document& document, const ModelShading& shading);
  void set_rest(const document::Document& document, const ModelShading& shading);
  /// Sets the deformed vertices, relative to origin.
  void set_model(std::span<const pose::FrameVertex> vertices, const mesh::Point& origin);
  /// Sets the deformed splats of a capture, relative to origin. See render::SplatLayer.
  void set_splats(std::span<const pose::FrameVertex> vertices, const mesh::Point& origin,
                  std::span<const render::SplatShape> shapes, std::span<const render::SplatTurn> turns) {
    splats_->set_splats(vertices, origin, shapes, turns);
    shadow_.set_vertices(vertices, origin);
  }
  bool is_capture() const { return splats_.has_value(); }
  /// Sets the deformed vertices of the draft. There must be a draft.
  void set_draft(std::span<const pose::FrameVertex> vertices, const mesh::Point& origin) {
    coarse_.set_vertices(vertices, origin);
    shadow_.set_vertices(vertices, origin);
  }
  /// If the mask is shown, colours the mesh by the mask. Otherwise, colours the mesh by the field if `shown`
  /// has values of this field. Returns true if the colours change.
  bool set_colors(const workspace::Workspace& workspace, analysis::Field field,
                  const workspace::FieldView& shown);
  /// The next set_colors() uploads the colours even if they have not changed.
  void forget() { colored_.reset(); }
  /// Sets in `style` whether the mesh has colours, and the range of the colour map.
  void span(render::SurfaceStyle& style, const workspace::FieldView& shown) const;

  /// If `coarse`, draws the draft.
  void draw(const render::View& view, const render::Theme& theme, const render::SurfaceStyle& style,
            bool coarse);
  void draw_shadow(const render::View& view, const render::Theme& theme, const render::ShadowStyle& style) {
    shadow_.draw(view, theme, style);
  }

private:
  std::shared_ptr<const mesh::Draft> draft_;
  render::SurfaceLayer surface_, coarse_;  // coarse_: the draft; empty without a draft
  render::ShadowLayer shadow_;             // the shadow of the draft or, without a draft, of the model
  std::size_t vertices_ = 0;
  const render::Gl& gl_;
  std::optional<render::SplatLayer> splats_;    // nullopt if the model is not a capture
  std::shared_ptr<const ModelSplats> capture_;  // null if the model is not a capture
  std::size_t draft_step_ = 1;
  double spacing_ = 0;
  // The input of the current colours.
  struct Colored {
    bool by_mask = false, dark = false;
    weights::Mask mask;
    std::shared_ptr<const std::vector<float>> field;
    bool symmetric = false;
    friend bool operator==(const Colored&, const Colored&) = default;
  };
  std::optional<Colored> colored_;
};

}  // namespace viete::app
