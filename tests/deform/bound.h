// A model bound to a cage, with everything a test asks of it in one call.
#pragma once

#include <memory>

#include "deform/deformer.h"
#include "deform/shapes.h"

namespace viete::test {

struct Bound {
  Bound(const mesh::Surface& model_, const mesh::Surface& cage_surface,
        Weighting weighting = Coordinates::face, int threads = 2)
      : model(model_),
        cage(std::make_shared<const Cage>(make_cage(cage_surface))),
        pool(threads),
        binding(std::make_shared<const Binding>(bind(model, *cage, weighting, pool))),
        deformer(cage, binding, pool) {}

  std::span<const mesh::Point> deform(const Pose& pose, sym3::Method method = sym3::Method::fast) {
    deformer.deform(pose, method);
    return deformer.positions();
  }

  template <class Map>
  Pose pose(const Map& map, std::vector<Vec3> turns = {}) const {
    return {mapped(cage->surface.positions, map), std::move(turns)};
  }

  /// Distance of the deformed from the mapped model, in diagonals of the posed cage.
  template <class Map>
  double error(const Map& map) {
    const Pose p = pose(map);
    return largest_distance(deform(p), mapped(model.positions, map)) / mesh::bounds(p.positions).diagonal();
  }

  mesh::Surface model;
  std::shared_ptr<const Cage> cage;
  base::WorkerPool pool;
  std::shared_ptr<const Binding> binding;
  Deformer deformer;
};

}  // namespace viete::test
