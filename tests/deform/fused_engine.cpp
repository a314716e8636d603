#include "deform/fused_engine.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "base/error.h"
#include "deform/bound.h"
#include "deform/point_weights.h"

using namespace viete::test;
using viete::sym3::Method;

namespace {

// The fused frame with the staged one as reference.
struct Fused {
  explicit Fused(const Bound& staged, int threads = 1,
                 const viete::sym3::Kernel& kernel = viete::sym3::kernel(), double tolerance = 0,
                 std::optional<Storage> storage = {})
      : pool(threads),
        binding(std::make_shared<const TiledBinding>(bind_tiles(
            staged.model, *staged.cage, staged.binding->weighting, pool, tolerance, nullptr, storage))),
        frame(staged.cage, binding, pool, kernel) {}

  std::vector<viete::mesh::Point> positions() const {
    std::vector<viete::mesh::Point> result;
    for (const auto& v : frame.vertices())
      result.push_back(frame.origin() + Vec3{v.position[0], v.position[1], v.position[2]});
    return result;
  }
  std::vector<viete::mesh::Point> normals() const {
    std::vector<viete::mesh::Point> result;
    for (const auto& v : frame.vertices()) result.push_back({v.normal[0], v.normal[1], v.normal[2]});
    return result;
  }

  viete::base::WorkerPool pool;
  std::shared_ptr<const TiledBinding> binding;
  FusedFrame frame;
};

constexpr Weighting both[] = {faces, mean_values};

// 1,802 vertices: three full leaves and a partial one.
viete::mesh::Surface fine_tube() {
  return tube(60, 30, 0.3, 1.5);
}

}  // namespace

TEST_CASE("fused_frame_agrees_with_the_staged_one_within_1e_6_of_the_diagonal") {
  for (const auto c : both) {
    Bound staged(fine_tube(), box({1, 1.3, 1}), c);
    Fused fused(staged);
    const double diagonal = staged.cage->diagonal;
    const auto check = [&](const Pose& pose) {
      staged.deform(pose);
      fused.frame.deform(pose);
      CHECK(largest_distance(fused.positions(), staged.deformer.positions()) < 1e-6 * diagonal);
      CHECK(largest_distance(fused.normals(), staged.deformer.normals()) < 2e-4);
      CHECK(fused.frame.state.report().turns == staged.report().turns);
    };
    check(rest_pose(*staged.cage));
    check(staged.pose(shear()));
    for (int angle = 30; angle <= 690; angle += 60) {
      check(staged.pose(Twist{2, {0, 0, 0}, -1, 1, -0.5 * angle * degree, 0.5 * angle * degree}));
      check(staged.pose(similarity({1, 2, 3}, angle * degree, 1.5, {3, 0, -1}), {{angle * degree, 0, 0}}));
    }
  }
}

TEST_CASE("fused_frame_is_as_exact_far_from_the_origin_and_at_any_size") {
  for (const double size : {1e-9, 1e-3, 1e4, 1e12}) {
    const auto scaled = [&](viete::mesh::Surface s) {
      for (auto& p : s.positions) p = size * (p + Vec3{300, -200, 100});
      return s;
    };
    Bound staged(scaled(fine_tube()), scaled(box()));
    Fused fused(staged);
    Random random(7);
    Pose pose = rest_pose(*staged.cage);
    for (auto& p : pose.positions) p = p + random.vector(0.2 * size);
    staged.deform(pose);
    fused.frame.deform(pose);
    CHECK(largest_distance(fused.positions(), staged.deformer.positions()) < 1e-6 * staged.cage->diagonal);
    CHECK(largest_distance(fused.normals(), staged.deformer.normals()) < 1e-3);
  }
}

TEST_CASE("fused_frames_have_the_same_bits_for_any_number_of_threads") {
  for (const auto c : both) {
    Bound staged(fine_tube(), box(), c);
    Fused one(staged, 1), four(staged, 4);
    const Pose pose = staged.pose(Twist{2, {0, 0, 0}, -1, 1, 0, 150 * degree});
    one.frame.deform(pose);
    four.frame.deform(pose);
    CHECK(one.binding->weights == four.binding->weights);
    CHECK(one.positions() == four.positions());
    CHECK(one.normals() == four.normals());
  }
}

