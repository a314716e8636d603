// The cage about the dragon: rings of vertices along body, neck, head and tail, legs and wings drawn out of
// it.
#pragma once

#include <vector>

#include "dragon/mesh.h"

namespace viete::dragon {

/// Numbers of vertices that belong together, counter-clockwise seen from the end of the limb.
using Ring = std::vector<std::uint32_t>;

/// The cage and the names of its rings.
struct Cage {
  Mesh mesh;
  std::vector<Ring> tail;   ///< from the tip to the rump
  std::vector<Ring> trunk;  ///< rump, middle, chest; each top, left side, left below, right below, right side
  std::vector<Ring> neck;   ///< from the chest to the head
  Ring crown, muzzle;       ///< behind and before the head
  Ring feet[4];             ///< hind left, hind right, front left, front right
  Ring wing_hands[2], wing_tips[2];  ///< left, right
};

/// Closed, of genus 0, oriented outwards; 76 vertices, 148 triangles.
Cage dragon_cage();

}  // namespace viete::dragon
