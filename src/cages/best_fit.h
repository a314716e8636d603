// A cage of another orientation, size and place, brought to its model.
#pragma once

#include "base/progress.h"
#include "cages/enclose.h"

namespace viete::cages {

/// Turned so that samples of both surfaces are as near to the other surface as they can be, and then fitted
/// to the model's box, see fitted_to_box(); not turned, where that is nearly as good. Never mirrored. Both
/// have an extent, and the cage has triangles.
///
/// Starts at the 24 ways in which axes of inertia can be laid upon each other, and as the cage is; from each
/// go iterated closest points, both ways. Sources: Besl and McKay 1992, A method for registration of 3-D
/// shapes; Umeyama 1991, Least-squares estimation of transformation parameters between two point patterns.
/// progress may be null; throws base::Cancelled. Thread-safe; the same bits each time.
Fitted best_fit(const mesh::Surface& cage, const mesh::Surface& model, double margin,
                base::Progress* progress = nullptr);

}  // namespace viete::cages
