// Copying a pose between the sides of a symmetric cage.
#pragma once

#include "document/document.h"
#include "document/mirror.h"

namespace viete::interact {

/// Moves the partners of the selected vertices to the mirror images; if both are selected, the source is the
/// side of leading_vertices(). Vertices on the plane are projected onto it. Undoable.
void copy_to_other_side(document::Document& document, const document::Mirror& mirror);

/// Swaps the selected vertices and their partners, or all if nothing is selected, with mirroring. Undoable.
void swap_sides(document::Document& document, const document::Mirror& mirror);

/// Moves the vertices to these positions, one each, and their partners, unless listed themselves, to the
/// mirror images. Undoable. mirror may be null.
void paste_pose(document::Document& document, std::span<const std::uint32_t> vertices,
                std::span<const mesh::Point> positions, const document::Mirror* mirror);

}  // namespace viete::interact
