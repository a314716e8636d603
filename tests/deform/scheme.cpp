#include <doctest/doctest.h>
#include <algorithm>
#include <set>
#include <string>

#include "base/error.h"
#include "deform/scheme.h"
#include "support/text.h"

using namespace viete::deform;

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
  check_table(all_weights());
  check_table(all_blends());
}

TEST_CASE("a_radius_counts_only_where_weights_have_one") {
  const Weighting near{Elements::face, Weights::cut_off, 0.1}, far{Elements::face, Weights::cut_off, 0.3};
  CHECK(near.partial());
  CHECK_FALSE(near == far);
  CHECK(Weighting{} == Weighting{Elements::face, Weights::inverse, 0.1});
  CHECK_FALSE(Weighting{} == near);
}

TEST_CASE("valid_schemes_are_all_that_have_no_conflict_each_once") {
  const auto valid = valid_schemes();
  CHECK(valid.size() == 21);
  for (std::size_t i = 0; i < valid.size(); ++i) {
    CHECK_FALSE(conflict(valid[i]));
    CHECK_FALSE(valid[i].stitched());
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(valid[i] == valid[j]);
  }
}

using viete::test::mentions;

TEST_CASE("six_named_deformers_are_recognised_by_their_schemes") {
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

TEST_CASE("amounts_radius_and_iterations_keep_the_deformer_and_other_changes_do_not") {
  for (const WayEntry& way : all_ways()) {
    CAPTURE(way.name);
    Scheme s = way.scheme;
    s.amounts = {0.5, 1.5};
    s.weighting.radius = 0.4;
    if (s.stitched()) s.iterations = 4;
    if (s.stitched()) s.holding = {0.1, 0.2};
    CHECK(way_of(s) == way.value);
    if (s.has_maps()) {
      Scheme other = s;
      other.iterations = s.stitched() ? 0 : 1;
      CHECK(way_of(other) != way.value);
    }
  }
}

TEST_CASE("a_pick_is_applied_with_the_fewest_other_changes") {
  const auto check_pick = [](auto choice, const Scheme& now) {
    const Scheme picked = chosen(choice, now);
    CHECK(fits(only(choice), picked));
    CHECK_FALSE(conflict(picked));
    CHECK(picked.weighting.elements == elements_of(picked.weighting.weights, picked.blend));
    if (fits(only(choice), now)) CHECK(picked == now);
    return picked;
  };
  for (const Scheme& now : valid_schemes()) {
    for (const auto& e : all_weights()) {
      const Scheme picked = check_pick(e.value, now);
      if (e.value != Weights::mean_value) CHECK(picked.blend == now.blend);
    }
    for (const auto& e : all_blends()) {
      const Scheme picked = check_pick(e.value, now);
      if (now.weighting.weights != Weights::mean_value)
        CHECK(picked.weighting.weights == now.weighting.weights);
    }
  }
}

TEST_CASE("a_scheme_is_completed_from_any_part_of_it") {
  CHECK(way_of(complete({})) == Way::paper);
  for (const Scheme& s : valid_schemes()) {
    CAPTURE(text(s));
    CHECK(complete({s.weighting.weights, s.blend}) == s);
    CHECK(complete({}, s) == s);
  }
  CHECK(way_of(complete({.weights = Weights::mean_value})) == Way::mean_value);
  CHECK(text(complete({.blend = Blend::linear})) == "inverse, linear");
}

TEST_CASE("maps_are_fitted_to_points_once_that_is_chosen") {
  const Scheme rigid = complete({.blend = Blend::mls_rigid});
  CHECK(text(rigid) == "inverse, mls-rigid");
  CHECK(text(complete(only(Weights::biharmonic), rigid)) == "biharmonic, mls-rigid");
  CHECK(text(complete(only(Weights::mean_value), rigid)) == "mean-value, linear");
  CHECK(text(complete(only(Blend::srl), scheme_of(Way::mean_value))) == "inverse, srl");
}

TEST_CASE("incompatible_choices_are_rejected_with_the_reason") {
  for (const Blend blend : {Blend::srl, Blend::mls_affine, Blend::mls_rigid}) {
    try {
      complete({.weights = Weights::mean_value, .blend = blend});
      FAIL("was not refused");
    } catch (const viete::base::Error& error) {
      CHECK(mentions(error.what(), "cannot be combined"));
      CHECK(mentions(error.what(), "move points"));
    }
  }
}

TEST_CASE("stitching_is_kept_if_compatible_and_changes_the_scheme") {
  Scheme stitched;
  stitched.iterations = 2;
  CHECK(stitched != Scheme());
  CHECK(stitched.stitched());
  CHECK_FALSE(conflict(stitched));
  CHECK(text(stitched) == "inverse, srl, stitched");
  CHECK(complete(only(Weights::mean_value), {{Elements::face, Weights::cut_off, 0.3}}).weighting.radius ==
        0.3);
  CHECK(complete(only(Weights::harmonic), stitched).iterations == 2);
  CHECK(complete(only(Weights::mean_value), stitched).iterations == 0);
  Scheme points = scheme_of(Way::mean_value);
  points.iterations = 1;
  CHECK(conflict(points));
}
