#include "cages/make.h"

#include "base/error.h"
#include "cages/automatic.h"
#include "cages/box.h"

namespace viete::cages {

namespace {

std::optional<Plane> plane_of(const mesh::Surface& model, const mesh::Bounds& box, Symmetry symmetry) {
  if (symmetry == Symmetry::none) return std::nullopt;
  if (symmetry == Symmetry::automatic) return symmetry_plane(model);
  const auto axis = static_cast<std::size_t>(symmetry) - static_cast<std::size_t>(Symmetry::x);
  Plane plane{{0, 0, 0}, box.center()[axis]};
  plane.normal[axis] = 1;
  return plane;
}

}  // namespace

Made make(const mesh::Surface& model, const Wish& wish, base::WorkerPool& pool, base::Progress* progress) {
  const mesh::Bounds box = model.triangles.empty() ? mesh::bounds(model.positions) : mesh::used_bounds(model);
  if (!(box.diagonal() > 0))
    throw base::Error("", "the model is a single point, around which no cage is made",
                      "open a model with an extent");
  if (wish.kind == Kind::box) return make_box(model, wish);
  if (wish.kind == Kind::hull) return make_hull(model, wish, pool);
  return make_automatic(model, wish, plane_of(model, box, wish.symmetry), pool, progress);
}

}  // namespace viete::cages
