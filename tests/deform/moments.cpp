// Maps fitted to points.
#include "deform/moments.h"

#include <doctest/doctest.h>

#include "deform/bind.h"
#include "deform/binding.h"
#include "deform/bound.h"
#include "deform/exact.h"

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

// A square in an oblique plane.
mesh::Surface sheet(int cells) {
  std::vector<mesh::Point> p;
  std::vector<mesh::Triangle> t;
  const auto at = [&](int i, int j) { return static_cast<std::uint32_t>(i * (cells + 1) + j); };
  for (int i = 0; i <= cells; ++i) {
    for (int j = 0; j <= cells; ++j) {
      const double u = 2.0 * i / cells - 1, v = 2.0 * j / cells - 1;
      p.push_back({u, v, 0.3 * u - 0.2 * v});
      if (i == cells || j == cells) continue;
      t.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      t.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  }
  return mesh::from_triangles(p, t);
}

struct Engines {
  Engines(const mesh::Surface& model, const mesh::Surface& cage, const Scheme& scheme)
      : staged(model, cage, scheme.weighting, 2, scheme.blend),
        fused(staged.cage,
              std::make_shared<const Binding>(
                  bind(model, *staged.cage, scheme.weighting, EngineKind::fused, nullptr, staged.pool)),
              scheme, staged.pool) {}

  // Deviation of the fused frame from the mapped model, in diagonals of the posed cage.
  template <class Map>
  double fused_error(const Map& map) {
    const Pose pose = staged.pose(map);
    fused.deform(pose, sym3::Method::fast);
    return largest_distance(fused.positions(), mapped(staged.model.positions, map)) /
           mesh::bounds(pose.positions).diagonal();
  }

  Bound staged;
  Deformer fused;
};

template <class Body>
void for_schemes(const Body& body) {
  for (const Weights kind : kinds) {
    for (const Blend fit : fitted_blends) {
      const Scheme scheme{{Elements::point, kind}, fit};
      CAPTURE(text(scheme));
      body(scheme);
    }
  }
}

// The largest factor by which an edge of the model grows.
double longest_edge(const mesh::Surface& model, const std::vector<mesh::Point>& posed) {
  double most = 0;
  for (const auto& t : model.triangles) {
    for (int i = 0; i < 3; ++i) {
      const auto a = t[i], b = t[(i + 1) % 3];
      most = std::max(most, norm(posed[b] - posed[a]) / norm(model.positions[b] - model.positions[a]));
    }
  }
  return most;
}

}  // namespace

TEST_CASE("maps_fitted_to_points_are_exact_far_from_the_origin") {
  const Vec3 far{3e4, -2e4, 1e4};
  const auto moved = [&](const mesh::Surface& s) {
    auto there = s;
    for (auto& p : there.positions) p = p + far;
    return there;
  };
  for_schemes([&](const Scheme& scheme) {
    Engines e(moved(limb()), moved(limb_cage()), scheme);
    const auto from_there = [&](const Affine& map) {
      return [&, map](const Vec3& x) { return map(x - far) - far; };
    };
    const Affine motion = similarity({1, -2, 3}, 130 * degree, 1, {10, 20, 30});
    const Affine similar = similarity({1, -2, 3}, 130 * degree, 1.7, {10, 20, 30});
    CHECK(e.staged.error(from_there(motion)) < 1e-10);
    CHECK(e.fused_error(from_there(motion)) < 1e-6);
    CHECK((e.staged.error(from_there(similar)) < 1e-10) == (scheme.blend != Blend::mls_rigid));
    CHECK((e.staged.error(from_there(shear())) < 1e-10) == (scheme.blend == Blend::mls_affine));
    if (scheme.blend == Blend::mls_affine) CHECK(e.fused_error(from_there(shear())) < 5e-6);
  });
}

TEST_CASE("a_flat_cage_determines_all_directions") {
  for_schemes([&](const Scheme& scheme) {
    Engines e(together(tube(14, 24, 0.1, 0.6), sheet(20)), sheet(4), scheme);
    const auto motion = similarity({1, -2, 3}, 130 * degree, 1, {1, 2, 3});
    CHECK(e.staged.error(motion) < 1e-12);
    CHECK(e.fused_error(motion) < 5e-6);
    const auto wave = [](const Vec3& x) { return x + Vec3{0, 0, 0.2 * std::sin(3 * x[0])}; };
    const auto bent = e.staged.deform(e.staged.pose(wave));
    CHECK(mesh::bounds(bent).diagonal() < 2 * mesh::bounds(e.staged.model.positions).diagonal());
  });
}

TEST_CASE("a_thin_cage_keeps_the_model_near") {
  for_schemes([&](const Scheme& scheme) {
    const double thickness = 1e-5;
    Engines e(limb(), box({0.5, 0.5, thickness}), scheme);
    auto pose = rest_pose(*e.staged.cage);
    for (std::size_t i = 0; i < pose.positions.size(); ++i) pose.positions[i][i % 3] += i % 2 ? 0.1 : -0.1;
    const auto posed = e.staged.deform(pose);
    CHECK(all_finite(posed));
    CHECK(mesh::bounds(posed).diagonal() < 10 * mesh::bounds(e.staged.model.positions).diagonal());
  });
}

