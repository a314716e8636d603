#include "cages/make.h"

#include <algorithm>
#include <memory>
#include <optional>

#include "base/error.h"
#include "base/quantity.h"
#include "cages/automatic.h"
#include "cages/box.h"
#include "cages/subject.h"

namespace viete::cages {

struct Maker::Kept {
  std::shared_ptr<const mesh::Surface> model;
  mesh::Bounds box;
  std::optional<std::optional<Plane>> own_plane;  // once it was looked for
  std::unique_ptr<const Subject> subject;         // of the last wish

  std::optional<Plane> plane_of(Symmetry symmetry, base::Progress* progress) {
    if (symmetry == Symmetry::none) return std::nullopt;
    if (symmetry == Symmetry::automatic) {
      if (!own_plane) own_plane = symmetry_plane(*model, progress);
      return *own_plane;
    }
    const auto axis = static_cast<std::size_t>(symmetry) - static_cast<std::size_t>(Symmetry::x);
    Plane plane{{0, 0, 0}, box.center()[axis]};
    plane.normal[axis] = 1;
    return plane;
  }

  const Subject& with(const std::optional<Plane>& mirror, base::Progress* progress) {
    if (!subject || subject->mirror != mirror) {
      subject.reset();
      subject = std::make_unique<const Subject>(*model, mirror, progress);
    }
    return *subject;
  }
};

namespace {

Wish in_range(Wish wish) {
  wish.triangles = std::clamp(wish.triangles, least_triangles, most_triangles);
  wish.margin = std::clamp(wish.margin, least_margin, most_margin);
  wish.gap = std::clamp(wish.gap, 0.0, most_gap);
  for (auto& n : wish.cells) n = std::clamp<std::size_t>(n, 1, most_cells);
  return wish;
}

// A box, with a note: no cage that follows the model was found.
Made box_instead(const mesh::Surface& model, Wish wish) {
  wish.cells = {1, 1, 1};
  wish.own_axes = false;
  Made made = make_box(model, wish);
  made.notes.push_back("no cage of " + base::counted(wish.triangles, "triangle") +
                       " that follows the model was found: this is its box; ask for more triangles");
  return made;
}

void section(base::Progress* progress, double from, double to) {
  if (progress) progress->section(from, to);
}

}  // namespace

Maker::Maker(std::shared_ptr<const mesh::Surface> model) : kept_(std::make_unique<Kept>()) {
  kept_->box = model->triangles.empty() ? mesh::bounds(model->positions) : mesh::used_bounds(*model);
  if (!(kept_->box.diagonal() > 0))
    throw base::Error("", "the model is a single point, around which no cage is made",
                      "open a model with an extent");
  kept_->model = std::move(model);
}

Maker::~Maker() = default;
Maker::Maker(Maker&&) noexcept = default;
Maker& Maker::operator=(Maker&&) noexcept = default;

Made Maker::make(const Wish& asked, base::WorkerPool& pool, base::Progress* progress) {
  const Wish wish = in_range(asked);
  if (wish.kind == Kind::box) return make_box(*kept_->model, wish);
  section(progress, 0, 0.05);
  const auto mirror = kept_->plane_of(wish.symmetry, progress);
  section(progress, 0.05, 0.1);
  const Subject& subject = kept_->with(mirror, progress);
  section(progress, 0.1, 1);
  std::optional<Made> made = make_automatic(subject, wish, pool, progress);
  section(progress, 1, 1);
  return made ? *std::move(made) : box_instead(*kept_->model, wish);
}

Made make(const mesh::Surface& model, const Wish& wish, base::WorkerPool& pool, base::Progress* progress) {
  const std::shared_ptr<const mesh::Surface> lent(std::shared_ptr<void>(), &model);
  return Maker(lent).make(wish, pool, progress);
}

}  // namespace viete::cages
