// A number that tells surfaces apart by their content, whatever their files are called.
#pragma once

#include <cstdint>

#include "mesh/surface.h"

namespace viete::mesh {

/// base::Checksum of positions and triangles: of their values and their order. Depends on the machine's byte
/// order. At the speed of memory.
std::uint64_t content_key(const Surface& surface);

}  // namespace viete::mesh
