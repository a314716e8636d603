// Mixing shapes of the model.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "base/worker_pool.h"
#include "deform/shape_space.h"
#include "scene/document/timeline.h"

namespace viete::scene {

struct ShapeTerm {
  SharedShape shape;  ///< null: rest
  double factor;
};

/// The blended shape, positioned by `held`, or in straight lines if that is null. A vertex that is at rest in
/// all terms stays exactly at rest.
SharedShape blended(const deform::LogSpace& space, std::span<const deform::LogTerm> terms,
                    const deform::Held* held, base::WorkerPool& pool);

/// Keeps exactly flat what is flat at rest, in the plane of two axes, and in all terms.
void keep_flat(const std::vector<mesh::Point>& rest, std::span<const deform::LogTerm> terms,
               std::span<mesh::Point> positions);

/// The rest shape plus the weighted shapes, in log space or linearly. A single shape with factor 1, or none,
/// is returned bit for bit. Throws base::Error if a shape does not fit the model.
SharedShape mixed(const deform::ShapeSpace& space, std::span<const ShapeTerm> terms, bool straight,
                  base::WorkerPool& pool, std::vector<std::string>* notes = nullptr);

/// Messages about shapes for the user, one line each.
std::vector<std::string> shape_notes(std::span<const deform::ShapeReport> reports);

}  // namespace viete::scene
