#include "deform/vec3.h"

#include <doctest/doctest.h>

#include "deform/shapes.h"

using namespace viete::test;

TEST_CASE("cross_products_of_swapped_vectors_are_opposite_to_the_last_bit") {
  Random random(1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 a = random.vector(1), b = random.vector(1);
    CHECK(cross(a, b) == -1.0 * cross(b, a));
  }
}

TEST_CASE("cross_product_is_right_handed") {
  CHECK(cross({1, 0, 0}, {0, 1, 0}) == Vec3{0, 0, 1});
}
