#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr Blend fitted_blends[] = {Blend::mls_affine, Blend::mls_similarity, Blend::mls_rigid};
constexpr Weights kinds[] = {Weights::inverse, Weights::harmonic, Weights::biharmonic};

mesh::Surface limb() {
  return tube(14, 24, 0.3, 3);
}
mesh::Surface limb_cage() {
  return tube(6, 9, 0.5, 3.4);
}

// Returns a square in an oblique plane.
mesh::Surface sheet(std::uint32_t cells) {
  return mapped(grid(cells), [=](const Vec3& x) {
    const double u = 2 * x[0] / cells - 1, v = 2 * x[1] / cells - 1;
    return Vec3{u, v, 0.3 * u - 0.2 * v};
  });
}

// Returns the distance from the fused frame to the mapped model, in diagonals of the posed cage.
template <class Map>
double fused_error(Frames& f, const Map& map) {
  const Pose pose = f.staged.pose(map);
  f.fused.deform(pose, sym3::Method::fast);
  return largest_distance(f.fused.positions(), mapped(f.staged.model.positions, map)) /
         mesh::bounds(pose.positions).diagonal();
}

template <class Body>
void for_deformers(const Body& body) {
  for (const Weights kind : kinds)
    for (const Blend fit : fitted_blends) {
      const Deformer deformer{{Elements::point, kind}, fit};
      CAPTURE(text(deformer));
      body(deformer);
    }
}

}  // namespace

TEST_CASE("maps_fitted_to_points_are_exact_far_from_the_origin") {
  const Vec3 far{3e4, -2e4, 1e4};
  const auto moved = [&](const mesh::Surface& s) { return mapped(s, scaling(1, far)); };
  for_deformers([&](const Deformer& deformer) {
    Frames e(moved(limb()), moved(limb_cage()), deformer);
    const auto from_there = [&](const Affine& map) {
      return [&, map](const Vec3& x) { return map(x - far) - far; };
    };
    const Affine motion = similarity({1, -2, 3}, 130 * degree, 1, {10, 20, 30});
    const Affine similar = similarity({1, -2, 3}, 130 * degree, 1.7, {10, 20, 30});
    CHECK(e.staged.error(from_there(motion)) < 1e-10);
    CHECK(fused_error(e, from_there(motion)) < 1e-6);
    CHECK((e.staged.error(from_there(similar)) < 1e-10) == (deformer.blend != Blend::mls_rigid));
    CHECK((e.staged.error(from_there(shear())) < 1e-10) == (deformer.blend == Blend::mls_affine));
    if (deformer.blend == Blend::mls_affine) CHECK(fused_error(e, from_there(shear())) < 5e-6);
  });
}

TEST_CASE("a_flat_cage_determines_all_directions") {
  for_deformers([&](const Deformer& deformer) {
    Frames e(together(tube(14, 24, 0.1, 0.6), sheet(20)), sheet(4), deformer);
    const auto motion = similarity({1, -2, 3}, 130 * degree, 1, {1, 2, 3});
    CHECK(e.staged.error(motion) < 1e-12);
    CHECK(fused_error(e, motion) < 5e-6);
    const auto wave = [](const Vec3& x) { return x + Vec3{0, 0, 0.2 * std::sin(3 * x[0])}; };
    const auto bent = e.staged.deform(e.staged.pose(wave));
    CHECK(mesh::bounds(bent).diagonal() < 2 * mesh::bounds(e.staged.model.positions).diagonal());
  });
}

