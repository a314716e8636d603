// Half a cage that ends in the plane x = 0, made whole; and where a model's plane of symmetry is.
#pragma once

#include <optional>

#include "base/progress.h"
#include "cages/extraction.h"
#include "cages/plane.h"
#include "mesh/surface.h"
#include "mesh/triangle_tree.h"

namespace viete::cages {

/// The half and its image, joined where x is 0. Vertices of the half keep their numbers.
Shell whole(const Shell& half);

/// The plane about which the model is most nearly symmetric, if its image is nowhere farther from it than 2 %
/// of its diagonal: across an axis of its coordinates or of its inertia, moved to fit. Told by a few hundred
/// of its triangles' middles. progress may be null; throws base::Cancelled.
std::optional<Plane> symmetry_plane(const mesh::Surface& model, base::Progress* progress);

}  // namespace viete::cages
