// What weights by distance must do, whichever they are.
#pragma once

#include <doctest/doctest.h>

#include <numeric>

#include "deform/shapes.h"

namespace viete::test {

/// weights_at(cage, point): the same at every length scale, and summing to one at the cage's own vertices.
template <class WeightsAt>
void check_every_length_scale(const WeightsAt& weights_at) {
  const auto unit = box({1, 2, 3});
  const Cage cage = make_cage(unit);
  Random random(5);
  for (const double s : {1e-30, 1e-3, 1e3, 1e30}) {
    auto scaled = unit;
    for (auto& p : scaled.positions) p = s * p;
    const Cage other = make_cage(scaled);
    for (int n = 0; n < 50; ++n) {
      const Vec3 p = random.vector(4);
      const auto a = weights_at(cage, p), b = weights_at(other, s * p);
      for (std::size_t e = 0; e < a.size(); ++e) CHECK(a[e] == doctest::Approx(b[e]).epsilon(1e-10));
    }
    for (const auto& p : scaled.positions) {
      const auto w = weights_at(other, p);
      CHECK(std::accumulate(w.begin(), w.end(), 0.0) == doctest::Approx(1));
    }
  }
}

}  // namespace viete::test