TEST_CASE("fused_frame_is_right_and_has_the_same_bits_on_every_instruction_set") {
  Bound staged(fine_tube(), box());
  const Pose pose = staged.pose(Twist{2, {0, 0, 0}, -1, 1, 0, 250 * degree});
  staged.deform(pose);
  const auto first_with = [&](bool fused_arithmetic) {
    const auto all = viete::sym3::kernels();
    return std::find_if(all.begin(), all.end(), [&](const auto& k) { return k.fused == fused_arithmetic; });
  };
  for (const auto& kernel : viete::sym3::kernels()) {
    CAPTURE(kernel.name);
    Fused fused(staged, 1, kernel), alike(staged, 1, *first_with(kernel.fused));
    fused.frame.deform(pose);
    alike.frame.deform(pose);
    CHECK(largest_distance(fused.positions(), staged.deformer.positions()) < 1e-6 * staged.cage->diagonal);
    CHECK(largest_distance(fused.normals(), staged.deformer.normals()) < 2e-4);
    CHECK(fused.positions() == alike.positions());
  }
}

TEST_CASE("fused_normals_are_right_for_any_triangles") {
  // An open strip, a fan shared by 200 triangles, two cones that touch at their tips, a stray vertex, a
  // triangle that repeats a corner, an edge with three triangles.
  auto p = tube(4, 200, 0.4, 1).positions;
  auto t = tube(4, 200, 0.4, 1).triangles;
  t.resize(t.size() - 7);
  p.insert(p.end(), {{0, 0, 0.9}, {0.1, 0, 0.7}, {0, 0.1, 0.7}, {-0.1, 0, 0.7}, {0.7, 0.7, 0.7}});
  const auto n = static_cast<std::uint32_t>(p.size());
  t.insert(
      t.end(),
      {{n - 5, n - 4, n - 3}, {n - 5, n - 3, n - 2}, {n - 5, n - 2, 0}, {n - 5, 1, 2}, {3, 3, 4}, {0, 1, 9}});
  Bound staged(viete::mesh::from_triangles(p, t), box());
  Fused fused(staged);
  CHECK_FALSE(fused.binding->rings.high_valence.empty());
  const Pose pose = staged.pose(shear());
  staged.deform(pose);
  fused.frame.deform(pose);
  CHECK(largest_distance(fused.normals(), staged.deformer.normals()) < 1e-4);
}

TEST_CASE("compressed_weights_move_vertices_by_less_than_their_tolerance") {
  Bound staged(tube(120, 60, 0.3, 1.5), tube(7, 12, 0.6, 2));
  for (const double tolerance : {1e-3, 1e-4, 3e-5}) {
    Fused one(staged, 1, viete::sym3::kernel(), tolerance),
        three(staged, 3, viete::sym3::kernel(), tolerance);
    REQUIRE(one.binding->compressed());
    CHECK(2 * one.binding->bytes() < one.binding->dense_bytes());
    CHECK(one.binding->factors == three.binding->factors);
    for (const Pose& pose : {rest_pose(*staged.cage), staged.pose(shear()),
                             staged.pose(Twist{2, {0, 0, 0}, -1, 1, -100 * degree, 100 * degree})}) {
      staged.deform(pose);
      one.frame.deform(pose);
      three.frame.deform(pose);
      CHECK(largest_distance(one.positions(), staged.deformer.positions()) <
            tolerance * staged.cage->diagonal);
      CHECK(one.positions() == three.positions());
    }
    one.frame.deform(rest_pose(*staged.cage));
    CHECK(largest_distance(one.positions(), staged.model.positions) < 1e-6 * staged.cage->diagonal);
  }
}

