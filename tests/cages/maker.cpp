#include <chrono>

#include "cages/judge.h"
#include "cages/make.h"
#include "cages/models.h"

using namespace viete;
using namespace viete::test;

TEST_CASE("a_box_has_its_cells_on_every_side_and_its_margin_around") {
  base::WorkerPool pool(1);
  const auto made = cages::make(cube(), {.kind = cages::Kind::box, .margin = 0.1, .cells = {2, 3, 4}}, pool);
  CHECK(made.surface.polygon_count() == 2 * (2 * 3 + 3 * 4 + 2 * 4));
  CHECK(made.surface.triangles.size() == 2 * made.surface.polygon_count());
  const double side = 1 + 0.1 * 2 * std::sqrt(3.0);
  const mesh::Bounds box = mesh::bounds(made.surface.positions);
  for (std::size_t k = 0; k < 3; ++k) {
    CHECK(box.low[k] == doctest::Approx(-side).epsilon(1e-14));
    CHECK(box.high[k] == doctest::Approx(side).epsilon(1e-14));
  }
}

TEST_CASE("a_box_along_own_axes_fits_a_turned_model_better") {
  base::WorkerPool pool(1);
  const mesh::Surface model = turned(stretched(cube(), {3, 1, 0.3}), 0.6);
  const auto volume = [&](bool own_axes) {
    return mesh::summarize(cages::make(model, {.kind = cages::Kind::box, .own_axes = own_axes}, pool).surface)
        .volume;
  };
  CHECK(volume(true) == doctest::Approx(8 * 3 * 1 * 0.3).epsilon(0.05));
  CHECK(volume(false) > 1.5 * volume(true));
}

namespace {

void check_equal(const cages::Made& a, const cages::Made& b) {
  CHECK(a.surface.positions == b.surface.positions);
  CHECK(a.surface.corners == b.surface.corners);
  CHECK(a.surface.triangles == b.surface.triangles);
  CHECK(a.notes == b.notes);
  CHECK(a.gap == b.gap);
  CHECK(a.mirror.has_value() == b.mirror.has_value());
}

const std::vector<cages::Wish> several = {
    {.triangles = 60},
    {.triangles = 90, .margin = 0.01, .effort = cages::Effort::preview},
    {.triangles = 60, .symmetry = cages::Symmetry::none, .quads = true},
    {.triangles = 40, .symmetry = cages::Symmetry::none},
    {.triangles = 60, .symmetry = cages::Symmetry::y},
    {.kind = cages::Kind::box},
};

void pause_for(double seconds) {
  std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
}

struct Work {
  base::Progress progress;
  std::atomic<bool> ended{false}, cancelled{false};
  std::thread thread;

  explicit Work(const mesh::Surface& model, const cages::Wish& wish)
      : thread([this, &model, wish] {
          base::WorkerPool pool(1);
          try {
            cages::make(model, wish, pool, &progress);
          } catch (const base::Cancelled&) {
            cancelled = true;
          }
          ended = true;
        }) {}
  ~Work() { thread.join(); }
};

}  // namespace

TEST_CASE("cages_are_the_same_for_any_number_of_threads") {
  const mesh::Surface model = without_lower_half(sphere(3));
  for (const std::size_t i : {0, 1, 3}) {
    const cages::Wish& wish = several[i];
    base::WorkerPool one(1), five(5);
    check_equal(cages::make(model, wish, one), cages::make(model, wish, five));
  }
}

TEST_CASE("maker_gives_the_same_cages_as_make_in_any_order") {
  base::WorkerPool pool(2);
  const auto model = std::make_shared<const mesh::Surface>(torus(16, 8));
  cages::Maker maker(model);
  for (const std::size_t i : {1, 5, 1}) {
    CAPTURE(i);
    check_equal(maker.make(several[i], pool), cages::make(*model, several[i], pool));
  }
}

TEST_CASE("wishes_are_clamped_to_their_ranges") {
  base::WorkerPool pool(1);
  const mesh::Surface model = sphere(3);
  check_equal(cages::make(model, {.triangles = 0, .margin = -1, .gap = 9}, pool),
              cages::make(model, {.triangles = 12, .margin = 0.0005, .gap = 0.2}, pool));
  check_equal(cages::make(model, {.kind = cages::Kind::box, .margin = 9, .cells = {0, 99, 3}}, pool),
              cages::make(model, {.kind = cages::Kind::box, .margin = 0.2, .cells = {1, 32, 3}}, pool));
}

TEST_CASE("single_points_and_empty_models_are_rejected") {
  base::WorkerPool pool(1);
  for (const auto& model : {points_only({{1, 2, 3}}), points_only({}), points_only({{1, 1, 1}, {1, 1, 1}}),
                            mesh::from_triangles({{0, 0, 0}, {5, 5, 5}}, {{0, 0, 0}})}) {
    for (const auto kind : {cages::Kind::automatic, cages::Kind::box}) {
      try {
        cages::make(model, {.kind = kind}, pool);
        FAIL_CHECK("made");
      } catch (const base::Error& error) {
        CHECK(error.problem().find("single point") != std::string::npos);
        CHECK_FALSE(error.advice().empty());
      }
    }
  }
}

TEST_CASE("cage_making_can_be_cancelled_quickly") {
  const mesh::Surface model = sphere(5);
  for (const double share : {0.02, 0.5}) {
    CAPTURE(share);
    bool cancelled = false;
    for (int i = 0; i < 20 && !cancelled; ++i) {  // repeats: a cage can be ready before it is cancelled
      Work work(model, {.triangles = 100});
      for (double last = 0; work.progress.done() < share && !work.ended; pause_for(1e-4))
        CHECK(work.progress.done() >= std::exchange(last, work.progress.done()));
      work.progress.cancel();
      const double asked = work.progress.done();
      while (!work.ended) pause_for(1e-4);
      CHECK(work.progress.done() < asked + 0.1);  // progress counts work, not time
      cancelled = work.cancelled;
    }
    CHECK(cancelled);
  }
}

TEST_CASE("cancelling_does_not_change_the_next_cage") {
  const auto model = std::make_shared<const mesh::Surface>(stool());
  base::WorkerPool pool(1);
  cages::Maker maker(model);
  base::Progress stopped;
  stopped.cancel();
  CHECK_THROWS_AS(maker.make({.triangles = 60}, pool, &stopped), base::Cancelled);
  CHECK(maker.make({.triangles = 60}, pool).surface.positions ==
        cages::make(*model, {.triangles = 60}, pool).surface.positions);
}
