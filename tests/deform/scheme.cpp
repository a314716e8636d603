#include "deform/scheme.h"

#include <doctest/doctest.h>

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
