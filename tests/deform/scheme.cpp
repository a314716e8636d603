#include "deform/scheme.h"

#include <doctest/doctest.h>

#include <limits>
#include <set>
#include <string>

#include "base/error.h"
#include "support/text.h"

using namespace viete::deform;
using viete::test::mentions;

namespace {

template <class Entry>
void check_table(std::span<const Entry> table) {
  std::set<std::string_view> names;
  for (const Entry& e : table) {
    CHECK(&entry(e.value) == &e);
    CHECK(find_by_name(table, e.name) == e.value);
    CHECK_FALSE(e.sentence.empty());
    names.insert(e.name);
  }
  CHECK(names.size() == table.size());
  CHECK_FALSE(find_by_name(table, "").has_value());
  CHECK_FALSE(find_by_name(table, "nonsense").has_value());
}

}  // namespace

TEST_CASE("every_choice_is_found_by_its_value_and_by_its_name") {
  check_table(all_elements());
  check_table(all_weights());
  check_table(all_blends());
}

TEST_CASE("a_scheme_is_completed_from_any_part_of_it") {
  CHECK(shorthand(complete({})) == "face");
  for (const Scheme& s : all_schemes()) {
    CAPTURE(text(s));
    CHECK_FALSE(conflict(s));
    CHECK(complete(choices(s)) == s);
    CHECK(complete({}, s) == s);
  }
  CHECK(shorthand(complete({.weights = Weights::mean_value})) == "mvc");
  CHECK(shorthand(complete({.elements = Elements::point})) == "mvc");
  CHECK(text(complete({.blend = Blend::linear})) == "face, inverse, linear");
}

TEST_CASE("maps_are_fitted_to_points_where_that_is_asked_for_and_from_then_on") {
  CHECK(text(complete({.blend = Blend::mls_rigid})) == "point, inverse, mls-rigid");
  CHECK(text(complete({.elements = Elements::point, .weights = Weights::harmonic})) ==
        "point, harmonic, mls-affine");
  const Scheme rigid = complete({.blend = Blend::mls_rigid});
  CHECK(text(complete(only(Weights::biharmonic), rigid)) == "point, biharmonic, mls-rigid");
  CHECK(text(complete(only(Elements::face), rigid)) == "face, inverse, srl");
}

TEST_CASE("one_choice_changes_no_more_of_the_others_than_it_must") {
  for (const Scheme& now : all_schemes()) {
    for (const Scheme& other : all_schemes()) {
      Scheme wished = now;
      wished.blend = other.blend;
      const Scheme chosen = complete(only(other.blend), now);
      CHECK(chosen.blend == other.blend);
      if (!conflict(wished)) CHECK(chosen == wished);
    }
  }
}

TEST_CASE("every_scheme_is_sensible_once_and_every_choice_is_part_of_one") {
  const auto& all = all_schemes();
  for (std::size_t i = 0; i < all.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(all[i] == all[j]);
  }
  for (const auto& e : all_elements()) CHECK_NOTHROW(complete(only(e.value)));
  for (const auto& e : all_weights()) CHECK_NOTHROW(complete(only(e.value)));
  for (const auto& e : all_blends()) CHECK_NOTHROW(complete(only(e.value)));
}

TEST_CASE("choices_that_do_not_go_together_are_refused_with_the_reason") {
  const struct {
    PartialChoice choice;
    const char* reason;
  } cases[] = {
      {{.elements = Elements::face, .weights = Weights::mean_value}, "mean values belong to vertices"},
      {{.elements = Elements::point, .weights = Weights::inverse, .blend = Blend::linear},
       "reproduce linear functions"},
      {{.elements = Elements::face, .blend = Blend::mls_rigid}, "have maps already"},
      {{.weights = Weights::mean_value, .blend = Blend::mls_affine}, "nothing left to turn"},
      {{.elements = Elements::point, .blend = Blend::srl}, "translations have no logarithms"}};
  for (const auto& c : cases) {
    try {
      complete(c.choice);
      FAIL("was not refused");
    } catch (const viete::base::Error& error) {
      CHECK(mentions(error.what(), "do not go together"));
      CHECK(mentions(error.what(), c.reason));
    }
  }
}

TEST_CASE("shorthands_stand_for_schemes") {
  CHECK(scheme_of_shorthand("face") == Scheme());
  CHECK(scheme_of_shorthand("mvc")->weighting.weights == Weights::mean_value);
  CHECK_FALSE(scheme_of_shorthand("").has_value());
  CHECK_FALSE(scheme_of_shorthand("linear").has_value());
}

TEST_CASE("elements_that_have_the_same_weights_share_bindings_but_are_other_schemes") {
  const Weighting faces{}, patches{Elements::patch}, points{Elements::point, Weights::mean_value};
  CHECK(faces == patches);
  CHECK_FALSE(faces == points);
  CHECK_FALSE(Scheme{faces} == Scheme{patches});
  CHECK(weighed_as(Elements::patch) == Elements::face);
  CHECK(weighed_as(Elements::point) == Elements::point);
}

TEST_CASE("a_reach_counts_only_where_weights_have_one") {
  const Weighting all{}, near{Elements::face, Weights::inverse, 3};
  const Weighting points{Elements::point, Weights::mean_value},
      near_points{Elements::point, Weights::mean_value, 3};
  CHECK(near.local());
  CHECK_FALSE(all.local());
  CHECK_FALSE(near_points.local());
  CHECK_FALSE(near == all);
  CHECK(points == near_points);
  CHECK_FALSE(all == points);
  CHECK(complete({.weights = Weights::mean_value}, {near}).weighting.reach == 3);
}

TEST_CASE("a_reach_is_written_as_it_is_read") {
  for (const double reach : {1.5, 2.0, 3.25, 1e9, whole_cage}) {
    CHECK(reach_from_text(text_of_reach(reach)) == reach);
  }
  CHECK(text_of_reach(3) == "3");
  CHECK(text_of_reach(whole_cage) == "all");
  for (const char* text : {"", "1.4", "nan", "inf", "3x", " 3", "-2", "whole"}) {
    CHECK_FALSE(reach_from_text(text).has_value());
  }
}

TEST_CASE("stitching_stays_with_what_it_goes_with_and_makes_another_scheme") {
  Scheme stitched;
  stitched.iterations = 2;
  CHECK(stitched != Scheme());
  CHECK(stitched.stitched());
  CHECK_FALSE(conflict(stitched));
  CHECK(text(stitched) == "face, inverse, srl, stitched");
  CHECK(complete(only(Elements::patch), stitched).iterations == 2);
  CHECK(complete(only(Elements::point), stitched).iterations == 0);
  Scheme points = *scheme_of_shorthand("mvc");
  points.iterations = 1;
  CHECK(conflict(points));
  for (const Scheme& scheme : all_schemes()) CHECK_FALSE(scheme.stitched());
}
