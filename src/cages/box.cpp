#include "cages/box.h"

#include <cstdint>
#include <map>

#include "cages/frame.h"
#include "mesh/triangulation.h"

namespace viete::cages {

namespace {

using Cell = std::array<std::size_t, 3>;

// The surface of a grid of cells, corners numbered as they come.
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
    for (std::size_t i = 0; i < cells_[u]; ++i) {
      for (std::size_t j = 0; j < cells_[v]; ++j) {
        Cell corner{};
        corner[axis] = at;
        const auto add = [&](std::size_t du, std::size_t dv) {
          corner[u] = i + du;
          corner[v] = j + dv;
          surface_.corners.push_back(vertex(corner));
        };
        const bool high = at > 0;  // seen from outside, u to v is counter-clockwise there
        add(0, 0);
        add(high ? 1 : 0, high ? 0 : 1);
        add(1, 1);
        add(high ? 0 : 1, high ? 1 : 0);
        surface_.polygon_starts.push_back(static_cast<std::uint32_t>(surface_.corners.size()));
      }
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

}  // namespace viete::cages
