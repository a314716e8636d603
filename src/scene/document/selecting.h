// Selections made from selections: grown, shrunk, run along loops, what is similar, and one side of the
// model. Of cages of any kind, open ones and such with edges of many faces too. Probes are as they were.
#pragma once

#include <span>

#include "deform/cage.h"
#include "scene/document/selection.h"

namespace viete::scene {

/// With what is next to it: vertices that an edge joins to it, edges and faces that share a vertex with it.
Selection grown(const deform::Cage& cage, const Selection& selection);
/// Without what is next to what is not selected. Rims of an open cage stay.
Selection shrunk(const deform::Cage& cage, const Selection& selection);

/// With the loops that what is selected begins: edges go on through vertices, two vertices that an edge joins
/// too, and two neighbouring faces across their sides. Through quads a loop goes straight on, as long as four
/// edges meet, and along the rim of an open cage; elsewhere the straightest way, if it turns by less than 60
/// degrees at rest.
Selection looped(const deform::Cage& cage, const Selection& selection);

/// Everything of the kind that is like one that is selected: vertices with as many edges, edges as long,
/// faces as large, within a tenth.
Selection similar(const deform::Cage& cage, std::span<const mesh::Point> positions,
                  const Selection& selection);
/// Faces that look the way that a selected one does, edges that are parallel to one, within 15 degrees;
/// vertices stay as they are.
Selection facing(const deform::Cage& cage, std::span<const mesh::Point> positions,
                 const Selection& selection);

/// What is at rest on one side of the plane across an axis of the file at `middle`: not beyond it with any
/// vertex, and not in it with all.
Selection on_side(const deform::Cage& cage, ElementKind kind, int axis, bool positive, double middle);

}  // namespace viete::scene
