#include "deform/fused_engine.h"

#include "deform/bound.h"

using namespace viete::test;

namespace {

// A fused frame, and a staged frame as the reference.
struct Fused {
  explicit Fused(const Bound& staged, int threads = 1,
                 const viete::sym3::Kernel& kernel = viete::sym3::kernel(), double tolerance = 0,
                 std::optional<Storage> storage = {})
      : pool(threads),
        binding(std::make_shared<const TiledBinding>(bind_tiles(
            staged.model, *staged.cage, staged.binding->weighting, pool, tolerance, nullptr, storage))),
        frame(staged.cage, with_tiles(staged, binding), pool, kernel) {}

  std::vector<viete::mesh::Point> positions() const { return frame.positions(); }
  std::vector<viete::mesh::Point> normals() const { return frame.normals(); }

  // Deforms both frames, and checks their difference in diagonals of the cage.
  void check(Bound& staged, const Pose& pose, double bound = 1e-6, double normals_bound = 2e-4) {
    staged.deform(pose);
    frame.deform(pose);
    CHECK(largest_distance(positions(), staged.deformer.positions()) < bound * staged.cage->diagonal);
    CHECK(largest_distance(normals(), staged.deformer.normals()) < normals_bound);
    CHECK(frame.state.report().turns == staged.report().turns);
  }

  viete::base::WorkerPool pool;
  std::shared_ptr<const TiledBinding> binding;
  FusedFrame frame;
};

constexpr Weighting both[] = {faces, mean_values};

// Returns a tube of 1,802 vertices, which fill three leaves and a part of a fourth leaf.
viete::mesh::Surface fine_tube() {
  return tube(60, 30, 0.3, 1.5);
}

// Returns a model with 29 leaves in a cage with 308 triangles.
Bound with_radius(double radius) {
  return Bound(tube(240, 60, 0.3, 1.5), tube(14, 11, 0.6, 2), viete::test::cut_off(radius));
}

Fused listed(const Bound& staged, int threads = 1) {
  return Fused(staged, threads, viete::sym3::kernel(), 0, Storage::lists);
}

}  // namespace

TEST_CASE("fused_frame_agrees_with_the_staged_one_within_1e_6_of_the_diagonal") {
  for (const auto c : both) {
    Bound staged(fine_tube(), box({1, 1.3, 1}), c);
    Fused fused(staged), four(staged, 4);
    CHECK(fused.binding->weights == four.binding->weights);
    fused.check(staged, rest_pose(*staged.cage));
    fused.check(staged, staged.pose(shear()));
    four.frame.deform(staged.pose(shear()));
    CHECK(fused.positions() == four.positions());
    CHECK(fused.normals() == four.normals());
    for (int angle = 30; angle <= 690; angle += 60) {
      const double half = 0.5 * angle * degree;
      fused.check(staged, staged.pose(Twist{2, {0, 0, 0}, -1, 1, -half, half}));
      fused.check(staged, staged.pose(similarity({1, 2, 3}, 2 * half, 1.5, {3, 0, -1}), {{2 * half, 0, 0}}));
    }
  }
}

TEST_CASE("fused_frame_is_as_exact_far_from_the_origin_and_at_any_size") {
  for (const double size : {1e-9, 1e-3, 1e4, 1e12}) {
    const auto scaled = [&](const viete::mesh::Surface& s) {
      return mapped(s, scaling(size, size * Vec3{300, -200, 100}));
    };
    Bound staged(scaled(fine_tube()), scaled(box()));
    Random random(7);
    Pose pose = rest_pose(*staged.cage);
    for (auto& p : pose.positions) p = p + random.vector(0.2 * size);
    Fused(staged).check(staged, pose, 1e-6, 1e-3);
  }
}

