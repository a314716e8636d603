// Operations on selections: grow, shrink, loops, similar elements, one side of the model. They work on any
// cage, including open and non-manifold ones, and leave selected probes unchanged.
#pragma once

#include <span>

#include "deform/cage.h"
#include "scene/document/selection.h"

namespace viete::scene {

/// Grows by one ring: adds vertices connected by an edge, or edges or faces that share a vertex.
Selection grown(const deform::Cage& cage, const Selection& selection);
/// Shrinks by one ring. Boundaries of an open cage stay.
Selection shrunk(const deform::Cage& cage, const Selection& selection);

/// Extends the selection to loops, which start at edges, at two vertices joined by an edge, or at two
/// neighbouring faces. Loops go straight through quads at vertices of four edges, and along the boundary of
/// an open cage; elsewhere they take the straightest edge if it turns by less than 60 degrees at rest.
Selection looped(const deform::Cage& cage, const Selection& selection);

/// All elements similar to a selected one, within a tenth: vertices by edge count, edges by length, faces by
/// area.
Selection similar(const deform::Cage& cage, std::span<const mesh::Point> positions,
                  const Selection& selection);
/// Faces with the orientation of a selected one, edges parallel to a selected one, within 15 degrees;
/// vertices are unchanged.
Selection facing(const deform::Cage& cage, std::span<const mesh::Point> positions,
                 const Selection& selection);

/// Elements on one side of the plane at `middle` of an axis, at rest: no vertex beyond the plane, and not all
/// in it.
Selection on_side(const deform::Cage& cage, ElementKind kind, int axis, bool positive, double middle);

}  // namespace viete::scene
