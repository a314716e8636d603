#include "deform/bound.h"

using namespace viete;
using namespace viete::test;

using viete::sym3::Method;

namespace {

mesh::Surface tube_model() {
  return tube(30, 12, 0.25, 1.9);
}

// Returns a model that is partly outside of the cage and touches the cage.
mesh::Surface model_across() {
  return together(tube(12, 12, 0.3, 3), box({1, 1, 1}, {0.5, 0, 0}));
}

mesh::Surface open_box() {
  auto t = box().triangles;
  t.resize(9);
  return mesh::from_triangles(box().positions, t);
}

mesh::Surface two_triangles() {
  return mesh::from_triangles({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
}

std::vector<mesh::Surface> cages() {
  return {box({1, 1.1, 1.2}), tube(9, 7, 0.4, 2.2), together(box(), box({0.3, 0.3, 2})), open_box(),
          two_triangles()};
}

constexpr Method methods[] = {Method::diag, Method::sd, Method::improved_sd, Method::fast};

}  // namespace

TEST_CASE("unmoved_cage_keeps_every_vertex") {
  for (const auto& cage : cages()) {
    for (const Deformer& deformer :
         {Deformer{faces}, Deformer{faces, Blend::linear}, Deformer{mean_values, Blend::linear}}) {
      Bound b(model_across(), cage, deformer.weighting, 2, deformer.blend);
      for (const auto method : methods)
        CHECK(largest_distance(b.deform(rest_pose(*b.cage), method), b.model.positions) <
              1e-14 * b.cage->diagonal);
    }
  }
}

TEST_CASE("similarity_poses_move_every_vertex_by_that_similarity") {
  for (const auto& cage : cages())
    for (const Blend blend : {Blend::srl, Blend::linear}) {
      Bound b(model_across(), cage, faces, 2, blend);
      for (const double angle : {1e-9, 1.0, 90.0, 179.999, 180.0, 180.001, 270.0, 360.0, 540.0})
        for (const double scale : {1e-3, 1.0, 1e3})
          for (const Vec3& axis : {Vec3{0, 0, 1}, Vec3{1, -2, 3}})
            CHECK(b.error(similarity(axis, angle * degree, scale, {2 * scale, scale, -scale})) < 1e-12);
    }
}

TEST_CASE("halfway_between_opposite_turns_logs_keep_the_thickness_that_averaged_maps_lose") {
  // The cage is two boxes that rotate by 80 degrees in opposite directions. The model is a tube between them.
  auto cage = together(box({0.5, 0.5, 0.5}), box({0.5, 0.5, 0.5}));
  for (std::size_t v = 0; v < 16; ++v) cage.positions[v][2] += v < 8 ? 1.5 : -1.5;
  const auto turned = [](const Vec3& x) { return similarity({0, 0, 1}, (x[2] > 0 ? 80 : -80) * degree)(x); };
  const auto girth = [&](Blend blend) {
    Bound b(tube(20, 24, 0.1, 0.1), cage, faces, 2, blend);
    double least = HUGE_VAL;
    for (const auto& p : b.deform(b.pose(turned))) {
      const double radius = std::hypot(p[0], p[1]);
      if (std::abs(p[2]) < 0.006 && radius > 1e-3) least = std::min(least, radius / 0.1);
    }
    return least;
  };
  CHECK(girth(Blend::srl) > 0.75);
  CHECK(girth(Blend::linear) == doctest::Approx(std::cos(80 * degree)).epsilon(0.05));
}

TEST_CASE("similarity_poses_hold_at_every_length_scale_and_far_from_the_origin") {
  for (const double s : {1e-30, 1e-6, 1e6, 1e30}) {
    const auto scaled = [s](const mesh::Surface& surface) { return mapped(surface, scaling(s)); };
    for (const auto& c : {faces, mean_values}) {
      Bound b(scaled(tube_model()), scaled(box()), c);
      CHECK(b.error(similarity({1, 2, 3}, 2, 3, {s, s, -s})) < 1e-12);
      CHECK(largest_distance(b.deform(rest_pose(*b.cage)), b.model.positions) < 1e-14 * b.cage->diagonal);
    }
  }
  const auto moved = [](const mesh::Surface& s) { return mapped(s, scaling(1, {1e7, -2e7, 3e7})); };
  Bound b(moved(tube_model()), moved(box()));
  CHECK(largest_distance(b.deform(rest_pose(*b.cage)), b.model.positions) < 2e-8);  // an ulp of 3e7 is 3.7e-9
  const auto shift = [](const Vec3& x) { return x + Vec3{0.5, 0.25, -0.5}; };
  CHECK(largest_distance(b.deform(b.pose(shift)), mapped(b.model.positions, shift)) < 2e-8);
}

TEST_CASE("all_methods_agree_on_the_positions") {
  Bound b(model_across(), tube(9, 7, 0.4, 2.2));
  const Twist twist{2, {0.1, 0, 0}, -1.1, 1.1, -80 * degree, 100 * degree};
  const auto wild = [&](const Vec3& x) { return shear()(twist(x)); };
  const auto diag = b.deform(b.pose(wild), Method::diag);
  const double diagonal = b.cage->diagonal;
  CHECK(largest_distance(b.deform(b.pose(wild), Method::fast), diag) < 1e-13 * diagonal);
  CHECK(largest_distance(b.deform(b.pose(wild), Method::sd), diag) < 1e-5 * diagonal);
  CHECK(largest_distance(b.deform(b.pose(wild), Method::improved_sd), diag) < 1e-5 * diagonal);
}

TEST_CASE("random_collapsed_and_mirrored_poses_of_every_cage_stay_finite_with_every_method") {
  const auto flat = [](const Vec3& x) { return Vec3{x[0], x[1], 0}; };
  const auto line = [](const Vec3& x) { return Vec3{x[0], 0, 0}; };
  const auto dot = [](const Vec3&) { return Vec3{1, 2, 3}; };
  const auto mirror = [](const Vec3& x) { return Vec3{-x[0], x[1], x[2]}; };
  Random random(16);
  for (const auto& cage : cages())
    for (const auto& c : {faces, mean_values}) {
      Bound b(model_across(), cage, c);
      std::vector<Pose> poses = {b.pose(flat), b.pose(line), b.pose(mirror), b.pose(dot)};
      for (int n = 0; n < 20; ++n) {
        poses.push_back(rest_pose(*b.cage));
        for (auto& p : poses.back().positions) p = p + random.vector(std::pow(10, random(-3, 3)));
      }
      for (const Pose& pose : poses) {
        for (const auto method : methods) CHECK(all_finite(b.deform(pose, method)));
        CHECK(all_finite(b.deformer.normals()));
      }
      b.deform(poses[3]);
      if (c == faces) CHECK_FALSE(b.report().collapsed.empty());
    }
}

// Twists a tube by full turns. The tube must follow the cage and must not tear.

namespace {

constexpr double tear = 1.5;  // limit of the ratio: largest edge stretch of the model / of the cage

}  // namespace

TEST_CASE("a_tube_twisted_from_both_ends_or_one_does_not_tear") {
  const struct {
    std::uint32_t rings, sides;
    double low, most, farthest;
  } cases[] = {{9, 6, -0.5, 400, 0.18},
               {17, 8, -0.5, 400, 0.18},
               {25, 12, -0.5, 400, 0.18},  // `farthest` is the radius of the model
               {9, 6, 0, 280, 1},
               {17, 8, 0, 280, 1}};
  for (const auto& c : cases) {
    Bound b(tube(60, 24, 0.18, 1.96), tube(c.rings, c.sides, 0.3, 2));
    for (double a = 0; a <= c.most; a += 20) {
      const Twist twist{2, {0, 0, 0}, -1, 1, c.low * a * degree, (1 + c.low) * a * degree};
      const Pose pose = b.pose(twist);
      const auto positions = b.deform(pose);
      CHECK(b.report().torn.empty());
      CHECK(largest_edge_stretch(b.model, positions) <
            tear * largest_edge_stretch(b.cage->surface, pose.positions));
      CHECK(largest_distance(positions, mapped(b.model.positions, twist)) < c.farthest);
    }
  }
}

TEST_CASE("a_twist_beyond_the_range_of_logs_is_reported") {
  Bound b(tube(60, 24, 0.18, 1.96), tube(17, 8, 0.3, 2));
  b.deform(b.pose(Twist{2, {0, 0, 0}, -1, 1, -350 * degree, 350 * degree}));
  CHECK_FALSE(b.report().torn.empty());
}