TEST_CASE("weights_stay_dense_if_factors_do_not_pay") {
  const Bound small_cage(tube(120, 60, 0.3, 1.5), box());
  CHECK_FALSE(Fused(small_cage, 1, viete::sym3::kernel(), 1e-4).binding->compressed());
  const Bound few_vertices(tube(4, 12, 0.3, 1.5), tube(7, 12, 0.6, 2));
  CHECK_FALSE(Fused(few_vertices, 1, viete::sym3::kernel(), 1e-4).binding->compressed());
}

TEST_CASE("a_drag_is_as_exact_as_full_frames_and_does_not_drift") {
  Bound staged(tube(120, 60, 0.3, 1.5), tube(7, 12, 0.6, 2));
  for (const double tolerance : {0.0, 3e-5}) {
    Fused dragged(staged, 1, viete::sym3::kernel(), tolerance);
    const double bound = std::max(1e-6, tolerance) * staged.cage->diagonal;
    Pose pose = staged.pose(Twist{2, {0, 0, 0}, -1, 1, -50 * degree, 50 * degree});
    dragged.frame.deform(pose);
    CHECK_FALSE(dragged.frame.engine.dragging());
    Random random(11);
    for (const std::uint32_t vertex : {5u, 40u}) {
      dragged.frame.state.begin_drag(std::array{vertex});
      for (int step = 0; step < 12; ++step) {
        pose.positions[vertex] = pose.positions[vertex] + random.vector(0.02);
        dragged.frame.deform(pose);
        CHECK(dragged.frame.engine.dragging());
        staged.deform(pose);
        CHECK(largest_distance(dragged.positions(), staged.deformer.positions()) < bound);
      }
      CHECK(dragged.frame.engine.bytes() < dragged.binding->dense_bytes());
      dragged.frame.state.end_drag();
    }
    dragged.frame.deform(pose);
    CHECK_FALSE(dragged.frame.engine.dragging());
    Fused fresh(staged, 1, viete::sym3::kernel(), tolerance);
    fresh.frame.deform(pose);
    CHECK(dragged.positions() == fresh.positions());
  }
}

TEST_CASE("a_drag_keeps_unweighted_leaves_and_updates_border_normals") {
  constexpr std::size_t lanes = tile_lanes<float>;
  constexpr std::uint32_t vertex = 40;
  Bound staged(tube(120, 60, 0.3, 1.5), tube(7, 12, 0.6, 2));
  viete::base::WorkerPool one(1), four(4);
  auto binding = std::make_shared<TiledBinding>(bind_tiles(staged.model, *staged.cage, faces, one, 0));
  const auto& elements = staged.cage->surface.triangles;
  for (std::size_t slot = 0; slot < 5 * leaf_slots; ++slot) {
    float* weights = binding->weights.data() + slot / lanes * lanes * binding->handles + slot % lanes;
    double sum = 0;
    for (std::size_t e = 0; e < elements.size(); ++e) {
      if (std::find(elements[e].begin(), elements[e].end(), vertex) != elements[e].end())
        weights[e * lanes] = 0;
      sum += weights[e * lanes];
    }
    for (std::size_t e = 0; e < elements.size(); ++e)
      weights[e * lanes] = static_cast<float>(weights[e * lanes] / sum);
  }
  const auto bytes = [](const FusedFrame& frame) { return std::as_bytes(frame.vertices()); };
  const auto distances = [](const FusedFrame& a, const FusedFrame& b) {
    double position = 0, normal = 0;
    for (std::size_t v = 0; v < a.vertices().size(); ++v) {
      for (int i = 0; i < 3; ++i) {
        const double p =
            a.vertices()[v].position[i] - b.vertices()[v].position[i] + (a.origin() - b.origin())[i];
        position = std::max(position, std::fabs(p));
        normal = std::max<double>(normal, std::fabs(a.vertices()[v].normal[i] - b.vertices()[v].normal[i]));
      }
    }
    return std::pair(position, normal);
  };
  FusedFrame dragged(staged.cage, binding, one), by_threads(staged.cage, binding, four);
  Random random(13);
  Pose pose = staged.pose(Twist{2, {0, 0, 0}, -1, 1, -50 * degree, 50 * degree});
  for (FusedFrame* frame : {&dragged, &by_threads})
    frame->deform(pose), frame->state.begin_drag(std::array{vertex});
  for (int step = 0; step < 6; ++step) {
    pose.positions[vertex] = pose.positions[vertex] + random.vector(0.1);
    for (FusedFrame* frame : {&dragged, &by_threads}) frame->deform(pose);
    REQUIRE(dragged.engine.dragging());
    FusedFrame fresh(staged.cage, binding, one);
    fresh.deform(pose);
    const auto [position, normal] = distances(dragged, fresh);
    CHECK(position < 1e-6 * staged.cage->diagonal);
    CHECK(normal < 2e-4);
    CHECK(std::equal(bytes(dragged).begin(), bytes(dragged).end(), bytes(by_threads).begin()));
  }
}

