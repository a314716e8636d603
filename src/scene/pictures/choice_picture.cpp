#include "scene/pictures/choice_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "deform/bind.h"
#include "deform/exact.h"
#include "mesh/triangulation.h"

namespace viete::scene {

namespace {

using mesh::Point, mesh::Vec3;

constexpr double degree = std::numbers::pi / 180;

// A model in a posed cage.
struct Example {
  mesh::Surface model;
  std::shared_ptr<const deform::Cage> cage;
  deform::Pose pose;
};

Example example(mesh::Surface model, mesh::Surface cage) {
  const auto made = std::make_shared<const deform::Cage>(deform::make_cage(std::move(cage)));
  return {std::move(model), made, deform::rest_pose(*made)};
}

template <class Choice>
deform::Scheme scheme_with(Choice choice) {
  return deform::complete(deform::only(choice), deform::default_scheme());
}

std::vector<Point> deformed(const Example& e, const deform::Scheme& scheme) {
  base::WorkerPool alone(1);
  return deform::deform_exactly(e.model, e.cage, scheme, e.pose, sym3::Method::fast, alone).positions;
}

template <class Shapes>
void add(ChoicePicture& picture, Shapes shapes) {
  std::ranges::move(shapes, std::back_inserter(picture.shapes));
}

// Weights example: a fork whose prong is posed at the end.

constexpr double held_from = 6.7, between_prongs = 2;

Example fork() {
  const auto model = [](int x, int y, int) { return x < 9 || y < 5 || y >= 7; };
  const auto cage = [](int x, int y, int) { return x == 0 || y != 1; };
  return example(
      lattice_surface({even(0, 10, 30), even(0, 4, 12), {-0.2, 0.2}}, model),
      lattice_surface({{-0.25, 3.25, held_from, 10.25}, {-0.25, 1.85, 2.15, 4.25}, {-0.45, 0.45}}, cage));
}

bool held(const Point& p) {
  return p[0] > held_from && p[1] > between_prongs;
}

// The total weight of the posed part at each vertex.
std::vector<float> held_weights(const Example& e, const deform::Weighting& weighting) {
  base::WorkerPool alone(1);
  const deform::Binding binding = deform::bind(e.model, *e.cage, weighting, alone);
  const auto centers = deform::handle_centers(*e.cage, weighting.elements);
  std::vector<float> sums;
  for (std::size_t v = 0; v < binding.vertices; ++v) {
    double sum = 0;
    for (std::size_t h = 0; h < binding.handles; ++h) {
      if (held(centers[h])) sum += binding.weights[v * binding.handles + h];
    }
    if (!binding.shares.empty()) sum *= binding.shares[v];
    sums.push_back(static_cast<float>(std::clamp(sum, 0.0, 1.0)));
  }
  return sums;
}

std::vector<PictureShape> weighed_model(const PictureView& view, const mesh::Surface& model,
                                        const std::vector<float>& weights) {
  std::vector<PictureShape> shapes;
  for (const std::size_t p : facing(view, model, model.positions)) {
    shapes.push_back(area(view, Ink::weight, model, p, model.positions));
    for (auto c = model.polygon_starts[p + 1]; c-- > model.polygon_starts[p];)
      shapes.back().tones.push_back(weights[model.corners[c]]);
  }
  return shapes;
}

// Blend example: a bar between two posed ends.

constexpr double grip = 1.9, twist = 150 * degree, arch = 55 * degree, growth = 1.8;

Example twisted_bar() {
  const Lattice grips{{-3.15, -grip, grip, 3.15}, even(-0.7, 0.7, 1), even(-0.7, 0.7, 1)};
  Example e = example(lattice_surface({even(-3, 3, 28), even(-0.5, 0.5, 4), even(-0.5, 0.5, 4)}),
                      lattice_surface(grips, [](int x, int, int) { return x != 1; }));
  const double radius = 2 * grip / arch;
  for (Point& p : e.pose.positions) {
    const double side = p[0] < 0 ? -1 : 1, size = p[0] < 0 ? 1 : growth;
    const double t = side * twist / 2, a = side * arch / 2;
    const Point q{p[0] - side * grip, size * (std::cos(t) * p[1] - std::sin(t) * p[2]),
                  size * (std::sin(t) * p[1] + std::cos(t) * p[2])};
    p = {std::cos(a) * q[0] + std::sin(a) * (q[1] + radius),
         -std::sin(a) * q[0] + std::cos(a) * (q[1] + radius), q[2]};
  }
  return e;
}

}  // namespace

ChoicePicture choice_picture(deform::Weights weights) {
  const Example e = fork();
  const auto& at = e.cage->surface.positions;
  const PictureView view({}, {at, choice_picture_size, 8});
  ChoicePicture picture{{}, "Influence of the marked end of the cage: yellow full, blue none."};
  add(picture, weighed_model(view, e.model, held_weights(e, scheme_with(weights).weighting)));
  add(picture, cage_lines(view, *e.cage, at, Ink::cage));
  for (const std::size_t p : facing(view, e.cage->surface, at)) {
    const std::size_t half = 2 * p;  // one triangle of the quad
    if (held(e.cage->centers[half])) picture.shapes.push_back(outline(view, e.cage->surface, p, at));
  }
  return picture;
}

namespace {

ChoicePicture bar_picture(const deform::Scheme& scheme) {
  const Example e = twisted_bar();
  // Some blends extend beyond the cage.
  std::vector<Point> room = e.pose.positions;
  room.push_back({0, 2 * grip / arch + 1.6, 0});
  const PictureView view({-20, 18}, {room, choice_picture_size, 8});
  ChoicePicture picture{{}, "A bar between two handles: one is twisted and larger."};
  add(picture, cage_lines(view, *e.cage, e.pose.positions, Ink::behind));
  add(picture, lit_model(view, e.model, deformed(e, scheme)));
  add(picture, cage_lines(view, *e.cage, e.pose.positions, Ink::cage));
  return picture;
}

}  // namespace

ChoicePicture choice_picture(deform::Way way) {
  return bar_picture(deform::entry(way).scheme);
}
ChoicePicture choice_picture(deform::Blend blend) {
  return bar_picture(scheme_with(blend));
}

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

  // Counter-clockwise from outside: starts along the next axis if that order faces outward.
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
  places.push_back(high);  // exact
  return places;
}

}  // namespace viete::scene
