// How a model looks by what its file says, as the graphics card takes it: computed once per model, aside.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/surface.h"
#include "render/surface_layer.h"

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

}  // namespace viete::app
