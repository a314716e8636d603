#include "deform/scheme.h"

#include <doctest/doctest.h>

#include <limits>
#include <set>
#include <string>

#include "base/error.h"

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
  check_table(all_elements());
  check_table(all_weights());
  check_table(all_blends());
}

TEST_CASE("a_combination_is_completed_from_any_part_of_it") {
  CHECK(complete({}).shorthand == "face");
  for (const Combination& c : combinations()) {
    CHECK(&complete({c.elements, c.weights, c.blend}) == &c);
    CHECK(&combination_of({{c.elements, c.weights}, c.blend}) == &c);
  }
  CHECK(complete({.weights = Weights::mean_value}).shorthand == "mvc");
  CHECK(complete({.elements = Elements::point}).shorthand == "mvc");
  CHECK(complete({.blend = Blend::linear}).elements == Elements::face);
}

TEST_CASE("choices_that_do_not_go_together_are_refused_with_those_that_do") {
  try {
    complete({.elements = Elements::face, .weights = Weights::mean_value});
    FAIL("was not refused");
  } catch (const viete::base::Error& error) {
    const std::string what = error.what();
    CHECK(what.find("do not go together") != std::string::npos);
    CHECK(what.find("--elements point --weights mean-value --blend linear") != std::string::npos);
    CHECK(what.find("--elements face --weights inverse --blend srl") != std::string::npos);
  }
}

TEST_CASE("shorthands_stand_for_combinations") {
  CHECK(combination_of_shorthand("face")->blend == Blend::srl);
  CHECK(combination_of_shorthand("mvc")->weights == Weights::mean_value);
  CHECK(combination_of_shorthand("") == nullptr);
  CHECK(combination_of_shorthand("linear") == nullptr);
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
  CHECK(with({near, Blend::srl}, *combination_of_shorthand("mvc")).weighting.reach == 3);
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
