#include "bench/time.h"

#include <doctest/doctest.h>

#include "mesh/summary.h"

using namespace viete;
using bench::Bar, bench::Volumes, bench::volumes_between_keys;

TEST_CASE("the_bar_is_closed_as_large_as_said_and_inside_its_cage") {
  const Bar bar;
  const mesh::Summary summary = mesh::summarize(bar.model);
  CHECK(summary.closed());
  CHECK(summary.oriented());
  CHECK(summary.volume == doctest::Approx(4));
  CHECK(summary.vertices > 900);
  CHECK(bar.cage->closed);
  CHECK(mesh::bounds(bar.cage->surface.positions).high[0] > 0.55);
}

TEST_CASE("a_bar_that_turns_keeps_its_volume_in_log_space_and_loses_all_of_it_in_a_straight_line") {
  const Bar bar;
  const Volumes log = volumes_between_keys(bar.model, bar.cage, bar.turned(), false, 12);
  CHECK(log.deviation() < 1e-6);
  const Volumes straight = volumes_between_keys(bar.model, bar.cage, bar.turned(), true, 12);
  CHECK(std::abs(straight.least) < 1e-6);
  CHECK(straight.first == doctest::Approx(1));
  CHECK(straight.last == doctest::Approx(1));
}

TEST_CASE("a_bar_whose_end_is_twisted_loses_little_in_log_space_and_much_in_a_straight_line") {
  const Bar bar;
  const Volumes log = volumes_between_keys(bar.model, bar.cage, bar.twisted(), false, 12);
  const Volumes straight = volumes_between_keys(bar.model, bar.cage, bar.twisted(), true, 12);
  CHECK(log.loss() < 0.03);
  CHECK(straight.loss() > 0.2);
  CHECK(log.first == doctest::Approx(1));
  CHECK(log.last == doctest::Approx(straight.last));
}

TEST_CASE("both_engines_find_the_same_volumes") {
  const Bar bar;
  const Volumes in_double = volumes_between_keys(bar.model, bar.cage, bar.twisted(), false, 4);
  const Volumes fast = volumes_between_keys(bar.model, bar.cage, bar.twisted(), false, 4, false);
  CHECK(fast.least == doctest::Approx(in_double.least).epsilon(1e-3));
}

TEST_CASE("deviation_and_loss_are_of_rest_and_of_the_smaller_key") {
  const Volumes v{.least = 0.7, .most = 1.1, .first = 1, .last = 0.8};
  CHECK(v.deviation() == doctest::Approx(0.3));
  CHECK(v.loss() == doctest::Approx(0.125));
}
