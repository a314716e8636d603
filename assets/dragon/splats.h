// Gaussian splats of the dragon, as captures have them.
#pragma once

#include <cstddef>
#include <string>

#include "dragon/mesh.h"

namespace viete::dragon {

/// Returns a PLY file with `count` flat splats along the surface: the properties of B. Kerbl et al., 3D
/// Gaussian Splatting for Real-Time Radiance Field Rendering, 2023, with harmonics of degree 3. Most splats
/// are nearly opaque, every 25th is faint. Equal input gives equal bytes on every machine.
std::string splats_file(const Mesh& mesh, std::size_t count, const std::string& comment);

}  // namespace viete::dragon
