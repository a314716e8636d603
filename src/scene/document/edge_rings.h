// Edge rings of a cage: edges that lie opposite of each other in quads, one after the other.
#pragma once

#include "deform/cage.h"
#include "scene/document/selection.h"

namespace viete::scene {

/// With the rings that the selected edges are of; of vertices the edges between them. Two triangles that make
/// a good quad together (cages/extraction.h) count as one, so that rings run through cages that once were
/// quads. Faces and probes are as they were. O(n log n).
Selection ringed(const deform::Cage& cage, const Selection& selection);

}  // namespace viete::scene
