#include "scene/document/selection.h"

#include <doctest/doctest.h>

using namespace viete::scene;
using Indices = std::vector<std::uint32_t>;

TEST_CASE("modes_replace_add_and_remove") {
  Selection s;
  s.apply(Indices{2, 5}, SelectMode::replace);
  s.apply(Indices{1, 5, 9}, SelectMode::add);
  CHECK(s.indices() == Indices{1, 2, 5, 9});
  s.apply(Indices{2, 3}, SelectMode::remove);
  CHECK(s.indices() == Indices{1, 5, 9});
  s.apply(Indices{}, SelectMode::replace);
  CHECK(s.empty());
}

TEST_CASE("inverting_twice_changes_nothing") {
  Selection s;
  s.apply(Indices{0, 3}, SelectMode::replace);
  s.invert(5);
  CHECK(s.indices() == Indices{1, 2, 4});
  CHECK(s.contains(4));
  CHECK_FALSE(s.contains(3));
  s.invert(5);
  CHECK(s.indices() == Indices{0, 3});
}

TEST_CASE("all_of_nothing_is_nothing") {
  Selection s;
  s.select_all(0);
  CHECK(s.empty());
  s.select_all(3);
  CHECK(s.size() == 3);
}
