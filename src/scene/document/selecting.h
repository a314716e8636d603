// Operations on selections: grow, shrink, loops. They work on any cage, including open and non-manifold ones,
// and leave selected probes unchanged.
#pragma once

#include <span>

#include "deform/cage.h"
#include "scene/document/selection.h"

namespace viete::scene {

/// Grows by one ring: adds vertices connected by an edge, or edges or faces that share a vertex.
Selection grown(const deform::Cage& cage, const Selection& selection);
/// Shrinks by one ring. Boundaries of an open cage stay.
Selection shrunk(const deform::Cage& cage, const Selection& selection);

/// Extends the selection to loops, which start at edges or at two vertices joined by an edge; faces are
/// unchanged. Loops go straight through quads at vertices of four edges, and along the boundary of an open
/// cage; elsewhere they take the straightest edge if it turns by less than 60 degrees at rest.
Selection looped(const deform::Cage& cage, const Selection& selection);

}  // namespace viete::scene
