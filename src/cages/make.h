// Makes a cage around a model.
#pragma once

#include <memory>
#include <optional>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/subject.h"
#include "cages/wish.h"
#include "mesh/surface.h"

namespace viete::cages {

/// Makes a box of quads around the model's bounding box, at the distance wish.margin. wish.cells is the
/// number of quads along each axis. The model must have at least two different points.
Made make_box(const mesh::Surface& model, const Wish& wish);

/// Makes several cages around one model. Faster than several calls of make(). Not thread-safe.
class Maker {
public:
  /// If the model does not have two different points, throws base::Error.
  explicit Maker(std::shared_ptr<const mesh::Surface> model);
  /// Makes a closed, oriented manifold without self-intersection. It encloses the model's triangles or, if
  /// there are no triangles, the points. If no such cage is found, makes a box and adds a message. The
  /// model's size must be from 1e-60 to 1e60. Clamps the values of the wish. The result does not depend on
  /// the pool. `progress` may be null. Throws base::Cancelled.
  Made make(const Wish& wish, base::WorkerPool& pool, base::Progress* progress = nullptr);

private:
  std::optional<Plane> plane_of(Symmetry symmetry, base::Progress* progress);
  const Subject& subject_with(const std::optional<Plane>& mirror, base::Progress* progress);

  std::shared_ptr<const mesh::Surface> model_;
  mesh::Bounds box_;
  std::optional<std::optional<Plane>> own_plane_;  // nullopt before the first search
  std::unique_ptr<const Subject> subject_;         // the subject for the mirror plane of the last wish
};

/// Makes a single cage. See Maker.
Made make(const mesh::Surface& model, const Wish& wish, base::WorkerPool& pool,
          base::Progress* progress = nullptr);

}  // namespace viete::cages
