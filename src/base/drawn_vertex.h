// The vertices of a frame. Shared with vector code: no functions here.
#pragma once

#include <array>
#include <cstdint>

namespace viete::base {

using PackedNormal = std::array<std::int16_t, 2>;  ///< see pack_normal()

/// One vertex of a frame, as a graphics card takes it.
struct alignas(16) DrawnVertex {
  float position[3];    ///< relative to the frame's origin
  PackedNormal normal;  ///< (0, 0, 1) where there is no area
};

}  // namespace viete::base
