#include "base/text.h"

#include <doctest/doctest.h>

using namespace viete::base;

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
  CHECK(with_thousands(0) == "0");
  CHECK(with_thousands(999) == "999");
  CHECK(with_thousands(1000) == "1,000");
  CHECK(with_thousands(1074744) == "1,074,744");
}

TEST_CASE("nouns_are_singular_and_plural") {
  CHECK(counted(1, "face") == "1 face");
  CHECK(counted(0, "face") == "0 faces");
}

TEST_CASE("memory_is_in_megabytes_below_a_gigabyte") {
  CHECK(memory_size(12) == "1 MB");
  CHECK(memory_size(87.6e6) == "88 MB");
  CHECK(memory_size(999.4e6) == "999 MB");
  CHECK(memory_size(999.6e6) == "1.0 GB");
  CHECK(memory_size(1.24e9) == "1.2 GB");
}