TEST_CASE("fitted_maps_of_thin_collapsed_and_mirrored_cages_are_finite_in_both_engines") {
  const auto dot = [](const Vec3&) { return Vec3{1, 2, 3}; };
  const auto line = [](const Vec3& x) { return Vec3{0, x[1], 0}; };
  const auto mirror = [](const Vec3& x) { return Vec3{x[0], x[1], -x[2]}; };
  for_deformers([&](const Deformer& deformer) {
    const auto check = [](Frames& e, const Pose& pose, double limit) {
      e.fused.deform(pose, sym3::Method::fast);
      for (const auto& posed : {e.staged.deform(pose), e.fused.positions()}) {
        CHECK(all_finite(posed));
        CHECK(mesh::bounds(posed).diagonal() < limit);
      }
    };
    Frames e(limb(), limb_cage(), deformer);
    // Several rotations may be possible. All of them preserve lengths.
    const double size = mesh::bounds(e.staged.model.positions).diagonal(), limit = 2 * size + 10;
    check(e, e.staged.pose(dot), limit);
    check(e, e.staged.pose(line), limit);
    check(e, e.staged.pose(mirror), limit);
    if (deformer.blend == Blend::mls_affine) CHECK(e.staged.error(mirror) < 1e-12);
    Frames thin(limb(), box({0.5, 0.5, 1e-5}), deformer);
    Pose pose = rest_pose(*thin.staged.cage);
    for (std::size_t i = 0; i < pose.positions.size(); ++i) pose.positions[i][i % 3] += i % 2 ? 0.1 : -0.1;
    const auto posed = thin.staged.deform(pose);
    CHECK(all_finite(posed));
    CHECK(mesh::bounds(posed).diagonal() < 10 * size);
  });
}

// If one cage point has all the weight, the patch around this point determines the rotation.
TEST_CASE("vertices_of_a_single_point_rotate_with_its_surroundings") {
  const Twist twist{2, {0, 0, 0}, -1.7, 1.7, -80 * degree, 80 * degree};
  for_deformers([&](const Deformer& deformer) {
    Frames e(limb(), limb_cage(), deformer);
    const auto posed = e.staged.deform(e.staged.pose(twist));
    CHECK(largest_edge_stretch(e.staged.model, posed) <
          (deformer.weighting.weights == Weights::harmonic ? 4 : 2) *
              largest_edge_stretch(e.staged.model, mapped(e.staged.model.positions, twist)));
  });
}

TEST_CASE("fitted_maps_follow_a_vertex_without_jumps_in_all_engines_and_ignore_amounts") {
  for_deformers([&](const Deformer& deformer) {
    Frames e(limb(), limb_cage(), deformer);
    Pose pose = e.staged.pose(Twist{2, {0, 0, 0}, -1.7, 1.7, 0, 90 * degree});
    auto before = e.deform(pose);
    CHECK(e.fused.sampled_error() > 0);
    CHECK(e.fused.sampled_error() < 1e-6);
    e.fused.begin_drag(std::array{20u});
    for (int step = 0; step < 40; ++step) {
      pose.positions[20] = pose.positions[20] + Vec3{-0.03, 0.01, 0.005};
      e.fused.deform(pose, sym3::Method::fast);
      const auto now = e.fused.positions();
      CHECK(largest_distance(now, before) < 0.2);
      before = now;
    }
    const auto shown = e.deform(pose);
    e.staged.deformer.set_amounts({0.5, 2});
    CHECK(largest_distance(e.staged.deform(pose), shown) < 1e-12 * e.staged.cage->diagonal);
  });
}

TEST_CASE("fitted_maps_have_the_same_bits_for_every_instruction_set_and_storage") {
  for (const Blend fit : fitted_blends) {
    const Deformer deformer{{Elements::point, Weights::cut_off, 0.4}, fit};
    CAPTURE(text(deformer));
    Bound b(limb(), limb_cage(), deformer.weighting, 2, fit);
    const Pose pose = b.pose(Twist{2, {0, 0, 0}, -1.7, 1.7, -80 * degree, 120 * degree});
    b.deform(pose);
    const auto frame = [&](Storage storage, const sym3::Kernel& kernel, int threads) {
      base::WorkerPool pool(threads);
      const auto tiles = std::make_shared<const TiledBinding>(
          bind_tiles(b.model, *b.cage, deformer.weighting, pool, 0, nullptr, storage));
      FusedFrame fused(b.cage, with_tiles(b, tiles), pool, kernel, fit);
      fused.deform(pose);
      return fused.positions();
    };
    for (const auto& kernel : sym3::kernels()) {
      CAPTURE(kernel.name);
      const auto alike = std::ranges::find_if(
          sym3::kernels(), [&](const sym3::Kernel& other) { return other.fused == kernel.fused; });
      const auto lists = frame(Storage::lists, kernel, 1);
      CHECK(lists == frame(Storage::dense, *alike, 3));
      CHECK(largest_distance(lists, b.deformer.positions()) < 1e-6 * b.cage->diagonal);
    }
  }
}
