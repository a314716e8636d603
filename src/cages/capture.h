// The part of a capture around which a cage is made.
#pragma once

#include <memory>
#include <string>

#include "mesh/splats.h"
#include "mesh/surface.h"

namespace viete::cages {

struct CaptureCore {
  std::shared_ptr<const mesh::Surface> surface;  ///< some of the points
  std::string note;                              ///< how many splats are left out; empty if none are
};

/// Leaves out splats with an opacity below 0.05, and lonely splats: those with fewer than 3 others within 5
/// times the usual distance to the nearest splat. If no two different points are left, keeps all.
/// Thread-safe.
CaptureCore core_of(std::shared_ptr<const mesh::Surface> capture, const mesh::Splats& splats);

}  // namespace viete::cages
