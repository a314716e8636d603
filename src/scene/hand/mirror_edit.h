// Copying a pose between the sides of a symmetric cage.
#pragma once

#include "scene/document/document.h"
#include "scene/document/mirror.h"

namespace viete::scene {

/// Moves the partners of the selected vertices to the mirror images; if both are selected, the source is the
/// side of leading_vertices(). Vertices on the plane are projected onto it. Undoable.
void copy_to_other_side(Document& document, const Mirror& mirror);

/// Swaps the selected vertices and their partners, or all if nothing is selected, with mirroring. Undoable.
void swap_sides(Document& document, const Mirror& mirror);

/// Moves the vertices to these positions, one each, and their partners, unless listed themselves, to the
/// mirror images. Undoable. mirror may be null.
void paste_pose(Document& document, std::span<const std::uint32_t> vertices,
                std::span<const mesh::Point> positions, const Mirror* mirror);

}  // namespace viete::scene