TEST_CASE("fused_frame_is_right_and_has_the_same_bits_on_every_instruction_set") {
  Bound staged(fine_tube(), box());
  const Pose pose = staged.pose(Twist{2, {0, 0, 0}, -1, 1, 0, 250 * degree});
  const auto first_with = [&](bool fused_arithmetic) {
    const auto all = viete::sym3::kernels();
    return std::find_if(all.begin(), all.end(), [&](const auto& k) { return k.fused == fused_arithmetic; });
  };
  for (const auto& kernel : viete::sym3::kernels()) {
    CAPTURE(kernel.name);
    Fused fused(staged, 1, kernel), alike(staged, 1, *first_with(kernel.fused));
    fused.check(staged, pose);
    alike.frame.deform(pose);
    CHECK(fused.positions() == alike.positions());
    const Bound near = with_radius(0.3);
    Fused dense(near, 1, kernel, 0, Storage::dense), lists(near, 1, kernel, 0, Storage::lists);
    for (Fused* f : {&dense, &lists}) f->frame.deform(near.pose(shear()));
    CHECK(lists.positions() == dense.positions());
  }
}

TEST_CASE("fused_normals_are_right_for_any_triangles") {
  // The model has an open strip, a fan of 200 triangles, two cones with a common tip, an unused vertex, a
  // triangle that repeats a corner, and an edge with three triangles.
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
  fused.check(staged, staged.pose(shear()), 1e-6, 1e-4);
}

TEST_CASE("compressed_weights_move_vertices_by_less_than_their_tolerance") {
  Bound staged(tube(120, 60, 0.3, 1.5), tube(7, 12, 0.6, 2));
  for (const double tolerance : {1e-3, 1e-4, 3e-5}) {
    Fused one(staged, 1, viete::sym3::kernel(), tolerance),
        three(staged, 3, viete::sym3::kernel(), tolerance);
    REQUIRE(one.binding->compressed());
    CHECK(2 * one.binding->bytes() < 4 * one.binding->leaves.slot_count() * one.binding->handles);
    CHECK(one.binding->factors == three.binding->factors);
    for (const Pose& pose : {rest_pose(*staged.cage), staged.pose(shear()),
                             staged.pose(Twist{2, {0, 0, 0}, -1, 1, -100 * degree, 100 * degree})}) {
      one.check(staged, pose, tolerance, 1);
      three.frame.deform(pose);
      CHECK(one.positions() == three.positions());
    }
    one.frame.deform(rest_pose(*staged.cage));
    CHECK(largest_distance(one.positions(), staged.model.positions) < 1e-6 * staged.cage->diagonal);
  }
}

TEST_CASE("a_drag_is_as_exact_as_full_frames_and_does_not_drift") {
  Bound staged(tube(120, 60, 0.3, 1.5), tube(7, 12, 0.6, 2));
  for (const double tolerance : {0.0, 3e-5}) {
    Fused dragged(staged, 1, viete::sym3::kernel(), tolerance);
    const double bound = std::max(1e-6, tolerance);
    Pose pose = staged.pose(Twist{2, {0, 0, 0}, -1, 1, -50 * degree, 50 * degree});
    dragged.frame.deform(pose);
    CHECK_FALSE(dragged.frame.engine.dragging());
    Random random(11);
    for (const std::uint32_t vertex : {5u, 40u}) {
      dragged.frame.state.begin_drag(std::array{vertex});
      for (int step = 0; step < 12; ++step) {
        pose.positions[vertex] = pose.positions[vertex] + random.vector(0.02);
        dragged.check(staged, pose, bound, 1);
        CHECK(dragged.frame.engine.dragging());
      }
      CHECK(dragged.frame.engine.bytes() <
            4 * dragged.binding->leaves.slot_count() * dragged.binding->handles);
      dragged.frame.state.end_drag();
    }
    dragged.frame.deform(pose);
    CHECK_FALSE(dragged.frame.engine.dragging());
    Fused fresh(staged, 1, viete::sym3::kernel(), tolerance);
    fresh.frame.deform(pose);
    CHECK(dragged.positions() == fresh.positions());
  }
}

TEST_CASE("a_drag_that_changes_logs_of_others_is_a_full_frame") {
  // Moves one vertex until neighbouring elements change branches or get the minimum stretch.
  Bound staged(tube(60, 30, 0.3, 1.5), tube(7, 12, 0.6, 2));
  Fused dragged(staged);
  dragged.frame.state.begin_drag(std::array{30u});
  Pose pose = staged.pose(Twist{2, {0, 0, 0}, -1, 1, -170 * degree, 170 * degree});
  for (int step = 0; step < 30; ++step) {
    const double angle = 24.0 * step * degree;
    pose.positions[30] =
        pose.positions[30] + 0.3 * Vec3{std::cos(angle), std::sin(angle), std::cos(2 * angle)};
    dragged.check(staged, pose, 2e-6, 1);
  }
}

