// Three poses of the dragon's cage.
#pragma once

#include <string>
#include <vector>

#include "dragon/cage.h"

namespace viete::dragon {

struct Pose {
  std::string name, comment;
  Mesh mesh;  ///< the cage's own vertices and triangles, moved
};

std::vector<Pose> dragon_poses(const Cage& cage);

}  // namespace viete::dragon
