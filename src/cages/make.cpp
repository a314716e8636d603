#include "cages/make.h"

#include <algorithm>
#include <cstdint>
#include <map>

#include "base/error.h"
#include "base/text.h"
#include "cages/automatic.h"
#include "mesh/triangulation.h"

namespace viete::cages {

namespace {

using Cell = std::array<std::size_t, 3>;

// Makes the surface of a box. Divides each side of the box into quads.
class Lattice {
public:
  Lattice(const Frame& frame, const mesh::Bounds& box, const Cell& cells)
      : frame_(frame), box_(box), cells_(cells) {
    surface_.polygon_starts.push_back(0);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      side(axis, 0);
      side(axis, cells[axis]);
    }
    mesh::triangulate(surface_);
  }

  mesh::Surface take() { return std::move(surface_); }

private:
  void side(std::size_t axis, std::size_t at) {
    const std::size_t u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::size_t i = 0; i < cells_[u]; ++i)
      for (std::size_t j = 0; j < cells_[v]; ++j) {
        Cell corner{};
        corner[axis] = at;
        const auto add = [&](std::size_t du, std::size_t dv) {
          corner[u] = i + du;
          corner[v] = j + dv;
          surface_.corners.push_back(vertex(corner));
        };
        const bool high = at > 0;  // if true, u to v is counter-clockwise as seen from outside
        add(0, 0);
        add(high ? 1 : 0, high ? 0 : 1);
        add(1, 1);
        add(high ? 0 : 1, high ? 1 : 0);
        surface_.polygon_starts.push_back(static_cast<std::uint32_t>(surface_.corners.size()));
      }
  }

  std::uint32_t vertex(const Cell& corner) {
    const auto [found, is_new] = numbers_.try_emplace(corner, static_cast<std::uint32_t>(numbers_.size()));
    if (is_new) {
      Point p;
      for (std::size_t k = 0; k < 3; ++k) {
        const double t = static_cast<double>(corner[k]) / static_cast<double>(cells_[k]);
        p[k] = (1 - t) * box_.low[k] + t * box_.high[k];
      }
      surface_.positions.push_back(frame_.out_of(p));
    }
    return found->second;
  }

  const Frame& frame_;
  mesh::Bounds box_;
  Cell cells_;
  std::map<Cell, std::uint32_t> numbers_;
  mesh::Surface surface_;
};

Wish in_range(Wish wish) {
  wish.triangles = std::clamp(wish.triangles, least_triangles, most_triangles);
  wish.margin = std::clamp(wish.margin, least_margin, most_margin);
  wish.gap = std::clamp(wish.gap, 0.0, most_gap);
  for (auto& n : wish.cells) n = std::clamp<std::size_t>(n, 1, most_cells);
  return wish;
}

Made box_instead(const mesh::Surface& model, Wish wish) {
  wish.cells = {1, 1, 1};
  wish.own_axes = false;
  Made made = make_box(model, wish);
  made.notes.push_back("the model does not fit into a cage of " + base::counted(wish.triangles, "triangle") +
                       ", so a box was made; use more triangles");
  return made;
}

void section(base::Progress* progress, double from, double to) {
  if (progress) progress->section(from, to);
}

}  // namespace

Made make_box(const mesh::Surface& model, const Wish& wish) {
  const Frame frame = wish.own_axes ? own_frame(model) : frame_of(model, std::nullopt);
  mesh::Bounds box = model_in(frame, model).box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.low[k] -= wish.margin;
    box.high[k] += wish.margin;
  }
  Made made;
  made.surface = Lattice(frame, box, wish.cells).take();
  return made;
}

std::optional<Plane> Maker::plane_of(Symmetry symmetry, base::Progress* progress) {
  if (symmetry == Symmetry::none) return std::nullopt;
  if (symmetry == Symmetry::automatic) {
    if (!own_plane_) own_plane_ = symmetry_plane(*model_, progress);
    return *own_plane_;
  }
  const auto axis = static_cast<std::size_t>(symmetry) - static_cast<std::size_t>(Symmetry::x);
  Plane plane{{0, 0, 0}, box_.center()[axis]};
  plane.normal[axis] = 1;
  return plane;
}

const Subject& Maker::subject_with(const std::optional<Plane>& mirror, base::Progress* progress) {
  if (!subject_ || subject_->mirror != mirror) {
    subject_.reset();
    subject_ = std::make_unique<const Subject>(*model_, mirror, progress);
  }
  return *subject_;
}

Maker::Maker(std::shared_ptr<const mesh::Surface> model)
    : model_(std::move(model)), box_(extent_of(*model_)) {
  if (!(box_.diagonal() > 0))
    throw base::Error("", "the model is a single point, so no cage can be made",
                      "open a model with more than one point");
}

Made Maker::make(const Wish& asked, base::WorkerPool& pool, base::Progress* progress) {
  const Wish wish = in_range(asked);
  if (wish.kind == Kind::box) return make_box(*model_, wish);
  section(progress, 0, 0.05);
  const auto mirror = plane_of(wish.symmetry, progress);
  section(progress, 0.05, 0.1);
  const Subject& subject = subject_with(mirror, progress);
  section(progress, 0.1, 1);
  std::optional<Made> made = make_automatic(subject, wish, pool, progress);
  section(progress, 1, 1);
  return made ? *std::move(made) : box_instead(*model_, wish);
}

Made make(const mesh::Surface& model, const Wish& wish, base::WorkerPool& pool, base::Progress* progress) {
  return Maker(mesh::lent(model)).make(wish, pool, progress);
}

}  // namespace viete::cages
