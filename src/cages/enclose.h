// A cage brought to its model: orientation, size and place, then moved outward where the model sticks out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "mesh/surface.h"

namespace viete::cages {

/// A cage that a similarity has brought to its model.
struct Fitted {
  std::vector<mesh::Point> positions;                                      ///< of the cage's vertices
  std::array<mesh::Vec3, 3> linear = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< rotation and scale, by rows
  double degrees = 0;                                                      ///< that it was turned by
};

/// Moved, and scaled by the same factor along all axes, so that its box is the model's and `margin` of the
/// model's diagonal more on each side, as far as their proportions allow: it is nowhere smaller. Requires
/// that both have an extent.
Fitted fitted_to_box(const mesh::Surface& cage, const mesh::Surface& model, double margin);

struct Enclosing {
  std::vector<mesh::Point> positions;  ///< of the cage's vertices
  std::size_t left = 0;                ///< vertices of the model that are still outside
};

/// Moves triangles of the cage outward by what model vertices are beyond them, and `margin` of the model's
/// diagonal more, in some rounds; those that are near the model without cutting it stay. Requires a closed
/// cage.
Enclosing enclose(const mesh::Surface& cage, const mesh::Surface& model, double margin);

struct SnappedOutside {
  std::vector<mesh::Point> positions;  ///< of the cage's vertices
  std::size_t moved = 0, left = 0;     ///< vertices that went out, and that are still within or too near
};

/// Moves those of the vertices that are within the model, or nearer to it than `margin` of its diagonal, by
/// the shortest way out, and as far beyond; in some rounds, where that leads into another part of it. Others,
/// and those that find no way, stay where they are. Of a model that is open, within is where winding numbers
/// say so. The model has an extent and triangles.
SnappedOutside snap_outside(const mesh::Surface& cage, std::span<const std::uint32_t> vertices,
                            const mesh::Surface& model, double margin);

/// Turned so that samples of both surfaces are as near to the other surface as they can be, and then fitted
/// to the model's box, see fitted_to_box(); not turned, where that is nearly as good. Never mirrored. Both
/// have an extent, and the cage has triangles.
///
/// Starts at the 24 ways in which axes of inertia can be laid upon each other, and as the cage is; from each
/// go iterated closest points, both ways. Sources: Besl and McKay 1992, A method for registration of 3-D
/// shapes; Umeyama 1991, Least-squares estimation of transformation parameters between two point patterns.
/// progress may be null; throws base::Cancelled. Thread-safe; the same bits each time.
Fitted best_fit(const mesh::Surface& cage, const mesh::Surface& model, double margin,
                base::Progress* progress = nullptr);

}  // namespace viete::cages
