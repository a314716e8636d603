// Makes a cage of any kind around a model; boxes.
#pragma once

#include <memory>

#include "base/progress.h"
#include "base/worker_pool.h"
#include "cages/wish.h"
#include "mesh/surface.h"

namespace viete::cages {

/// The sides of a box as quads, cells[0] x cells[1] x cells[2], wish.margin away from the model's own box,
/// which is along the file's axes or, with own_axes, along those of its inertia. The model has an extent.
Made make_box(const mesh::Surface& model, const Wish& wish);

/// Makes cages around one model, one after another: where its plane of symmetry is and the tree over its
/// triangles are kept from one wish to the next. The same cages as by make(). For one thread at a time.
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
