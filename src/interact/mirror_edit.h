// Copies a pose between the sides of a symmetric cage. Hidden vertices do not move.
#pragma once

#include "document/document.h"
#include "document/mirror.h"

namespace viete::interact {

/// Moves the mirror partner of each vertex in leading_vertices() to the mirror image of the vertex. A vertex
/// on the mirror plane moves to the nearest point of the plane. Undoable.
void copy_to_other_side(document::Document& document, const document::Mirror& mirror);

/// Swaps the poses of both sides, for the selected vertices and their partners or, if no vertex is selected,
/// for all vertices. Undoable.
void swap_sides(document::Document& document, const document::Mirror& mirror);

/// Moves each vertex to its entry in `positions`, and its mirror partner to the mirror image. If the partner
/// is also in `vertices`, the partner moves to its own entry. `mirror` may be null. Undoable.
void paste_pose(document::Document& document, std::span<const std::uint32_t> vertices,
                std::span<const mesh::Point> positions, const document::Mirror* mirror);

}  // namespace viete::interact
