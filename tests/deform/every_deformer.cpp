#include "deform/bound.h"
#include "support/skip.h"

using namespace viete;
using namespace viete::test;

namespace {

mesh::Surface model() {
  return together(tube(12, 12, 0.3, 3), box({1, 1, 1}, {0.5, 0, 0}));
}

mesh::Surface cage_of_a_part() {
  return tube(9, 7, 0.4, 2.2);
}

// Returns the largest difference between the engines, in diagonals of the larger cage: at rest or posed.
double difference(Frames& f, const Pose& pose) {
  f.fused.deform(pose, sym3::Method::fast);
  const double unit = std::max(f.staged.cage->diagonal, mesh::bounds(pose.positions).diagonal());
  return largest_distance(f.fused.positions(), f.staged.deform(pose)) / unit;
}

// Moves each vertex slightly, so that no result depends on a choice between equal candidates.
mesh::Surface shaken(const mesh::Surface& surface, double by) {
  Random random(11);
  return mapped(surface, [&](const Vec3& x) { return x + by * random.vector(1); });
}

}  // namespace

TEST_CASE("every_deformer_keeps_rest_and_follows_similarities" * doctest::test_suite(longer)) {
  const int every = rounds(3, 1);  // the short run tests every third pair of an angle and a scale
  const double angles[] = {0, 1e-9, 90, 179.999, 180, 270}, scales[] = {1e-3, 1, 1e3};
  for (const Deformer& deformer : whole_deformers()) {
    CAPTURE(text(deformer));
    Frames b(model(), cage_of_a_part(), deformer);
    const auto& rest = b.staged.model.positions;
    CHECK(largest_distance(b.staged.deform(rest_pose(*b.staged.cage)), rest) <
          1e-14 * b.staged.cage->diagonal);
    for (int a = 0; a < 6; ++a)
      for (int s = 0; s < 3; ++s) {
        const double angle = angles[a], scale = scales[s];
        const bool rigid = deformer.blend == Blend::mls_rigid;
        if (rigid ? scale != 1 : (a + s) % every != 0) continue;
        const auto map = similarity({1, -2, 3}, angle * degree, scale, {20 * scale, scale, -scale});
        CHECK(b.staged.error(map) < 5e-12);
        CHECK(difference(b, b.staged.pose(map)) < 1e-6);
      }
  }
}

TEST_CASE("affine_poses_are_exact_where_weights_or_blend_promise_it") {
  std::size_t exact = 0;
  for (const Deformer& deformer : whole_deformers()) {
    CAPTURE(text(deformer));
    const bool promised =
        deformer.weighting.weights == Weights::mean_value || deformer.blend == Blend::mls_affine;
    Frames b(model(), cage_of_a_part(), deformer);
    const double error = b.staged.error(shear());
    CHECK((error < 1e-12) == promised);
    CHECK(difference(b, b.staged.pose(shear())) < 5e-6);
    exact += promised;
  }
  CHECK(exact > 1);
}

TEST_CASE("moved_poses_and_twists_beyond_180_degrees_agree_as_do_mirrored_and_collapsed_ones") {
  const Twist twist{2, {0.1, 0, 0}, -1.1, 1.1, -200 * degree, 210 * degree};
  const Vec3 shift{100, -50, 25};
  const auto moved = [&](const Vec3& x) { return twist(x) + shift; };
  const auto flat = [](const Vec3& x) { return Vec3{x[0], x[1], 0}; };
  const auto mirror = [](const Vec3& x) { return Vec3{-x[0], x[1], x[2]}; };
  const auto dot = [](const Vec3&) { return Vec3{1, 2, 3}; };
  for (const Deformer& deformer : whole_deformers()) {
    CAPTURE(text(deformer));
    Frames b(model(), cage_of_a_part(), deformer);
    CHECK(difference(b, b.staged.pose(twist)) < 2e-5);
    const auto there = mapped(b.staged.deformer.positions(), [&](const Vec3& x) { return x + shift; });
    CHECK(largest_distance(b.staged.deform(b.staged.pose(moved)), there) < 1e-12);
    CHECK(difference(b, b.staged.pose(flat)) < 2e-5);
    // If several mirrored directions are equally good, the nearest rotation is not unique.
    if (deformer.blend != Blend::mls_similarity && deformer.blend != Blend::mls_rigid)
      CHECK(difference(b, b.staged.pose(mirror)) < 2e-5);
    CHECK(all_finite(b.staged.deform(b.staged.pose(dot))));
  }
}