TEST_CASE("fused_frames_agree_with_the_staged_one_at_every_radius_and_storage") {
  for (const double radius : {0.1, 0.2, 0.3, 0.6}) {
    CAPTURE(radius);
    Bound staged = with_radius(radius);
    Fused dense(staged, 1, viete::sym3::kernel(), 0, Storage::dense), lists = listed(staged),
                                                                      threaded = listed(staged, 3);
    Fused factors(staged, 1, viete::sym3::kernel(), usual_tolerance, Storage::factors);
    CHECK(dense.binding->storage() == Storage::dense);
    CHECK(lists.binding->storage() == Storage::lists);
    CHECK(factors.binding->storage() == Storage::factors);
    CHECK(threaded.binding->weights == lists.binding->weights);
    if (radius < 0.3) CHECK(lists.binding->bytes() < dense.binding->bytes());
    for (const Pose& pose : {rest_pose(*staged.cage), staged.pose(shear()),
                             staged.pose(Twist{2, {0, 0, 0}, -1, 1, -100 * degree, 100 * degree})}) {
      dense.check(staged, pose);
      factors.check(staged, pose, usual_tolerance, 1);
      for (Fused* fused : {&lists, &threaded}) fused->frame.deform(pose);
      CHECK(lists.positions() == dense.positions());
      CHECK(lists.normals() == dense.normals());
      CHECK(threaded.positions() == dense.positions());
    }
  }
}

TEST_CASE("weight_storage_is_chosen_by_cost") {
  Bound near = with_radius(0.1), far(near.model, near.cage->surface);
  CHECK(Fused(near).binding->storage() == Storage::lists);
  CHECK(Fused(far).binding->storage() == Storage::dense);
  CHECK(Fused(far, 1, viete::sym3::kernel(), usual_tolerance).binding->storage() == Storage::factors);
  // For small cages or few vertices, the cost of factors is too high.
  const Bound small_cage(tube(120, 60, 0.3, 1.5), box()),
      few_vertices(tube(4, 12, 0.3, 1.5), tube(7, 12, 0.6, 2));
  for (const Bound* b : {&small_cage, &few_vertices})
    CHECK_FALSE(Fused(*b, 1, viete::sym3::kernel(), 1e-4).binding->compressed());
}

TEST_CASE("vertices_out_of_reach_of_a_dragged_vertex_keep_every_bit") {
  for (const double radius : {0.15, 0.2, 0.25}) {
    CAPTURE(radius);
    Bound staged = with_radius(radius);
    Fused fused = listed(staged), by_threads = listed(staged, 4);
    const Pose before = staged.pose(Twist{2, {0, 0, 0}, -1, 1, -20 * degree, 20 * degree});
    for (Fused* f : {&fused, &by_threads}) f->frame.deform(before);
    const auto from = fused.positions(), from_normals = fused.normals();
    const std::uint32_t dragged = 40;
    // Tests vertices beyond the radius plus a margin, because float and double differ at the radius.
    std::vector<bool> beyond(staged.model.positions.size(), true);
    for (std::size_t i = 0; i < beyond.size(); ++i) {
      const auto& x = staged.cage->surface.positions;
      for (const auto& t : staged.cage->surface.triangles) {
        const auto near = mesh::closest_on_triangle(staged.model.positions[i], x[t[0]], x[t[1]], x[t[2]]);
        const bool reaches = std::sqrt(near.squared_distance) < 1.01 * radius * staged.cage->size;
        if (reaches && (t[0] == dragged || t[1] == dragged || t[2] == dragged)) beyond[i] = false;
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
    for (Fused* f : {&fused, &by_threads}) f->frame.state.begin_drag(std::array{dragged});
    for (int step = 0; step < 4; ++step) {
      pose.positions[dragged] = pose.positions[dragged] + Vec3{0.02, 0.03, -0.01};
      fused.check(staged, pose);
      CHECK(fused.frame.engine.dragging());
      check();
      by_threads.frame.deform(pose);
      CHECK(by_threads.positions() == fused.positions());
      CHECK(by_threads.normals() == fused.normals());
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
