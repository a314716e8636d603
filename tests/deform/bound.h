// Binds models to cages, deforms the models, and checks weights.
#pragma once

#include <doctest/doctest.h>
#include <memory>

#include "deform/exact.h"
#include "deform/frame_deformer.h"
#include "pose/deformer.h"
#include "support/caged_shapes.h"
#include "weights/bind.h"
#include "weights/binding.h"

namespace viete::test {

inline constexpr Weighting faces{}, mean_values{Elements::point, Weights::mean_value},
    harmonics{Elements::face, Weights::harmonic}, biharmonics{Elements::face, Weights::biharmonic};
inline Weighting cut_off(double radius) {
  return {Elements::face, Weights::cut_off, radius};
}
/// Returns deformers in which every vertex follows the cage. The radius of cut-off weights is large enough.
inline std::vector<Deformer> whole_deformers() {
  auto deformers = valid_deformers();
  for (Deformer& s : deformers) s.weighting.radius = number("radius").largest;
  return deformers;
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

  /// Returns the distance from the deformed model to the mapped model, in diagonals of the posed cage.
  template <class Map>
  double error(const Map& map) {
    const Pose p = pose(map);
    return largest_distance(deform(p), mapped(model.positions, map)) / mesh::bounds(p.positions).diagonal();
  }

  mesh::Surface model;
  std::shared_ptr<const Cage> cage;
  base::WorkerPool pool;
  std::shared_ptr<const Binding> binding;
  FrameDeformer deformer;
};

/// Returns a binding of the bound model with these tiles.
inline std::shared_ptr<const Binding> with_tiles(const Bound& bound,
                                                 std::shared_ptr<const TiledBinding> tiles) {
  return std::make_shared<const Binding>(
      weights::with_tiles(mesh::lent(bound.model), *bound.cage, std::move(tiles)));
}

/// A fused engine and the state of its cage.
struct FusedFrame {
  FusedFrame(std::shared_ptr<const Cage> cage, std::shared_ptr<const Binding> binding, base::WorkerPool& pool,
             const sym3::Kernel& kernel = sym3::kernel(), Blend blend = Blend::srl)
      : state(std::move(cage), binding->weighting.elements, blend),
        engine(std::move(binding), state.rows().form, pool, kernel) {}

  void deform(const Pose& pose) {
    state.set_pose(pose);
    engine.run(state);
  }
  std::vector<mesh::Point> positions() const {
    std::vector<mesh::Point> result;
    for (const auto& v : engine.vertices())
      result.push_back(state.rows().origin + Vec3{v.position[0], v.position[1], v.position[2]});
    return result;
  }
  std::vector<mesh::Point> normals() const {
    std::vector<mesh::Point> result;
    for (const auto& v : engine.vertices()) result.push_back(viete::base::unpack_normal(v.normal));
    return result;
  }

  CageState state;
  FusedEngine engine;
};

/// A deformer in all engines that support it.
struct Frames {
  Frames(const mesh::Surface& model, const mesh::Surface& cage, const Deformer& deformer_, int threads = 2)
      : deformer(deformer_),
        staged(model, cage, deformer.weighting, threads, deformer.blend),
        fused(staged.cage,
              std::make_shared<const Binding>(weights::bind(mesh::lent(staged.model), *staged.cage,
                                                            deformer.weighting, EngineKind::fused, nullptr,
                                                            staged.pool)),
              deformer, staged.pool,
              deformer.stitched()
                  ? std::make_shared<const Stitching>(stitch(model, *staged.cage, staged.pool, deformer))
                  : nullptr) {}

  void set_mask(const Mask& mask_) {
    mask = mask_;
    staged.deformer.set_mask(mask);
    fused.set_mask(mask);
  }
  void set_shape(const SharedShape& shape_) {
    shape = shape_;
    staged.deformer.set_shape(shape);
    fused.set_shape(shape);
  }
  void set_probes(const Probes& probes_) {
    probes = probes_;
    staged.deformer.set_probes(probes);
    fused.set_probes(probes);
  }

  /// Returns the exact result, and checks that all engines agree with it.
  std::vector<mesh::Point> deform(const Pose& pose) {
    const auto exact = deform_exactly(staged.model, staged.cage, deformer, pose, sym3::Method::fast,
                                      staged.pool, nullptr, mask, probes, shape);
    const double far = std::max(staged.cage->diagonal, mesh::bounds(pose.positions).diagonal());
    fused.deform(pose, sym3::Method::fast);
    CHECK(fused.ran() == (deformer.stitched() ? EngineKind::stitched : EngineKind::fused));
    CHECK(largest_distance(fused.positions(), exact.positions) < 2e-5 * far);
    CHECK(fused.sampled_error() < 3e-5);
    if (!deformer.stitched()) CHECK(largest_distance(staged.deform(pose), exact.positions) < 1e-12 * far);
    return exact.positions;
  }

  Deformer deformer;
  Mask mask;
  SharedShape shape;
  Probes probes;
  Bound staged;
  FrameDeformer fused;
};

}  // namespace viete::test
