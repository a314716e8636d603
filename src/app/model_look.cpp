#include "app/model_look.h"

#include <utility>

#include "mesh/cavity.h"
#include "mesh/normals.h"

namespace viete::app {

ModelLook look_of(std::shared_ptr<const mesh::Surface> surface) {
  ModelLook look;
  const auto& positions = surface->positions;
  look.normals.resize(positions.size());
  const auto around = mesh::vertex_triangles(positions.size(), surface->triangles);
  mesh::vertex_normals(positions, surface->triangles, around, 0, positions.size(), look.normals);
  look.occlusion = mesh::bake_cavity(positions, look.normals, surface->triangles);
  look.surface = std::move(surface);
  return look;
}

}  // namespace viete::app
