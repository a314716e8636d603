#include "deform/ways.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <set>
#include <string>

#include "base/error.h"
#include "support/text.h"

using namespace viete::deform;
using viete::test::mentions;

namespace {

bool is_offered(const Scheme& scheme) {
  const auto& offered = offered_schemes();
  return std::ranges::find(offered, scheme) != offered.end();
}

}  // namespace

TEST_CASE("six_ways_have_names_and_each_is_known_again_by_its_scheme") {
  std::set<std::string_view> names;
  for (const WayEntry& way : all_ways()) {
    CAPTURE(way.name);
    CHECK(&entry(way.value) == &way);
    CHECK(find_by_name(all_ways(), way.name) == way.value);
    CHECK_FALSE(way.sentence.empty());
    CHECK_FALSE(conflict(way.scheme));
    CHECK(way_of(way.scheme) == way.value);
    CHECK(scheme_of(way.value) == way.scheme);
    names.insert(way.name);
  }
  CHECK(names.size() == 6);
  CHECK(default_scheme() == entry(Way::smooth).scheme);
  CHECK(default_scheme(false) == entry(Way::paper).scheme);
  CHECK(scheme_of(Way::paper) == Scheme{});
}

TEST_CASE("a_way_stays_itself_under_amounts_radius_and_iterations_and_is_another_one_under_all_else") {
  for (const WayEntry& way : all_ways()) {
    CAPTURE(way.name);
    Scheme s = way.scheme;
    s.amounts = {0.5, 1.5};
    s.weighting.radius = 0.4;
    if (s.stitched()) s.iterations = 4;
    if (s.stitched()) s.holding = {0.1, 0.2};
    CHECK(way_of(s) == way.value);
    if (entry(s.weighting.elements).affine) {
      Scheme other = s;
      other.iterations = s.stitched() ? 0 : 1;
      CHECK(way_of(other) != way.value);
    }
    const WeightSettings& has = entry(s.weighting.weights).has;
    Scheme changed = s;
    if (has.reach) changed.weighting.reach = 3;
    if (has.normalise) changed.weighting.normalise = true;
    if (has.clamp) changed.weighting.clamp = false;
    if (has.reach || has.normalise || has.clamp) CHECK_FALSE(way_of(changed).has_value());
    changed = s;
    changed.weighting.as_before = true;
    CHECK(way_of(changed).has_value() != s.changed_in_03());
  }
}

TEST_CASE("what_is_offered_is_one_choice_away_from_a_way_or_published") {
  CHECK(offered_schemes().size() == 54);
  for (const WayEntry& way : all_ways()) {
    Scheme plain = way.scheme;
    plain.iterations = 0;
    CHECK_MESSAGE(is_offered(plain), way.name);
    for (const Scheme& s : valid_schemes()) {
      const int same = (s.weighting.elements == plain.weighting.elements) +
                       (s.weighting.weights == plain.weighting.weights) + (s.blend == plain.blend);
      if (same >= 2) CHECK_MESSAGE(is_offered(s), text(s));
    }
  }
  CHECK_FALSE(is_offered(complete({Elements::edge, Weights::harmonic, Blend::log4})));
}

TEST_CASE("whatever_is_picked_is_there_and_what_is_offered_stays_among_what_is_offered") {
  const auto check_pick = [](auto choice, const Scheme& now) {
    const Scheme picked = chosen(choice, now);
    CHECK(fits(only(choice), picked));
    CHECK_FALSE(conflict(picked));
    Scheme wished = now, plain = picked;
    plain.iterations = 0;
    CHECK(is_offered(plain));
    if (fits(only(choice), now)) CHECK(picked == wished);
  };
  for (const Scheme& now : offered_schemes()) {
    for (const auto& e : all_elements()) check_pick(e.value, now);
    for (const auto& e : all_weights()) check_pick(e.value, now);
    for (const auto& e : all_blends()) check_pick(e.value, now);
  }
}

TEST_CASE("one_choice_changes_no_more_of_the_others_than_it_must") {
  for (const Scheme& now : offered_schemes()) {
    for (const auto& blend : all_blends()) {
      Scheme wished = now;
      wished.blend = blend.value;
      const Scheme completed = complete(only(blend.value), now);
      CHECK(completed.blend == blend.value);
      if (!conflict(wished)) CHECK(completed == wished);
      if (!conflict(wished) && is_offered(wished)) CHECK(chosen(blend.value, now) == wished);
    }
  }
}

TEST_CASE("words_of_older_sessions_stand_for_ways") {
  CHECK(way_of_old_word("face") == Way::paper);
  CHECK(way_of_old_word("mvc") == Way::mean_value);
  CHECK_FALSE(way_of_old_word("").has_value());
  CHECK_FALSE(way_of_old_word("linear").has_value());
  for (const Scheme& s : valid_schemes()) {
    if (!old_word(s).empty()) CHECK(scheme_of(*way_of_old_word(old_word(s))) == s);
  }
}

TEST_CASE("a_scheme_is_completed_from_any_part_of_it") {
  CHECK(old_word(complete({})) == "face");
  for (const Scheme& s : valid_schemes()) {
    CAPTURE(text(s));
    CHECK(complete({s.weighting.elements, s.weighting.weights, s.blend}) == s);
    CHECK(complete({}, s) == s);
  }
  CHECK(old_word(complete({.weights = Weights::mean_value})) == "mvc");
  CHECK(old_word(complete({.elements = Elements::point})) == "mvc");
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

TEST_CASE("stitching_stays_with_what_it_goes_with_and_makes_another_scheme") {
  Scheme stitched;
  stitched.iterations = 2;
  CHECK(stitched != Scheme());
  CHECK(stitched.stitched());
  CHECK_FALSE(conflict(stitched));
  CHECK(text(stitched) == "face, inverse, srl, stitched");
  CHECK(complete({.weights = Weights::mean_value}, {{Elements::face, Weights::inverse, 3}}).weighting.reach ==
        3);
  CHECK(complete(only(Elements::patch), stitched).iterations == 2);
  CHECK(complete(only(Elements::point), stitched).iterations == 0);
  Scheme points = scheme_of(Way::mean_value);
  points.iterations = 1;
  CHECK(conflict(points));
}
