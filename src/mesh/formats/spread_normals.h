// Normals of a file that serve several vertices, as many as these are.
#pragma once

#include <cstdint>
#include <vector>

#include "mesh/formats/attributes.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// Each of a file's normals once for every vertex whose corners use it, or for every polygon where the file
/// asks for flat faces: these may differ once the surface is deformed.
struct SpreadNormals {
  std::vector<Vec3> normals;
  std::vector<std::uint32_t> first;      ///< of each of the file's normals, one or more each; and the end
  std::vector<std::uint32_t> of_corner;  ///< or none

  /// attributes has normals and indices of corners.
  SpreadNormals(const Surface& surface, const Attributes& attributes);
};

}  // namespace viete::mesh
