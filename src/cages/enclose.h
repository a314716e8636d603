// Fits a cage to its model by orientation, size and place, and moves it outward where the model sticks out.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "base/progress.h"
#include "mesh/surface.h"

namespace viete::cages {

/// A cage fitted to its model by a similarity transform.
struct Fitted {
  std::vector<mesh::Point> positions;                                      ///< the cage's vertices, fitted
  std::array<mesh::Vec3, 3> linear = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};  ///< rotation and scale, by rows
  double degrees = 0;                                                      ///< rotation angle
};

/// Translates and scales uniformly so that the cage's box contains the model's box plus `margin` of the
/// model's diagonal on each side, as tightly as possible. Both must have an extent.
Fitted fitted_to_box(const mesh::Surface& cage, const mesh::Surface& model, double margin);

struct Enclosing {
  std::vector<mesh::Point> positions;  ///< the cage's vertices, moved
  std::size_t left = 0;                ///< model vertices that are still outside
};

/// Iteratively moves cage triangles outward by the distance of model vertices beyond them plus `margin` of
/// the model's diagonal. Triangles near the model that do not cut it stay. Requires a closed cage.
Enclosing enclose(const mesh::Surface& cage, const mesh::Surface& model, double margin);

struct SnappedOutside {
  std::vector<mesh::Point> positions;  ///< the cage's vertices, moved
  std::size_t moved = 0, left = 0;     ///< vertices moved out; vertices still inside or too near
};

/// Moves the given vertices that are inside the model, or nearer than `margin` of its diagonal, out by the
/// shortest way plus the margin, repeatedly if that leads into another part. Other vertices, and those
/// without a way out, stay. For an open model winding numbers decide what is inside. The model must have an
/// extent and triangles.
SnappedOutside snap_outside(const mesh::Surface& cage, std::span<const std::uint32_t> vertices,
                            const mesh::Surface& model, double margin);

/// Rotates the cage so that samples of both surfaces are as close as possible to the other surface, then fits
/// it to the model's box, see fitted_to_box(). Keeps the orientation if that is nearly as good. Never
/// mirrors. Both must have an extent, and the cage must have triangles.
///
/// Runs iterated closest points in both directions from the current orientation and the 24 alignments of the
/// axes of inertia. Sources: Besl and McKay 1992, A method for registration of 3-D shapes; Umeyama 1991,
/// Least-squares estimation of transformation parameters between two point patterns. progress may be null;
/// throws base::Cancelled. Thread-safe; deterministic.
Fitted best_fit(const mesh::Surface& cage, const mesh::Surface& model, double margin,
                base::Progress* progress = nullptr);

}  // namespace viete::cages
