#include "deform/stitched_engine.h"

#include "deform/bound.h"
#include "mesh/normals.h"

using namespace viete;
using namespace viete::test;

namespace {

constexpr auto fast = sym3::Method::fast;

mesh::Surface stitched_model() {
  return tube(60, 24, 0.5, 4);
}

const Twist stitched_twist{2, {0.1, 0, 0}, -2.2, 2.2, -60 * degree, 70 * degree};

Frames stitched_frames(const Deformer& deformer, int threads = 2) {
  return Frames(stitched_model(), tube(9, 7, 0.8, 4.4), deformer, threads);
}

Deformer stitched_srl(int iterations = 1) {
  return {.weighting = {Elements::face, Weights::inverse}, .iterations = iterations};
}

}  // namespace

TEST_CASE("stitched_frames_equal_double_precision_up_to_the_sums") {
  for (Deformer deformer : whole_deformers())
    for (deformer.iterations = 1; deformer.iterations <= 2; ++deformer.iterations) {
      if (conflict(deformer)) continue;
      CAPTURE(text(deformer));
      Frames f = stitched_frames(deformer);
      CHECK(f.fused.engine(fast) == EngineKind::stitched);
      f.fused.deform(rest_pose(*f.staged.cage), fast);
      const double diagonal = f.staged.cage->diagonal;
      CHECK(largest_distance(f.fused.positions(), f.staged.model.positions) < 1e-12 * diagonal);
      for (const Pose& pose : {f.staged.pose(similarity({1, -2, 3}, 150 * degree, 2, {30, 4, 5})),
                               f.staged.pose(shear()), f.staged.pose(stitched_twist)}) {
        const auto exact = f.deform(pose);
        CHECK(largest_distance(f.fused.positions(), exact) < 1e-5 * diagonal);
        for (std::size_t v = 0; v < exact.size(); ++v) {
          const auto& p = f.fused.vertices()[v].position;
          CHECK(norm(f.fused.origin() + Vec3{p[0], p[1], p[2]} - exact[v]) < 1.1e-5 * diagonal);
        }
      }
    }
}

TEST_CASE("a_large_model_is_stitched_like_a_coarse_one") {
  const auto cage = tube(9, 7, 0.8, 4.4);
  Frames fine(tube(601, 150, 0.5, 4), cage, stitched_srl()),
      coarse(tube(121, 30, 0.5, 4), cage, stitched_srl());
  REQUIRE(needs_coarse_model(fine.staged.model));
  const Affine map = similarity({1, -2, 3}, 150 * degree, 2, {3, 4, 5});
  CHECK(largest_distance(fine.deform(fine.staged.pose(map)), mapped(fine.staged.model.positions, map)) <
        1e-5);
  for (const bool shaped : {false, true}) {
    for (Frames* f : {&fine, &coarse}) {
      std::vector<float> shares;
      std::vector<mesh::Point> shape;
      for (const auto& p : f->staged.model.positions) {
        shares.push_back(static_cast<float>(0.5 + p[2] / 8));
        shape.push_back({p[0] * (1 + 0.1 * p[2]), p[1], p[2] + 0.2 * p[0]});
      }
      if (!shaped) continue;
      f->set_mask(std::make_shared<const std::vector<float>>(shares));
      f->set_shape(std::make_shared<const std::vector<mesh::Point>>(shape));
    }
    const auto near = fine.deform(fine.staged.pose(stitched_twist)),
               far = coarse.deform(fine.staged.pose(stitched_twist));
    for (std::size_t v = 0; v < 121 * 30; ++v)
      CHECK(norm(near[v / 30 * 5 * 150 + v % 30 * 5] - far[v]) < 2e-3 * fine.staged.cage->diagonal);
  }
}

TEST_CASE("normals_of_stitched_frames_are_of_the_stitched_surface") {
  Frames f = stitched_frames(stitched_srl());
  const auto posed = f.deform(f.staged.pose(stitched_twist));
  const auto& triangles = f.staged.model.triangles;
  std::vector<mesh::Point> normals(posed.size());
  mesh::vertex_normals(posed, triangles, mesh::vertex_triangles(posed.size(), triangles), 0, posed.size(),
                       normals);
  CHECK(largest_distance(f.fused.normals(), normals) < 1e-4);
}

TEST_CASE("a_stitched_drag_is_a_full_frame") {
  for (const int iterations : {1, 2}) {
    Frames dragged = stitched_frames(stitched_srl(iterations)), whole = stitched_frames(dragged.deformer);
    Pose pose = dragged.staged.pose(stitched_twist);
    dragged.deform(pose);
    dragged.fused.begin_drag(std::array{40u});
    for (int step = 0; step < 4; ++step) {
      pose.positions[40] = pose.positions[40] + Vec3{0.1, 0.05, 0};
      dragged.deform(pose);
    }
    dragged.fused.end_drag();
    dragged.fused.deform(pose, fast);
    whole.fused.deform(pose, fast);
    CHECK(dragged.fused.positions() == whole.fused.positions());
  }
}

