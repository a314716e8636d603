#include "scene/pictures/lattice.h"
#include "mesh/triangulation.h"

#include <array>
#include <map>
#include <utility>

namespace viete::scene {

namespace {

using Cell = std::array<int, 3>;

class LatticeSurface {
public:
  LatticeSurface(const Lattice& lattice, const Filled& filled)
      : cuts_{lattice.x, lattice.y, lattice.z}, filled_(filled) {
    surface_.polygon_starts.push_back(0);
  }

  mesh::Surface make() {
    const Cell cells{count(0), count(1), count(2)};
    for (int z = 0; z < cells[2]; ++z) {
      for (int y = 0; y < cells[1]; ++y) {
        for (int x = 0; x < cells[0]; ++x) add_sides({x, y, z});
      }
    }
    mesh::triangulate(surface_);
    return std::move(surface_);
  }

private:
  int count(int axis) const { return static_cast<int>(cuts_[axis].size()) - 1; }

  bool filled(const Cell& c) const {
    for (int axis = 0; axis < 3; ++axis) {
      if (c[axis] < 0 || c[axis] >= count(axis)) return false;
    }
    return filled_(c[0], c[1], c[2]);
  }

  void add_sides(const Cell& cell) {
    if (!filled(cell)) return;
    for (int axis = 0; axis < 3; ++axis) {
      for (const int side : {0, 1}) {
        Cell beside = cell;
        beside[axis] += side ? 1 : -1;
        if (!filled(beside)) add_quad(cell, axis, side);
      }
    }
  }

  // Counter-clockwise from outside: along the next axis first where that looks along this one.
  void add_quad(const Cell& cell, int axis, int side) {
    constexpr std::array<std::array<int, 2>, 4> around{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    for (int i = 0; i < 4; ++i) {
      const auto& step = around[side ? i : 3 - i];
      Cell corner = cell;
      corner[axis] += side;
      corner[(axis + 1) % 3] += step[0];
      corner[(axis + 2) % 3] += step[1];
      surface_.corners.push_back(vertex(corner));
    }
    surface_.polygon_starts.push_back(static_cast<std::uint32_t>(surface_.corners.size()));
  }

  std::uint32_t vertex(const Cell& at) {
    const auto [found, added] =
        numbers_.try_emplace(at, static_cast<std::uint32_t>(surface_.positions.size()));
    if (added) surface_.positions.push_back({cuts_[0][at[0]], cuts_[1][at[1]], cuts_[2][at[2]]});
    return found->second;
  }

  std::array<std::vector<double>, 3> cuts_;
  const Filled& filled_;
  std::map<Cell, std::uint32_t> numbers_;
  mesh::Surface surface_;
};

}  // namespace

mesh::Surface lattice_surface(const Lattice& lattice, const Filled& filled) {
  return LatticeSurface(lattice, filled).make();
}

mesh::Surface lattice_surface(const Lattice& lattice) {
  return lattice_surface(lattice, [](int, int, int) { return true; });
}

std::vector<double> even(double low, double high, int steps) {
  std::vector<double> places;
  for (int i = 0; i < steps; ++i) places.push_back(low + (high - low) * i / steps);
  places.push_back(high);  // without rounding
  return places;
}

}  // namespace viete::scene
