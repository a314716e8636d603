// A triangle mesh as the generator passes it on from step to step.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "dragon/vec3.h"

namespace viete::dragon {

/// Triangles counter-clockwise seen from outside.
struct Mesh {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, 3>> triangles;
};

}  // namespace viete::dragon
