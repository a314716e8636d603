#include "ui/format.h"

#include <doctest/doctest.h>

#include <cmath>

#include "ui/panels.h"

using namespace viete::ui;

TEST_CASE("the_summary_of_checks_counts_problems_and_notes_apart") {
  using namespace viete;
  workspace::CheckState checks;
  CHECK(checks_summary(checks, 0) == "no problems");
  checks.findings.resize(2);  // open edges of the model
  checks.findings[0].subject = document::Subject::cage;
  CHECK(checks_summary(checks, 0) == "1 problem, 1 note");
  CHECK(checks_summary(checks, 1) == "2 problems, 1 note");
}

TEST_CASE("errors_say_nan_and_exact_zero") {
  CHECK(error(0) == "0");
  CHECK(error(3.14e-16) == "3.1e-16");
  CHECK(error(std::nan("")) == "NaN");
}