TEST_CASE("fitted_maps_of_collapsed_and_mirrored_cages_are_finite_in_both_engines") {
  const auto dot = [](const Vec3&) { return Vec3{1, 2, 3}; };
  const auto line = [](const Vec3& x) { return Vec3{0, x[1], 0}; };
  const auto mirror = [](const Vec3& x) { return Vec3{x[0], x[1], -x[2]}; };
  for_schemes([&](const Scheme& scheme) {
    Engines e(limb(), limb_cage(), scheme);
    const auto check = [&](const auto& map) {
      const Pose pose = e.staged.pose(map);
      const auto staged = e.staged.deform(pose);
      CHECK(all_finite(staged));
      e.fused.deform(pose, sym3::Method::fast);
      const auto fused = e.fused.positions();
      CHECK(all_finite(fused));
      // A rotation preserves lengths, whichever of several is chosen.
      const double limit = 2 * mesh::bounds(e.staged.model.positions).diagonal() + 10;
      CHECK(mesh::bounds(staged).diagonal() < limit);
      CHECK(mesh::bounds(fused).diagonal() < limit);
    };
    check(dot), check(line), check(mirror);
    if (scheme.blend == Blend::mls_affine) CHECK(e.staged.error(mirror) < 1e-12);
  });
}

// If one cage point has all the weight, only its surroundings determine the rotation.
TEST_CASE("vertices_of_a_single_point_rotate_with_its_surroundings") {
  const Twist twist{2, {0, 0, 0}, -1.7, 1.7, -80 * degree, 80 * degree};
  for_schemes([&](const Scheme& scheme) {
    Engines e(limb(), limb_cage(), scheme);
    const auto posed = e.staged.deform(e.staged.pose(twist));
    CHECK(longest_edge(e.staged.model, posed) <
          (scheme.weighting.weights == Weights::harmonic ? 4 : 2) *
              longest_edge(e.staged.model, mapped(e.staged.model.positions, twist)));
  });
}

TEST_CASE("fitted_maps_follow_a_vertex_without_jumps") {
  for_schemes([&](const Scheme& scheme) {
    Engines e(limb(), limb_cage(), scheme);
    Pose pose = e.staged.pose(Twist{2, {0, 0, 0}, -1.7, 1.7, 0, 90 * degree});
    const std::uint32_t vertex[] = {20};
    std::vector<mesh::Point> before;
    e.fused.deform(pose, sym3::Method::fast);
    e.fused.begin_drag(vertex);
    for (int step = 0; step < 40; ++step) {
      pose.positions[20] = pose.positions[20] + Vec3{-0.03, 0.01, 0.005};
      e.fused.deform(pose, sym3::Method::fast);
      const auto now = e.fused.positions();
      if (!before.empty()) CHECK(largest_distance(now, before) < 0.2);
      before = now;
    }
    CHECK(largest_distance(before, e.staged.deform(pose)) < 2e-5 * e.staged.cage->diagonal);
  });
}

TEST_CASE("fitted_maps_are_exported_as_shown_and_ignore_amounts") {
  const Twist twist{2, {0, 0, 0}, -1.7, 1.7, -80 * degree, 80 * degree};
  for_schemes([&](const Scheme& scheme) {
    Engines e(limb(), limb_cage(), scheme);
    const Pose pose = e.staged.pose(twist);
    const auto shown = e.staged.deform(pose);
    const auto exact =
        deform_exactly(e.staged.model, e.staged.cage, scheme, pose, sym3::Method::fast, e.staged.pool);
    CHECK(largest_distance(exact.positions, shown) < 1e-12 * e.staged.cage->diagonal);
    e.fused.deform(pose, sym3::Method::fast);
    CHECK(e.fused.sampled_error() < 1e-6);
    CHECK(e.fused.sampled_error() > 0);
    e.staged.deformer.set_amounts({0.5, 2});
    CHECK(largest_distance(e.staged.deform(pose), shown) == 0);
  });
}

TEST_CASE("fitted_maps_have_the_same_bits_for_every_instruction_set_and_storage") {
  for (const Blend fit : fitted_blends) {
    const Scheme scheme{{Elements::point, Weights::cut_off, 0.4}, fit};
    CAPTURE(text(scheme));
    Bound b(limb(), limb_cage(), scheme.weighting, 2, fit);
    const Pose pose = b.pose(Twist{2, {0, 0, 0}, -1.7, 1.7, -80 * degree, 120 * degree});
    b.deform(pose);
    const auto frame = [&](Storage storage, const sym3::Kernel& kernel, int threads) {
      base::WorkerPool pool(threads);
      const auto tiles = std::make_shared<const TiledBinding>(
          bind_tiles(b.model, *b.cage, scheme.weighting, pool, 0, nullptr, storage));
      FusedFrame fused(b.cage, tiles, pool, kernel, fit);
      fused.deform(pose);
      std::vector<mesh::Point> positions;
      for (const auto& v : fused.vertices())
        positions.push_back(fused.origin() + Vec3{v.position[0], v.position[1], v.position[2]});
      return positions;
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
