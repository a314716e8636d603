// A pose carried from one side of a cage to the other.
#pragma once

#include "scene/document/document.h"
#include "scene/document/mirror.h"

namespace viete::scene {

/// The partners of the selected vertices take their places as in the mirror; where both are selected the side
/// leads that leading_vertices() says. What is on the plane is brought back to it. Undoable.
void copy_to_other_side(Document& document, const Mirror& mirror);

/// The selected vertices and their partners, or all if nothing is selected, change places as in the mirror.
/// Undoable.
void swap_sides(Document& document, const Mirror& mirror);

/// The vertices take these places, one for each, and their partners, but for those among them, the images.
/// Undoable. mirror may be null.
void paste_pose(Document& document, std::span<const std::uint32_t> vertices,
                std::span<const mesh::Point> positions, const Mirror* mirror);

}  // namespace viete::scene
