#include "mesh/union_find.h"

#include <doctest/doctest.h>

using viete::mesh::UnionFind;

TEST_CASE("joined_sets_have_one_number_and_others_keep_theirs") {
  UnionFind sets(5);
  CHECK(sets.join(0, 1));
  CHECK(sets.join(3, 4));
  CHECK_FALSE(sets.join(1, 0));
  CHECK(sets.find(0) == sets.find(1));
  CHECK(sets.find(3) == sets.find(4));
  CHECK(sets.find(0) != sets.find(3));
  CHECK(sets.find(2) == 2);
  CHECK(sets.join(4, 0));
  CHECK(sets.find(1) == sets.find(3));
  sets.reset(2);
  CHECK(sets.find(1) != sets.find(0));
}
