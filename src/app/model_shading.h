// What drawing a model needs besides its surface, computed once per model.
#pragma once

#include <memory>
#include <vector>

#include "app/model_looks.h"
#include "mesh/surface.h"

namespace viete::app {

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
