#include "deform/weights.h"

#include <doctest/doctest.h>

#include <numeric>

#include "deform/closest.h"
#include "deform/shapes.h"

using namespace viete::test;

namespace {

std::vector<double> weights_at(const Cage& cage, const Vec3& p) {
  std::vector<double> w(cage.element_count());
  inverse_distance_weights(cage, p, w);
  return w;
}

double sum(const std::vector<double>& w) {
  return std::accumulate(w.begin(), w.end(), 0.0);
}

}  // namespace

TEST_CASE("weights_are_inverse_squared_distances_normalised") {
  const Cage cage = make_cage(box({1, 2, 3}));
  const Vec3 p{0.3, -0.7, 1.1};
  const auto w = weights_at(cage, p);
  CHECK(sum(w) == doctest::Approx(1).epsilon(1e-15));
  const auto inverse = [&](std::size_t e) {
    const auto& t = cage.surface.triangles[e];
    const auto& x = cage.surface.positions;
    return 1 / closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance;
  };
  double total = 0;
  for (std::size_t e = 0; e < w.size(); ++e) total += inverse(e);
  for (std::size_t e = 0; e < w.size(); ++e)
    CHECK(w[e] == doctest::Approx(inverse(e) / total).epsilon(1e-14));
}

TEST_CASE("on_a_vertex_the_elements_that_meet_there_share_equally") {
  const Cage cage = make_cage(box());
  for (std::size_t v = 0; v < 8; ++v) {
    const auto w = weights_at(cage, cage.surface.positions[v]);
    double touching = 0;
    for (const auto& t : cage.surface.triangles) touching += t[0] == v || t[1] == v || t[2] == v;
    for (std::size_t e = 0; e < w.size(); ++e) {
      const auto& t = cage.surface.triangles[e];
      const bool touches = t[0] == v || t[1] == v || t[2] == v;
      if (touches)
        CHECK(w[e] == doctest::Approx(1 / touching));
      else
        CHECK(w[e] < 1e-20);
    }
  }
}

TEST_CASE("on_a_face_its_element_has_all_the_weight") {
  const Cage cage = make_cage(box());
  for (std::size_t e = 0; e < cage.element_count(); ++e)
    CHECK(weights_at(cage, cage.centers[e])[e] == doctest::Approx(1));
}

TEST_CASE("near_an_element_weights_approach_the_limit_without_a_jump") {
  const Cage cage = make_cage(box());
  const Vec3 c = cage.centers[0];
  for (double d = 1e-1; d > 1e-20; d /= 10) {
    const auto w = weights_at(cage, c + Vec3{0, 0, d});
    CHECK(w[0] > 1 - 100 * d * d - 1e-14);
    CHECK(sum(w) == doctest::Approx(1));
  }
}

TEST_CASE("weights_are_the_same_at_every_length_scale_and_finite_everywhere") {
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
    for (const auto& p : scaled.positions) CHECK(sum(weights_at(other, p)) == doctest::Approx(1));
  }
}

TEST_CASE("elements_without_area_have_no_weight") {
  auto surface = box();
  surface = viete::mesh::from_triangles(surface.positions, [&] {
    auto t = surface.triangles;
    t.push_back({0, 1, 1});
    return t;
  }());
  const Cage cage = make_cage(surface);
  CHECK(weights_at(cage, {0.1, 0.2, 0.3}).back() == 0);
  CHECK(weights_at(cage, surface.positions[0]).back() == 0);
  CHECK(sum(weights_at(cage, surface.positions[1])) == doctest::Approx(1));
}