TEST_CASE("stitched_frames_have_the_same_bits_on_any_number_of_threads_and_in_any_order") {
  Frames one = stitched_frames(stitched_srl(2), 1), three = stitched_frames(stitched_srl(2), 3);
  const Pose pose = one.staged.pose(stitched_twist);
  const auto exact = one.deform(pose), first = one.fused.positions();
  CHECK(three.deform(pose) == exact);
  CHECK(three.fused.positions() == first);
  one.deform(one.staged.pose(shear()));
  one.deform(pose);
  CHECK(one.fused.positions() == first);
}

TEST_CASE("vertices_with_holds_reach_their_blended_positions_in_stitched_frames") {
  mesh::Surface model = together(stitched_model(), tube(6, 5, 0.1, 0.5));
  model.positions.push_back({0.2, 0.1, 0.3});
  for (const Blend blend : {Blend::srl, Blend::linear}) {
    Frames f(model, tube(9, 7, 0.8, 4.4), {.weighting = {}, .blend = blend, .iterations = 1});
    CHECK(stitch(model, *f.staged.cage, f.staged.pool).holds.size() == 6 * 5 + 3);
    f.deform(f.staged.pose(stitched_twist));
  }
}

TEST_CASE("without_a_stitching_a_stitched_deformer_falls_back_to_blending_with_its_error") {
  const Mask none, half = std::make_shared<const std::vector<float>>(stitched_model().positions.size(), 0.4f);
  for (const Mask& mask : {none, half}) {
    Frames f = stitched_frames(stitched_srl()), blended = stitched_frames({});
    const Pose pose = f.staged.pose(stitched_twist);
    f.set_mask(mask);
    blended.set_mask(mask);
    const auto tiles = std::make_shared<const Binding>(f.fused.binding());
    FrameDeformer waiting(f.staged.cage, tiles, f.deformer, f.staged.pool);
    CHECK(!waiting.engine(fast));
    waiting.set_mask(mask);
    waiting.deform(pose, fast);
    CHECK(waiting.ran() == EngineKind::fused);
    f.deform(pose);
    blended.deform(pose);
    CHECK(waiting.positions() == blended.fused.positions());
    // The sampled error of a stitched frame is the error of the blended positions before stitching.
    CHECK(f.fused.sampled_error() > 0);
    CHECK(std::abs(f.fused.sampled_error() - blended.fused.sampled_error()) < 3e-7);
  }
}

TEST_CASE("stitched_frames_run_every_method_and_time_their_stages") {
  Frames f = stitched_frames(stitched_srl());
  const Pose pose = f.staged.pose(stitched_twist);
  f.deform(pose);
  const auto by_fast = f.fused.positions();
  f.fused.deform(pose, sym3::Method::diag);
  CHECK(largest_distance(f.fused.positions(), by_fast) < 1e-12);
  const StageTimes times = f.fused.times();
  for (const Stage stage : {Stage::blend, Stage::triangle_maps, Stage::solve, Stage::normals})
    CHECK(times[stage] > 0);
  CHECK(times[Stage::fused] == 0);
}

TEST_CASE("a_cloud_is_stitched_like_the_surface_of_its_points_and_each_point_by_itself") {
  const auto model = stitched_model(), cage = tube(9, 7, 0.8, 4.4);
  mesh::Surface cloud, some;
  cloud.positions = model.positions;
  cloud.positions.push_back({0.5, 0.2, 30});  // far from the lattice
  for (std::size_t v = 0; v < cloud.positions.size(); v += 5) some.positions.push_back(cloud.positions[v]);
  Deformer deformer = deformer_of(Preset::arap);
  for (deformer.iterations = 1; deformer.iterations <= 2; ++deformer.iterations) {
    Frames f(cloud, cage, deformer), of_some(some, cage, deformer), surface(model, cage, deformer);
    const double diagonal = f.staged.cage->diagonal;
    const Affine map = similarity({1, -2, 3}, 150 * degree, 2, {3, 4, 5});
    CHECK(largest_distance(f.deform(f.staged.pose(map)), mapped(cloud.positions, map)) < 1e-5 * diagonal);
    const Pose pose = f.staged.pose(stitched_twist);
    auto exact = f.deform(pose);
    const auto alone = of_some.deform(pose);
    for (std::size_t i = 0; i < alone.size(); ++i) CHECK(norm(alone[i] - exact[5 * i]) < 1e-12 * diagonal);
    exact.pop_back();
    CHECK(largest_distance(exact, surface.deform(pose)) < 0.03 * diagonal);
  }
}

TEST_CASE("masks_and_shapes_act_on_stitched_clouds") {
  mesh::Surface cloud;
  cloud.positions = stitched_model().positions;
  Frames f(cloud, tube(9, 7, 0.8, 4.4), deformer_of(Preset::arap));
  const Pose pose = f.staged.pose(stitched_twist);
  auto shape = cloud.positions;
  for (auto& p : shape) p = {1.1 * p[0], 0.9 * p[1], p[2]};
  f.set_shape(std::make_shared<const std::vector<mesh::Point>>(shape));
  CHECK(all_finite(f.deform(pose)));
  CHECK(largest_distance(f.deform(rest_pose(*f.staged.cage)), shape) < 1e-3);
  f.set_shape(nullptr);
  f.set_mask(std::make_shared<const std::vector<float>>(cloud.positions.size(), 0.0f));
  CHECK(largest_distance(f.deform(pose), cloud.positions) < 0.02);
}