TEST_CASE("winding_up_never_jumps_where_turns_have_logs") {
  for (const Deformer& deformer : whole_deformers()) {
    if (deformer.blend != Blend::srl) continue;
    CAPTURE(text(deformer));
    Bound b(tube(12, 8, 0.25, 1.9), cage_of_a_part(), deformer.weighting, 2, deformer.blend);
    // The cage's ends rotate by angles that differ by 30 degrees, or by equal angles up to 560 degrees.
    for (const double ahead : {15.0, 0.0}) {
      std::vector<mesh::Point> before;
      std::vector<Vec3> turns;
      const int most = ahead > 0 ? 300 : 560;
      for (int a = 0; a <= most; a += 4) {
        const Twist twist{2, {0, 0, 0}, -1.1, 1.1, (a - ahead) * degree, (a + ahead) * degree};
        const auto now = b.deform(b.pose(twist, turns));
        turns = b.report().turns;
        if (!before.empty()) CHECK(largest_distance(now, before) < 3 * 4 * degree * 0.4);
        before = now;
      }
      CHECK(norm(turns[0]) == doctest::Approx(most * degree).epsilon(0.05));
    }
  }
}

TEST_CASE("a_drag_equals_a_full_frame") {
  for (const Deformer& deformer : whole_deformers()) {
    CAPTURE(text(deformer));
    Frames b(model(), tube(20, 12, 0.6, 3), deformer);
    Pose pose = b.staged.pose(Twist{2, {0, 0, 0}, -1.5, 1.5, -20 * degree, 40 * degree});
    b.fused.deform(pose, sym3::Method::fast);
    b.fused.begin_drag(std::array{100u});
    for (int step = 0; step < 4; ++step) {
      pose.positions[100][0] += 0.03;
      CHECK(difference(b, pose) < 2e-5);
    }
  }
}

TEST_CASE("amounts_scale_rotation_and_stretch_and_zero_moves_by_centres_alone") {
  const auto turned = similarity({1, -2, 3}, 70 * degree, 1.3, {1, 2, 3});
  const auto half_and_twice = similarity({1, -2, 3}, 35 * degree, 1.3 * 1.3, {0, 0, 0});
  for (Deformer deformer : whole_deformers()) {
    if (!deformer.has_maps()) continue;
    CAPTURE(text(deformer));
    Frames b(model(), cage_of_a_part(), deformer);
    const Pose pose = b.staged.pose(turned);
    const auto whole = b.staged.deform(pose);
    const auto with = [&](double turn, double stretch) {
      for (FrameDeformer* d : {&b.staged.deformer, &b.fused}) d->set_amounts({turn, stretch});
      CHECK(difference(b, pose) < 2e-6);
      return b.staged.deform(pose);
    };
    CHECK(largest_distance(with(1, 1), whole) == 0);
    const auto other = with(0.5, 2);
    deformer.amounts = {0.5, 2};
    const auto exported =
        deform_exactly(b.staged.model, b.staged.cage, deformer, pose, sym3::Method::fast, b.staged.pool);
    CHECK(largest_distance(exported.positions, other) < 1e-12 * b.staged.cage->diagonal);
    CHECK(norm(b.staged.report().turns[0] - exported.report.turns[0]) < 1e-13);
    CHECK(norm(exported.report.turns[0]) == doctest::Approx(70 * degree));
    if (deformer.blend != Blend::srl) continue;
    // A vertex rotates about the blended centre by half the angle. The stretch is squared.
    const auto centers = with(0, 0);  // c' + o
    for (std::size_t i = 0; i < other.size(); ++i) {
      const Vec3 o = b.staged.binding->offsets[i];
      const Vec3 expected = centers[i] + (half_and_twice(o) - o);
      CHECK(norm(other[i] - expected) < 1e-11);
    }
  }
}

TEST_CASE("rotating_model_cage_and_pose_rotates_the_result") {
  const auto map = similarity({1, -2, 3}, 37 * degree, 1, {0.5, 2, -1});
  const auto small = shaken(model(), 0.02), cage = shaken(cage_of_a_part(), 0.05);
  const auto pose = shaken(cage, 0.15).positions;
  auto deformers = valid_deformers();
  deformers.push_back(default_deformer());
  deformers.back().iterations = 1;
  deformers.back().holding = {0.2, 0.1};
  base::WorkerPool pool(2);
  for (Deformer deformer : deformers) {
    CAPTURE(text(deformer));
    CAPTURE(deformer.stitched());
    const auto deformed = [&](const mesh::Surface& m, const mesh::Surface& c,
                              const std::vector<mesh::Point>& positions) {
      return deform_exactly(m, std::make_shared<const Cage>(make_cage(c)), deformer, {positions, {}},
                            sym3::Method::diag, pool)
          .positions;
    };
    const auto there = mapped(deformed(small, cage, pose), map),
               here = deformed(mapped(small, map), mapped(cage, map), mapped(pose, map));
    CHECK(largest_distance(here, there) < 1e-9);
  }
}
