#include "app/model_shading.h"

#include <utility>

#include "mesh/cavity.h"
#include "mesh/normals.h"

namespace viete::app {

ModelShading shading_of(std::shared_ptr<const mesh::Surface> surface, const mesh::Attributes* attributes) {
  ModelShading shading;
  const auto& positions = surface->positions;
  shading.normals.resize(positions.size());
  const auto around = mesh::vertex_triangles(positions.size(), surface->triangles);
  mesh::vertex_normals(positions, surface->triangles, around, 0, positions.size(), shading.normals);
  shading.occlusion = mesh::bake_cavity(positions, shading.normals, surface->triangles);
  if (attributes) shading.looks = looks_of(*surface, *attributes, shading.normals);
  shading.surface = std::move(surface);
  return shading;
}

}  // namespace viete::app