TEST_CASE("a_drag_that_changes_logs_of_others_is_a_full_frame") {
  // Rotates one element until its neighbours change branches, or are raised with the pose's mean stretch.
  Bound staged(tube(60, 30, 0.3, 1.5), tube(7, 12, 0.6, 2));
  Fused dragged(staged);
  dragged.frame.state.begin_drag(std::array{30u});
  Pose pose = staged.pose(Twist{2, {0, 0, 0}, -1, 1, -170 * degree, 170 * degree});
  for (int step = 0; step < 30; ++step) {
    const double angle = 24.0 * step * degree;
    pose.positions[30] =
        pose.positions[30] + 0.3 * Vec3{std::cos(angle), std::sin(angle), std::cos(2 * angle)};
    dragged.frame.deform(pose);
    staged.deform(pose);
    CHECK(largest_distance(dragged.positions(), staged.deformer.positions()) < 2e-6 * staged.cage->diagonal);
  }
}

TEST_CASE("fused_frame_refuses_a_pose_with_another_number_of_vertices") {
  Bound staged(fine_tube(), box());
  Fused fused(staged);
  Pose pose = rest_pose(*staged.cage);
  pose.positions.pop_back();
  CHECK_THROWS_AS(fused.frame.deform(pose), viete::base::Error);
}

namespace {

constexpr double leaf_radii[] = {0.1, 0.2, 0.3, 0.6};

// A model of 29 leaves in a cage of 308 triangles.
Bound with_radius(double radius) {
  return Bound(tube(240, 60, 0.3, 1.5), tube(14, 11, 0.6, 2), viete::test::cut_off(radius));
}

Fused listed(const Bound& staged, int threads = 1) {
  return Fused(staged, threads, viete::sym3::kernel(), 0, Storage::lists);
}

}  // namespace

TEST_CASE("fused_frames_agree_with_the_staged_one_at_every_radius_and_storage") {
  for (const double radius : leaf_radii) {
    CAPTURE(radius);
    Bound staged = with_radius(radius);
    Fused dense(staged, 1, viete::sym3::kernel(), 0, Storage::dense),
        lists(staged, 1, viete::sym3::kernel(), 0, Storage::lists);
    Fused threaded(staged, 3, viete::sym3::kernel(), 0, Storage::lists);
    Fused factors(staged, 1, viete::sym3::kernel(), usual_tolerance, Storage::factors);
    CHECK(dense.binding->storage() == Storage::dense);
    CHECK(lists.binding->storage() == Storage::lists);
    CHECK(factors.binding->storage() == Storage::factors);
    CHECK(threaded.binding->weights == lists.binding->weights);
    if (radius < 0.3) CHECK(lists.binding->bytes() < dense.binding->bytes());
    for (const Pose& pose : {rest_pose(*staged.cage), staged.pose(shear()),
                             staged.pose(Twist{2, {0, 0, 0}, -1, 1, -100 * degree, 100 * degree})}) {
      staged.deform(pose);
      for (Fused* fused : {&dense, &lists, &threaded, &factors}) fused->frame.deform(pose);
      CHECK(largest_distance(dense.positions(), staged.deformer.positions()) < 1e-6 * staged.cage->diagonal);
      CHECK(largest_distance(factors.positions(), staged.deformer.positions()) <
            usual_tolerance * staged.cage->diagonal);
      CHECK(lists.positions() == dense.positions());
      CHECK(lists.normals() == dense.normals());
      CHECK(threaded.positions() == dense.positions());
    }
  }
}

