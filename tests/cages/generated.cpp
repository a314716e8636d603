#include "cages/judge.h"
#include "cages/make.h"
#include "cages/models.h"

using namespace viete;
using namespace viete::test;

namespace {

void check_sound(const NamedModel& model, const cages::Wish& wish) {
  CAPTURE(model.name);
  CAPTURE(wish.triangles);
  base::WorkerPool pool(2);
  for (const std::string& complaint : complaints(cages::make(model.surface, wish, pool), model.surface, wish))
    FAIL_CHECK(complaint);
}

// Each model is tested with one of these wishes, in turn.
const std::vector<cages::Wish> wishes = {
    {.triangles = 12},
    {.triangles = 200, .effort = cages::Effort::preview},
    {.triangles = 100,
     .margin = 0.05,
     .gap = 0,
     .symmetry = cages::Symmetry::x,
     .quads = true,
     .effort = cages::Effort::preview},
    {.triangles = 201,
     .margin = 0.0005,
     .gap = 0.1,
     .symmetry = cages::Symmetry::none,
     .effort = cages::Effort::preview},
    {.triangles = 40,
     .margin = 0.2,
     .gap = 0.2,
     .symmetry = cages::Symmetry::z,
     .effort = cages::Effort::preview},
};

}  // namespace

TEST_CASE("every_kind_of_model_gets_a_cage_of_sixty_triangles" * doctest::test_suite(longer)) {
  for (const NamedModel& model : generated_models()) check_sound(model, {.triangles = 60});
}

TEST_CASE("every_kind_of_model_gets_a_cage_for_any_wish" * doctest::test_suite(longer)) {
  std::size_t next = 0;
  for (const NamedModel& model : generated_models()) check_sound(model, wishes[next++ % wishes.size()]);
}

TEST_CASE("every_kind_of_model_gets_boxes" * doctest::test_suite(longer)) {
  for (const NamedModel& model : generated_models()) {
    check_sound(model, {.kind = cages::Kind::box, .cells = {2, 3, 4}});
    check_sound(model, {.kind = cages::Kind::box, .margin = 0.02, .own_axes = true});
  }
}

TEST_CASE("large_cages_are_sound_too") {
  check_sound({"torus", torus(30, 12)}, {.triangles = 600, .quads = true});
  check_sound({"torus", torus(60, 30)}, {.triangles = 2000, .effort = cages::Effort::preview});
}

TEST_CASE("handles_and_components_are_kept_or_closed_with_a_note") {
  base::WorkerPool pool(2);
  const auto genus_of = [](const mesh::Surface& s) { return mesh::topology(s, mesh::summarize(s))->genus; };
  const auto ring = cages::make(torus(40, 20), {.triangles = 200}, pool);
  CHECK(genus_of(ring.surface) == 1);
  CHECK(ring.notes.empty());
  const auto closed = cages::make(stool(), {.triangles = 40}, pool);
  CHECK(genus_of(closed.surface) <= 1);
  CHECK(closed.gap > cages::Wish{}.gap);
  CHECK(some_note_holds(closed, "closed gaps up to "));
  const auto apart =
      cages::make(both(sphere(3), stretched(sphere(3), {1, 1, 1}, {4, 0, 0})), {.triangles = 200}, pool);
  CHECK(mesh::summarize(apart.surface).parts == 2);
  CHECK(apart.notes.empty());
}

TEST_CASE("tiny_components_do_not_loosen_the_cage_elsewhere") {
  base::WorkerPool pool(2);
  const mesh::Surface small = stretched(sphere(2), {0.003, 0.003, 0.003}, {3, 0.1, 0.2});
  const mesh::Surface model = both(sphere(4), small);
  const auto made = cages::make(model, {.triangles = 600}, pool);
  CHECK(mesh::summarize(made.surface).volume < 1.5 * mesh::summarize(sphere(4)).volume);
}

TEST_CASE("gaps_up_to_the_given_width_are_closed") {
  base::WorkerPool pool(2);
  const mesh::Surface plates =
      both(stretched(cube(), {1, 1, 0.05}), stretched(cube(), {1, 1, 0.05}, {0, 0, 0.5}));
  const auto parts = [&](double gap) {
    return mesh::summarize(cages::make(plates, {.triangles = 300, .gap = gap}, pool).surface).parts;
  };
  CHECK(parts(0.01) == 2);
  CHECK(parts(0.15) == 1);
}

TEST_CASE("repeated_corners_and_duplicate_faces_do_not_slow_cage_making") {
  const auto box = [](std::size_t rounds, std::size_t copies) {
    Surface s;
    s.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1.2, 0}, {0, 1.2, 0},
                   {0, 0, 1}, {1, 0, 1}, {1, 1.2, 1}, {0, 1.2, 1}};
    s.polygon_starts.push_back(0);
    const auto add = [&](std::initializer_list<std::uint32_t> face, std::size_t times) {
      for (std::size_t i = 0; i < times; ++i) s.corners.insert(s.corners.end(), face);
      s.polygon_starts.push_back(static_cast<std::uint32_t>(s.corners.size()));
    };
    for (std::size_t i = 0; i < copies; ++i) add({0, 3, 2, 1}, rounds);
    add({4, 5, 6, 7}, 1);
    add({0, 1, 5, 4}, 1);
    add({1, 2, 6, 5}, 1);
    add({2, 3, 7, 6}, 1);
    add({3, 0, 4, 7}, 1);
    mesh::triangulate(s);
    return s;
  };
  base::WorkerPool pool(2);
  const cages::Wish wish{.triangles = 60, .effort = cages::Effort::preview};
  const auto once = cages::make(box(1, 1), wish, pool);
  using Times = std::pair<std::size_t, std::size_t>;
  for (const auto& [rounds, copies] : {Times{2, 1}, Times{200, 1}, Times{1, 200}}) {
    check_sound({"round and round", box(rounds, copies)}, wish);
    CHECK(cages::make(box(rounds, copies), wish, pool).notes == once.notes);
  }
}
