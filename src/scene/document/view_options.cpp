#include "scene/document/view_options.h"

namespace viete::scene {

std::span<const ShadingChoice> all_shadings() {
  static constexpr ShadingChoice all[] = {
      {"clay", "Clay", "Show the mesh in one calm colour."},
      {"porcelain", "Porcelain", "Show the mesh white and glazed: its reflections tell how smooth it is."},
      {"jade", "Jade", "Show the mesh as if light went through it: soft forms, bright rims."},
      {"file", "As it is",
       "Show the colours, materials and textures of the mesh's file; clay where it has none."},
      {"checker", "Checker",
       "Show squares along the texture coordinates, to see how the deformation stretches them."},
      {"normals", "Normals", "Show where the mesh faces: x as red, y as green, z as blue."},
      {"zebra", "Zebra", "Show mirrored stripes, which bend with the curvature and break where it does."}};
  return all;
}

}  // namespace viete::scene
