#include "deform/point_weights.h"

#include <doctest/doctest.h>

#include <algorithm>
#include <numeric>

#include "deform/shapes.h"
#include "deform/weight_checks.h"
#include "mesh/triangle.h"

using namespace viete::test;

namespace {

std::vector<double> weights_at(const Cage& cage, const Vec3& p) {
  std::vector<double> w(cage.element_count());
  inverse_distance_weights(cage, p, w);
  return w;
}

using Long3 = std::array<long double, 3>;

long double long_dot(const Long3& a, const Long3& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

// To the plane where the foot lies inside, else to the nearest edge.
long double squared_distance(const Cage& cage, std::size_t e, const Vec3& point) {
  const auto difference = [](const auto& a, const auto& b) {
    return Long3{(long double)a[0] - b[0], (long double)a[1] - b[1], (long double)a[2] - b[2]};
  };
  const auto& x = cage.surface.positions;
  const auto& t = cage.surface.triangles[e];
  const Long3 u = difference(x[t[1]], x[t[0]]), v = difference(x[t[2]], x[t[0]]);
  const Long3 n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
  long double least = std::numeric_limits<long double>::infinity();
  bool inside = true;
  for (int i = 0; i < 3; ++i) {
    const Long3 d = difference(x[t[(i + 1) % 3]], x[t[i]]), q = difference(point, x[t[i]]);
    const Long3 inward{n[1] * d[2] - n[2] * d[1], n[2] * d[0] - n[0] * d[2], n[0] * d[1] - n[1] * d[0]};
    inside = inside && long_dot(inward, q) >= 0;
    const long double s = std::clamp<long double>(long_dot(d, q) / long_dot(d, d), 0, 1);
    const Long3 left{q[0] - s * d[0], q[1] - s * d[1], q[2] - s * d[2]};
    least = std::min(least, long_dot(left, left));
  }
  const long double height = long_dot(n, difference(point, x[t[0]]));
  return inside ? height * height / long_dot(n, n) : least;
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
    return 1 / viete::mesh::closest_on_triangle(p, x[t[0]], x[t[1]], x[t[2]]).squared_distance;
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
  check_every_length_scale([](const Cage& cage, const Vec3& p) { return weights_at(cage, p); });
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

TEST_CASE("weights_are_their_definition_in_long_double") {
  Random random(3);
  for (const auto& surface : {box({1, 2, 3}), tube(7, 12, 0.6, 2)}) {
    const Cage cage = make_cage(surface);
    double worst = 0;
    for (int n = 0; n < 500; ++n) {
      const Vec3 p = random.vector(2.5);
      const auto w = weights_at(cage, p);
      long double total = 0;
      for (std::size_t e = 0; e < w.size(); ++e) total += 1 / squared_distance(cage, e, p);
      for (std::size_t e = 0; e < w.size(); ++e)
        worst = std::max(worst, double(std::abs(w[e] - 1 / squared_distance(cage, e, p) / total)));
    }
    CHECK(worst < 2e-13);
  }
}
