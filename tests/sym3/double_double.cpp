#include "sym3/double_double.h"

#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

using sym3::DoubleDouble;

namespace {

DoubleDouble random_number(Random& random) {
  const double hi = uniform(random, -2, 2) * std::exp2(uniform(random, -20, 20));
  return sym3::quick_two_sum(hi, hi * 0x1p-54 * uniform(random, -1, 1));
}

double relative(Quad computed, Quad exact) {
  return static_cast<double>(fabsq((computed - exact) / exact));
}

}  // namespace

TEST_CASE("double_double_operations_keep_104_bits") {
  Random random(71);
  for (int i = 0; i < 5000; ++i) {
    const DoubleDouble a = random_number(random), b = random_number(random);
    const Quad x = to_quad(a), y = to_quad(b);
    CHECK(relative(to_quad(a + b), x + y) < 0x1p-103);
    CHECK(relative(to_quad(a - b), x - y) < 0x1p-103);
    CHECK(relative(to_quad(a * b), x * y) < 0x1p-102);
    CHECK(relative(to_quad(a / b), x / y) < 0x1p-101);
    CHECK(relative(to_quad(sqrt(a * a)), fabsq(x)) < 0x1p-100);
  }
}

TEST_CASE("sums_and_products_of_doubles_are_exact") {
  Random random(72);
  for (int i = 0; i < 2000; ++i) {
    const double a = uniform(random, -1, 1), b = uniform(random, -1, 1) * 1e-3;
    CHECK(to_quad(sym3::two_product(a, b)) == Quad(a) * Quad(b));
    CHECK(to_quad(sym3::two_sum(a, b)) == Quad(a) + Quad(b));
  }
}
