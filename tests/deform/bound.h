// Models bound to cages, and checks of their weights.
#pragma once

#include <doctest/doctest.h>
#include <memory>
#include <numeric>

#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/deformer.h"
#include "deform/scheme.h"
#include "deform/shapes.h"

namespace viete::test {

inline constexpr Weighting faces{}, mean_values{Elements::point, Weights::mean_value},
    harmonics{Elements::face, Weights::harmonic}, biharmonics{Elements::face, Weights::biharmonic};
inline Weighting cut_off(double radius) {
  return {Elements::face, Weights::cut_off, radius};
}
/// All schemes in which every vertex follows the cage; cut-off weights with a radius that reaches everywhere.
inline std::vector<Scheme> whole_schemes() {
  auto schemes = valid_schemes();
  for (Scheme& s : schemes) s.weighting.radius = largest_radius;
  return schemes;
}

struct Bound {
  Bound(const mesh::Surface& model_, const mesh::Surface& cage_surface, const Weighting& weighting = faces,
        int threads = 2, Blend blend = Blend::srl)
      : model(model_),
        cage(std::make_shared<const Cage>(make_cage(cage_surface))),
        pool(threads),
        binding(std::make_shared<const Binding>(bind(model, *cage, weighting, pool))),
        deformer(cage, binding, {weighting, blend}, pool) {}

  std::vector<mesh::Point> deform(const Pose& pose, sym3::Method method = sym3::Method::fast) {
    deformer.deform(pose, method);
    return deformer.positions();
  }

  const LogReport& report() const { return deformer.state().report(); }

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

/// The fused engine alone, with a state of its own.
struct FusedFrame {
  FusedFrame(std::shared_ptr<const Cage> cage, const std::shared_ptr<const TiledBinding>& tiles,
             base::WorkerPool& pool, const sym3::Kernel& kernel = sym3::kernel(), Blend blend = Blend::srl)
      : state(std::move(cage), tiles->weighting.elements, blend),
        engine(tiles, state.rows().form, pool, kernel) {}

  void deform(const Pose& pose) {
    state.set_pose(pose);
    engine.run(state);
  }
  std::span<const FrameVertex> vertices() const { return engine.vertices(); }
  Vec3 origin() const { return state.rows().origin; }

  CageState state;
  FusedEngine engine;
};

/// Checks that weights_at(cage, point) is independent of scale, and sums to one at the cage's own vertices.
template <class WeightsAt>
void check_every_length_scale(const WeightsAt& weights_at) {
  const auto unit = box({1, 2, 3});
  const Cage cage = make_cage(unit);
  Random random(5);
  for (const double s : {1e-30, 1e-3, 1e3, 1e30}) {
    auto scaled = unit;
    for (auto& p : scaled.positions) p = s * p;
    const Cage other = make_cage(scaled);
    for (int n = 0; n < 50; ++n) {
      const Vec3 p = random.vector(4);
      const auto a = weights_at(cage, p), b = weights_at(other, s * p);
      for (std::size_t e = 0; e < a.size(); ++e) CHECK(a[e] == doctest::Approx(b[e]).epsilon(1e-10));
    }
    for (const auto& p : scaled.positions) {
      const auto w = weights_at(other, p);
      CHECK(std::accumulate(w.begin(), w.end(), 0.0) == doctest::Approx(1));
    }
  }
}

}  // namespace viete::test
