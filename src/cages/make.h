// Makes a cage of any kind around a model; box cages.
#pragma once

#include <memory>

#include "base/progress.h"
#include "base/worker_pool.h"
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
  /// Quick: all work is left to the first make(). Throws base::Error if the model is a single point or has
  /// none.
  explicit Maker(std::shared_ptr<const mesh::Surface> model);
  ~Maker();
  Maker(Maker&&) noexcept;
  Maker& operator=(Maker&&) noexcept;

  /// A closed, oriented manifold without self-intersection that encloses every triangle of the model, or
  /// every point where it has none, at about the wished distance. Same bits for any pool. Any length scale
  /// from 1e-60 to 1e60. What is wished beyond its range counts as the end of the range. progress may be
  /// null; throws base::Cancelled, after which the next wish may be made.
  Made make(const Wish& wish, base::WorkerPool& pool, base::Progress* progress = nullptr);

private:
  struct Kept;
  std::unique_ptr<Kept> kept_;
};

/// Once: see Maker.
Made make(const mesh::Surface& model, const Wish& wish, base::WorkerPool& pool,
          base::Progress* progress = nullptr);

}  // namespace viete::cages
