#include "ui/format.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace viete::ui;

TEST_CASE("errors_say_nan_and_exact_zero") {
  CHECK(error(0) == "0");
  CHECK(error(3.14e-16) == "3.1e-16");
  CHECK(error(std::nan("")) == "NaN");
}
