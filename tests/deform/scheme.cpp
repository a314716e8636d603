#include "deform/scheme.h"

#include <doctest/doctest.h>

#include <limits>
#include <set>
#include <string>

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

TEST_CASE("valid_schemes_are_all_that_have_no_conflict_each_once") {
  const auto& valid = valid_schemes();
  CHECK(valid.size() == 239);  // what runs, see offered_schemes() for what is offered
  for (std::size_t i = 0; i < valid.size(); ++i) {
    CHECK_FALSE(conflict(valid[i]));
    CHECK_FALSE(valid[i].stitched());
    for (std::size_t j = 0; j < i; ++j) CHECK_FALSE(valid[i] == valid[j]);
  }
}
