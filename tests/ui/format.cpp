#include "ui/format.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace viete::ui;

TEST_CASE("milliseconds_have_two_decimals_under_ten_and_three_digits_above") {
  CHECK(milliseconds(0.004) == "0.00 ms");
  CHECK(milliseconds(0.42) == "0.42 ms");
  CHECK(milliseconds(9.994) == "9.99 ms");
  CHECK(milliseconds(9.996) == "10.0 ms");
  CHECK(milliseconds(12.34) == "12.3 ms");
  CHECK(milliseconds(123.4) == "123 ms");
  CHECK(milliseconds(1234) == "1.23 s");
}

TEST_CASE("nanoseconds_become_microseconds_when_large") {
  CHECK(nanoseconds(3.21) == "3.21 ns");
  CHECK(nanoseconds(124) == "124 ns");
  CHECK(nanoseconds(1500) == "1.50 us");
}

TEST_CASE("counts_have_thousands_separators") {
  CHECK(count(0) == "0");
  CHECK(count(999) == "999");
  CHECK(count(1000) == "1,000");
  CHECK(count(1074744) == "1,074,744");
}

TEST_CASE("errors_say_nan_and_exact_zero") {
  CHECK(error(0) == "0");
  CHECK(error(3.14e-16) == "3.1e-16");
  CHECK(error(std::nan("")) == "NaN");
}
