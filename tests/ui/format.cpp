#include "ui/format.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace viete::ui;

TEST_CASE("errors_say_nan_and_exact_zero") {
  CHECK(error(0) == "0");
  CHECK(error(3.14e-16) == "3.1e-16");
  CHECK(error(std::nan("")) == "NaN");
}

TEST_CASE("measures_have_six_digits_and_their_unit") {
  using viete::scene::LengthUnit;
  CHECK(measured(0.123456789, LengthUnit::unknown) == "0.123457");
  CHECK(measured(0.123456789, LengthUnit::millimetre) == "0.123457 mm");
  CHECK(measured(1.5, LengthUnit::inch, 2) == "1.5 in\u00b2");
}
