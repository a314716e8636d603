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

/// Moves all of them up or down, until the lowest are on y = 0.
inline void stand_on_ground(std::vector<Vec3>& positions) {
  double lowest = positions[0].y;
  for (const Vec3& p : positions) lowest = std::min(lowest, p.y);
  for (Vec3& p : positions) p.y -= lowest;
}

}  // namespace viete::dragon
