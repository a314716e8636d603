#include "deform/point_weights.h"

#include <doctest/doctest.h>

#include "deform/bound.h"
#include "mesh/triangle.h"

using namespace viete::test;

namespace {

long double exact_distance(const Cage& cage, std::uint32_t face, const Vec3& p) {
  const auto& x = cage.surface.positions;
  const auto& t = cage.surface.triangles[face];
  return std::sqrt(
      (long double)viete::mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance);
}

}  // namespace

TEST_CASE("cut_off_weights_are_their_definition_and_say_how_much_reaches_a_point") {
  const Cage cage = make_cage(box({1, 2, 3}));
  Random random(5);
  std::vector<double> w(cage.element_count());
  std::size_t none = 0, some = 0, all = 0;
  for (int n = 0; n < 500; ++n) {
    const Vec3 p = random.vector(4);
    const Weighting weighting = viete::test::cut_off(0.2);
    const double total = cut_off_weights(cage, p, weighting, w);
    long double expected = 0, sum = 0;
    for (std::uint32_t e = 0; e < w.size(); ++e) {
      const long double d = exact_distance(cage, e, p) / (0.2L * cage.size);
      const long double own = d < 1 ? (1 - d) * (1 - d) : 0;
      expected += own, sum += w[e];
      CHECK(std::abs(w[e] * total - double(own)) < 1e-14);
      if (d >= 1) CHECK(w[e] == 0);
    }
    CHECK(total == doctest::Approx(double(expected)).epsilon(1e-12));
    CHECK(share_of_motion(total) == std::min(total, 1.0));
    if (total > 0) CHECK(double(sum) == doctest::Approx(1).epsilon(1e-14));
    none += total == 0, some += total > 0 && total < 1, all += total >= 1;
  }
  CHECK(std::min({none, some, all}) > 50);
}

TEST_CASE("cut_off_weights_know_no_length_scale_and_both_sides_of_a_face") {
  const auto surface = box({1, 2, 3});
  for (const double scale : {1e-30, 1e-3, 1e6, 1e30}) {
    auto scaled = surface;
    for (auto& p : scaled.positions) p = scale * p;
    const Cage here = make_cage(surface), there = make_cage(scaled);
    std::vector<double> a(here.element_count()), b(a.size());
    for (const Vec3& p : {Vec3{0.9, 0.1, 0.2}, Vec3{1.1, 0.1, 0.2}, Vec3{1, 0, 0}}) {
      const double t = cut_off_weights(here, p, viete::test::cut_off(0.1), a);
      CHECK(cut_off_weights(there, scale * p, viete::test::cut_off(0.1), b) ==
            doctest::Approx(t).epsilon(1e-12));
      for (std::size_t e = 0; e < a.size(); ++e) CHECK(a[e] == doctest::Approx(b[e]).epsilon(1e-12));
    }
  }
  const Cage cage = make_cage(surface);
  std::vector<double> inside(cage.element_count()), outside(inside.size());
  const double t = cut_off_weights(cage, {0.9, 0, 0}, viete::test::cut_off(0.05), inside);
  CHECK(cut_off_weights(cage, {1.1, 0, 0}, viete::test::cut_off(0.05), outside) == doctest::Approx(t));
}

TEST_CASE("on_an_element_a_cut_off_weight_is_finite") {
  const Cage cage = make_cage(box({1, 1, 1}));
  std::vector<double> w(cage.element_count());
  const Weighting weighting = viete::test::cut_off(0.01);
  const Vec3 on = cage.centers[0];
  CHECK(cut_off_weights(cage, on, weighting, w) == doctest::Approx(1));
  CHECK(w[0] == doctest::Approx(1));
  CHECK(cut_off_weights(cage, {0, 0, 0}, weighting, w) == 0);
  for (const double x : w) CHECK(x == 0);
}