TEST_CASE("lists_give_the_same_bits_on_every_instruction_set") {
  Bound staged = with_radius(0.3);
  const Pose pose = staged.pose(Twist{2, {0, 0, 0}, -1, 1, 0, 250 * degree});
  for (const auto& kernel : viete::sym3::kernels()) {
    CAPTURE(kernel.name);
    Fused dense(staged, 1, kernel, 0, Storage::dense), lists(staged, 1, kernel, 0, Storage::lists);
    dense.frame.deform(pose);
    lists.frame.deform(pose);
    CHECK(lists.positions() == dense.positions());
  }
}

TEST_CASE("weight_storage_is_chosen_by_cost") {
  Bound near = with_radius(0.1), far(near.model, near.cage->surface);
  CHECK(Fused(near).binding->storage() == Storage::lists);
  CHECK(Fused(far).binding->storage() == Storage::dense);
  CHECK(Fused(far, 1, viete::sym3::kernel(), usual_tolerance).binding->storage() == Storage::factors);
}

TEST_CASE("vertices_out_of_reach_of_a_dragged_vertex_keep_every_bit") {
  for (const double radius : {0.15, 0.2, 0.25}) {
    CAPTURE(radius);
    Bound staged = with_radius(radius);
    Fused fused = listed(staged);
    const Pose before = staged.pose(Twist{2, {0, 0, 0}, -1, 1, -20 * degree, 20 * degree});
    fused.frame.deform(before);
    const auto from = fused.positions(), from_normals = fused.normals();
    const std::uint32_t dragged = 40;
    // Beyond the radius plus a margin: float and double differ at its end.
    std::vector<bool> beyond(staged.model.positions.size(), true);
    std::vector<double> w(staged.cage->element_count());
    for (std::size_t i = 0; i < beyond.size(); ++i) {
      cut_off_weights(*staged.cage, staged.model.positions[i], viete::test::cut_off(1.01 * radius), w);
      for (std::size_t e = 0; e < w.size(); ++e) {
        const auto& t = staged.cage->surface.triangles[e];
        if (w[e] > 0 && (t[0] == dragged || t[1] == dragged || t[2] == dragged)) beyond[i] = false;
      }
    }
    const auto check = [&] {
      const auto now = fused.positions();
      std::size_t stayed = 0, moved = 0;
      for (std::size_t i = 0; i < beyond.size(); ++i) {
        if (beyond[i]) {
          ++stayed;
          CHECK(now[i] == from[i]);
        } else {
          moved += now[i] != from[i];
        }
      }
      CHECK(stayed > 1000);
      CHECK(moved > 100);
    };
    Pose pose = before;
    fused.frame.state.begin_drag(std::array{dragged});
    for (int step = 0; step < 4; ++step) {
      pose.positions[dragged] = pose.positions[dragged] + Vec3{0.02, 0.03, -0.01};
      fused.frame.deform(pose);
      CHECK(fused.frame.engine.dragging());
      check();
      staged.deform(pose);
      CHECK(largest_distance(fused.positions(), staged.deformer.positions()) < 1e-6 * staged.cage->diagonal);
      CHECK(largest_distance(fused.normals(), staged.deformer.normals()) < 2e-4);
    }
    fused.frame.state.end_drag();
    fused.frame.deform(pose);
    CHECK_FALSE(fused.frame.engine.dragging());
    check();
    Fused fresh = listed(staged);
    fresh.frame.deform(pose);
    CHECK(fused.positions() == fresh.positions());
    CHECK(fused.normals() == fresh.normals());
    fused.frame.deform(before);
    CHECK(fused.positions() == from);
    CHECK(fused.normals() == from_normals);
  }
}
