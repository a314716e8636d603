// How exact the running method is at every vertex of the frame, computed aside.
#pragma once

#include <span>
#include <vector>

#include "base/progress.h"
#include "scene/workspace/frame_stats.h"
#include "sym3/exp.h"
#include "sym3/sym3.h"

namespace viete::app {

struct ErrorMap {
  std::vector<float> log10;  ///< per matrix; an exact answer counts as 1e-20, NaN as 1
  scene::ErrorMapStats stats;
};

/// Relative Frobenius errors against sym3's reference of 106 bits, some 2 us each. Throws base::Cancelled.
/// Thread-safe.
ErrorMap error_map(std::span<const sym3::Sym3<double>> matrices, sym3::Method method,
                   base::Progress* progress = nullptr);

}  // namespace viete::app
