#include "mesh/vector.h"

#include <doctest/doctest.h>

#include <random>

using namespace viete::mesh;

TEST_CASE("cross_products_of_swapped_vectors_are_opposite_to_the_last_bit") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> number(-1, 1);
  for (int n = 0; n < 1000; ++n) {
    const Vec3 a{number(engine), number(engine), number(engine)};
    const Vec3 b{number(engine), number(engine), number(engine)};
    CHECK(cross(a, b) == -1.0 * cross(b, a));
  }
}

TEST_CASE("cross_product_is_right_handed") {
  CHECK(cross({1, 0, 0}, {0, 1, 0}) == Vec3{0, 0, 1});
}

TEST_CASE("lengths_of_any_scale_are_measured") {
  for (const double scale : {1e-300, 1.0, 1e300}) {
    CHECK(stable_norm({2 * scale, -3 * scale, 6 * scale}) == doctest::Approx(7 * scale));
    CHECK(largest_abs({2 * scale, -3 * scale, 1 * scale}) == 3 * scale);
  }
  CHECK(norm({2, -3, 6}) == 7);
}
