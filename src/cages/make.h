// Makes a cage of any kind around a model; box cages.
#pragma once

#include <memory>
#include <optional>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/subject.h"
#include "cages/wish.h"
#include "mesh/surface.h"

namespace viete::cages {

/// The sides of a box as quads, cells[0] x cells[1] x cells[2], wish.margin away from the model's box along
/// the file's axes or, with own_axes, along the axes of inertia. The model must have an extent.
Made make_box(const mesh::Surface& model, const Wish& wish);

/// Makes several cages around one model. Keeps its plane of symmetry and tree of triangles between calls.
/// Gives the same cages as the function make(). Not thread-safe.
class Maker {
public:
  /// Quick: the first make() does the work. Throws base::Error if the model is a single point or has no
  /// points.
  explicit Maker(std::shared_ptr<const mesh::Surface> model);
  /// A closed, oriented manifold without self-intersection that encloses every triangle of the model, or
  /// every point of a model without triangles, at about the requested distance. Same bits for any pool. Any
  /// length scale from 1e-60 to 1e60. Values of the wish are clamped to their ranges. progress may be null;
  /// throws base::Cancelled, after which make() may be called again.
  Made make(const Wish& wish, base::WorkerPool& pool, base::Progress* progress = nullptr);

private:
  std::optional<Plane> plane_of(Symmetry symmetry, base::Progress* progress);
  const Subject& subject_with(const std::optional<Plane>& mirror, base::Progress* progress);

  std::shared_ptr<const mesh::Surface> model_;
  mesh::Bounds box_;
  std::optional<std::optional<Plane>> own_plane_;  // empty until first computed
  std::unique_ptr<const Subject> subject_;         // belongs to the last wish
};

/// Once: see Maker.
Made make(const mesh::Surface& model, const Wish& wish, base::WorkerPool& pool,
          base::Progress* progress = nullptr);

}  // namespace viete::cages
