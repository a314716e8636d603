// The door of the room: the same cage each time, whatever was made before.
#include "cages/make.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "cages/judge.h"
#include "cages/models.h"

using namespace viete;
using namespace viete::test;

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

}  // namespace

TEST_CASE("cages_are_the_same_for_any_number_of_threads") {
  const mesh::Surface model = without_lower_half(sphere(3));
  for (const std::size_t i : {0, 1, 3}) {
    const cages::Wish& wish = several[i];
    base::WorkerPool one(1), five(5);
    check_equal(cages::make(model, wish, one), cages::make(model, wish, five));
  }
}

TEST_CASE("a_maker_makes_the_same_cages_as_are_made_once_in_any_order") {
  base::WorkerPool pool(2);
  const auto model = std::make_shared<const mesh::Surface>(torus(16, 8));
  cages::Maker maker(model);
  for (const std::size_t i : {1, 5, 1}) {
    CAPTURE(i);
    check_equal(maker.make(several[i], pool), cages::make(*model, several[i], pool));
  }
}

TEST_CASE("wishes_beyond_their_ranges_count_as_the_ends_of_these") {
  base::WorkerPool pool(1);
  const mesh::Surface model = sphere(3);
  check_equal(cages::make(model, {.triangles = 0, .margin = -1, .gap = 9}, pool),
              cages::make(model, {.triangles = 12, .margin = 0.0005, .gap = 0.2}, pool));
  check_equal(cages::make(model, {.kind = cages::Kind::box, .margin = 9, .cells = {0, 99, 3}}, pool),
              cages::make(model, {.kind = cages::Kind::box, .margin = 0.2, .cells = {1, 32, 3}}, pool));
}

TEST_CASE("a_single_point_or_nothing_gets_no_cage_but_a_clear_word") {
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

TEST_CASE("all_choices_have_names_and_sentences") {
  for (const auto& entry : cages::all_kinds()) {
    CHECK(&cages::entry(entry.value) == &entry);
    CHECK_FALSE(entry.sentence.empty());
  }
  for (const auto& entry : cages::all_symmetries()) {
    CHECK(&cages::entry(entry.value) == &entry);
    CHECK_FALSE(entry.sentence.empty());
  }
}
