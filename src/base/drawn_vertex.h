// A vertex of a frame. Kernels for several instruction sets include this file: it must not have functions.
#pragma once

#include <array>
#include <cstdint>

namespace viete::base {

using PackedNormal = std::array<std::int16_t, 2>;  ///< see pack_normal()

/// A vertex of a frame, in the layout of the GPU.
struct alignas(16) DrawnVertex {
  float position[3];    ///< relative to the frame's origin
  PackedNormal normal;  ///< (0, 0, 1) if the triangles around the vertex have no area
};

}  // namespace viete::base
