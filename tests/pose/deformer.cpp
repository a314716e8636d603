#include <doctest/doctest.h>
#include <set>

#include "base/error.h"
#include "pose/deformer.h"
#include "support/text.h"

using namespace viete::pose;
using viete::test::mentions;

namespace {

template <class Value>
void check_choices() {
  std::set<std::string_view> words;
  for (const Value value : viete::base::all_values<Value>()) {
    const viete::base::Choice& choice = viete::base::entry_of(value);
    CHECK(viete::base::value_of_word<Value>(choice.word) == value);
    CHECK_FALSE(choice.hint.empty());
    words.insert(choice.word);
  }
  CHECK(words.size() == choices(Value{}).size());
  CHECK_FALSE(viete::base::value_of_word<Value>("nonsense").has_value());
}

}  // namespace

TEST_CASE("every_choice_is_found_by_its_value_and_by_its_name") {
  check_choices<Weights>();
  check_choices<Blend>();
  check_choices<Preset>();
  CHECK(choices(Preset{}).size() == 6);
}

TEST_CASE("every_number_is_found_by_its_name_and_is_used_by_some_deformer") {
  CHECK(all_numbers().size() == 5);
  for (const NumberEntry& n : all_numbers()) {
    CAPTURE(n.word);
    CHECK(&number(n.word) == &n);
    Deformer deformer;
    CHECK((n.least <= n.of(deformer) && n.of(deformer) <= n.largest));
    AskedDeformer asked;
    asked.*n.asked = 0.29;
    asked.arap = n.word == "attach" || n.word == "hold";
    deformer = deformer_of(asked, {});
    CHECK(n.of(deformer) == 0.29);
    CHECK(n.percent(deformer) == 29);
    const Deformer points = deformer_of(Preset::mean_value);
    CHECK_THROWS_AS(deformer_of(asked, points, true), viete::base::Error);
  }
}

TEST_CASE("a_radius_counts_only_where_weights_have_one") {
  const Weighting near{Elements::face, Weights::cut_off, 0.1}, far{Elements::face, Weights::cut_off, 0.3};
  CHECK(near.partial());
  CHECK_FALSE(near == far);
  CHECK(Weighting{} == Weighting{Elements::face, Weights::inverse, 0.1});
  CHECK_FALSE(Weighting{} == near);
}

TEST_CASE("valid_deformers_have_no_conflict_and_are_completed_from_any_part") {
  const auto valid = valid_deformers();
  CHECK(valid.size() == 21);
  for (std::size_t i = 0; i < valid.size(); ++i) {
    CAPTURE(text(valid[i]));
    CHECK_FALSE(conflict(valid[i]));
    CHECK_FALSE(valid[i].stitched());
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(valid[i] == valid[j]);
    CHECK(complete({valid[i].weighting.weights, valid[i].blend}) == valid[i]);
    CHECK(complete({}, valid[i]) == valid[i]);
  }
  CHECK(preset_of(complete({})) == Preset::paper);
  CHECK(preset_of(complete({.weights = Weights::mean_value})) == Preset::mean_value);
  CHECK(text(complete({.blend = Blend::linear})) == "inverse, linear");
}

TEST_CASE("presets_are_recognised_for_any_numbers") {
  for (const Preset preset : viete::base::all_values<Preset>()) {
    CAPTURE(viete::base::entry_of(preset).word);
    Deformer s = deformer_of(preset);
    CHECK_FALSE(conflict(s));
    CHECK(s.weighting.elements == elements_of(s.weighting.weights, s.blend));
    s.amounts = {0.5, 1.5};
    s.weighting.radius = 0.4;
    if (s.stitched()) {
      s.iterations = 4;
      s.holding = {0.1, 0.2};
    }
    CHECK(preset_of(s) == preset);
    s.iterations = s.stitched() ? 0 : 1;
    if (s.has_maps()) CHECK(preset_of(s) != preset);
  }
  CHECK(default_deformer() == deformer_of(Preset::smooth));
  CHECK(deformer_of(Preset::paper) == Deformer{});
}

TEST_CASE("a_pick_is_applied_with_the_fewest_other_changes") {
  const auto check_pick = [](auto choice, const Deformer& now) {
    const Deformer picked = chosen(choice, now);
    CHECK(fits(only(choice), picked));
    CHECK_FALSE(conflict(picked));
    CHECK(picked.weighting.elements == elements_of(picked.weighting.weights, picked.blend));
    if (fits(only(choice), now)) CHECK(picked == now);
    return picked;
  };
  for (const Deformer& now : valid_deformers()) {
    for (const Weights weights : viete::base::all_values<Weights>()) {
      const Deformer picked = check_pick(weights, now);
      if (weights != Weights::mean_value) CHECK(picked.blend == now.blend);
    }
    for (const Blend blend : viete::base::all_values<Blend>()) {
      const Deformer picked = check_pick(blend, now);
      if (now.weighting.weights != Weights::mean_value)
        CHECK(picked.weighting.weights == now.weighting.weights);
    }
  }
  const Deformer rigid = complete({.blend = Blend::mls_rigid});
  CHECK(text(complete(only(Weights::mean_value), rigid)) == "mean-value, linear");
  CHECK(text(complete(only(Blend::srl), deformer_of(Preset::mean_value))) == "inverse, srl");
}

TEST_CASE("incompatible_choices_are_rejected_with_the_reason") {
  for (const Blend blend : {Blend::srl, Blend::mls_affine, Blend::mls_rigid}) {
    try {
      complete({.weights = Weights::mean_value, .blend = blend});
      FAIL("was not refused");
    } catch (const viete::base::Error& error) {
      CHECK(mentions(error.what(), "cannot be combined"));
      CHECK(mentions(error.what(), "need the linear blend"));
    }
  }
}

TEST_CASE("stitching_is_kept_if_compatible_and_changes_the_deformer") {
  Deformer stitched;
  stitched.iterations = 2;
  CHECK(stitched != Deformer());
  CHECK(stitched.stitched());
  CHECK_FALSE(conflict(stitched));
  CHECK(text(stitched) == "inverse, srl, arap");
  CHECK(complete(only(Weights::harmonic), stitched).iterations == 2);
  CHECK(complete(only(Weights::mean_value), stitched).iterations == 0);
  Deformer points = deformer_of(Preset::mean_value);
  points.iterations = 1;
  CHECK(conflict(points));
}
