// Shapes of the model, mixed.
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

/// The shape of a sum, from where it is held or, if that is null, in straight lines. Where only rounding
/// moves a vertex that is at rest in all terms, it is at rest.
SharedShape blended(const deform::LogSpace& space, std::span<const deform::LogTerm> terms,
                    const deform::Held* held, base::WorkerPool& pool);

/// What is flat at rest, along a plane of two axes, and in all terms, is flat to the bit.
void keep_flat(const std::vector<mesh::Point>& rest, std::span<const deform::LogTerm> terms,
               std::span<mesh::Point> positions);

/// Rest and upon it each shape as often as its factor says, in log space or in straight lines. One alone, or
/// none, is that, bit for bit. Throws base::Error where a shape is none of the model.
SharedShape mixed(const deform::ShapeSpace& space, std::span<const ShapeTerm> terms, bool straight,
                  base::WorkerPool& pool, std::vector<std::string>* notes = nullptr);

/// What a person should know of shapes, one line each.
std::vector<std::string> shape_notes(std::span<const deform::ShapeReport> reports);

}  // namespace viete::scene
