// Copying a pose between the sides of a symmetric cage.
#pragma once

#include "document/document.h"
#include "document/mirror.h"

namespace viete::interact {

/// Moves the mirror partners of leading_vertices() to the mirror images of these vertices. Projects vertices
/// on the mirror plane onto the plane. Undoable.
void copy_to_other_side(document::Document& document, const document::Mirror& mirror);

/// Swaps the poses of both sides, for the selected vertices and their partners. Without a selection, swaps
/// all vertices. Undoable.
void swap_sides(document::Document& document, const document::Mirror& mirror);

/// Moves each vertex to its position, and its mirror partner to the mirror image. A partner that is itself in
/// `vertices` gets its own position. `mirror` may be null. Undoable.
void paste_pose(document::Document& document, std::span<const std::uint32_t> vertices,
                std::span<const mesh::Point> positions, const document::Mirror* mirror);

}  // namespace viete::interact
