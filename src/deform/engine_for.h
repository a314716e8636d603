// Which engine makes the frames of a scheme.
#pragma once

#include "deform/scheme.h"
#include "sym3/exp.h"

namespace viete::deform {

/// Stitched schemes have an engine of their own. The fused one knows method `fast` alone, and all that takes
/// no exponential; the staged one runs the others, and `fast` too on the same path as these.
EngineKind engine_for(const Scheme& scheme, sym3::Method method, bool same_path = false);

}  // namespace viete::deform
