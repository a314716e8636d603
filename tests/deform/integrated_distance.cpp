#include "deform/integrated_distance.h"

#include <doctest/doctest.h>

#include <numeric>

#include "deform/bound.h"
#include "deform/shapes.h"
#include "deform/weight_checks.h"

using namespace viete::test;

namespace {

using Corners = std::array<Vec3, 3>;

Corners random_triangle(Random& random) {
  while (true) {
    const Corners t = {random.vector(1), random.vector(1), random.vector(1)};
    const Vec3 a = t[1] - t[0], b = t[2] - t[0], c = t[2] - t[1];
    const double longest = std::max({norm(a), norm(b), norm(c)});
    if (norm(cross(a, b)) > 0.05 * longest * longest) return t;
  }
}

Vec3 unit_normal(const Corners& t) {
  const Vec3 n = cross(t[1] - t[0], t[2] - t[0]);
  return (1 / norm(n)) * n;
}

// At a, b in the directions of the edges from the first corner, h above.
Vec3 point_at(const Corners& t, double a, double b, double h) {
  return t[0] + a * (t[1] - t[0]) + b * (t[2] - t[0]) + h * unit_normal(t);
}

Corners seen_from(const Vec3& x, const Corners& t) {
  return {t[0] - x, t[1] - x, t[2] - x};
}

double integral(const Corners& t, const Vec3& x, double soft = 1e-8) {
  return inverse_fourth_power_integral(t, x, soft);
}

// Gauss's points of degree 19 in both directions of the triangle, as a square with one side drawn together;
// triangles that are large for their distance are cut into four.
double quadrature(const Corners& t) {
  static constexpr double at[] = {0.1488743389816312, 0.4333953941292472, 0.6794095682990244,
                                  0.8650633666889845, 0.9739065285171717};
  static constexpr double weight[] = {0.2955242247147529, 0.2692667193099963, 0.2190863625159821,
                                      0.1494513491505806, 0.0666713443086881};
  const Vec3 u = t[1] - t[0], v = t[2] - t[1], ab = 0.5 * (t[0] + t[1]), bc = 0.5 * (t[1] + t[2]),
             ca = 0.5 * (t[2] + t[0]);
  const double size = std::max({norm(u), norm(v), norm(t[2] - t[0])});
  if (size > 0.5 * norm((1.0 / 3) * (t[0] + t[1] + t[2]))) {
    return quadrature({t[0], ab, ca}) + quadrature({ab, t[1], bc}) + quadrature({ca, bc, t[2]}) +
           quadrature({bc, ca, ab});
  }
  double sum = 0;
  for (int i = 0; i < 10; ++i) {
    const double r = 0.5 + (i % 2 ? 0.5 : -0.5) * at[i / 2];
    for (int j = 0; j < 10; ++j) {
      const double s = 0.5 + (j % 2 ? 0.5 : -0.5) * at[j / 2],
                   d2 = viete::mesh::squared_norm(t[0] + r * u + r * s * v);
      sum += weight[i / 2] * weight[j / 2] / 4 * r / (d2 * d2);
    }
  }
  return norm(cross(u, v)) * sum;
}

std::vector<double> integrated_at(const Cage& cage, const Vec3& p) {
  std::vector<double> w(cage.element_count());
  integrated_weights(cage, p, w);
  return w;
}

double total(const std::vector<double>& w) {
  return std::accumulate(w.begin(), w.end(), 0.0);
}

// Its first face cut into three at a point, and one of these once more.
viete::mesh::Surface with_a_cut_face(const viete::mesh::Surface& surface) {
  auto p = surface.positions;
  auto t = surface.triangles;
  const auto [a, b, c] = t[0];
  const auto inner = static_cast<std::uint32_t>(p.size());
  p.push_back(0.2 * p[a] + 0.5 * p[b] + 0.3 * p[c]);
  p.push_back(0.3 * p[a] + 0.5 * p[inner] + 0.2 * p[b]);
  t[0] = {b, c, inner};
  t.push_back({c, a, inner});
  t.push_back({a, b, inner + 1});
  t.push_back({b, inner, inner + 1});
  t.push_back({inner, a, inner + 1});
  return viete::mesh::from_triangles(p, t);
}

}  // namespace

TEST_CASE("integrals_over_triangles_are_those_of_quadrature") {
  Random random(1);
  double worst = 0;
  for (int n = 0; n < 1500; ++n) {
    const Corners t = random_triangle(random);
    const double h = n % 3 == 0 ? 0 : std::pow(10, random(-9, 1));
    const double far = n % 5 == 0 ? std::pow(10, random(0, 3)) : 1;
    const Vec3 in_plane[] = {{random(-1, 2), random(-1, 2), 0},  // anywhere
                             {random(1, 3), 0, 0},               // in line with an edge
                             {random(-1, 0), 0, 0},
                             {random(0, 1), 0, 0}};  // above an edge
    const Vec3 f = in_plane[n % 4];
    const bool above = f[0] >= 0 && f[1] >= 0 && f[0] + f[1] <= 1;
    const Vec3 x = far * point_at(t, f[0], f[1], above ? std::max(h, 0.05) : h);
    const Corners c = seen_from(x, t);
    double nearest = 1e300;
    for (const auto& corner : c) nearest = std::min(nearest, norm(corner));
    if (nearest < 0.01 || (far == 1 && n % 4 == 0 && h < 0.01)) continue;
    const double expected = quadrature(c);
    worst = std::max(worst, std::abs(integral(t, x, 1e-10) / expected - 1));
  }
  CHECK(worst < 2e-12);
}

TEST_CASE("integrals_of_pieces_add_up_to_that_of_the_whole") {
  Random random(2);
  double worst = 0;
  for (int n = 0; n < 2000; ++n) {
    const Corners t = random_triangle(random);
    const double a = random(0.1, 0.8), b = random(0.1, 0.9 - a),
                 h = n % 3 == 0 ? 0 : std::pow(10, random(-6, 1));
    const Vec3 inner = point_at(t, a, b, 0), x = point_at(t, random(-2, -0.1), random(-1, 2), h);
    const double whole = integral(t, x);
    const double parts = integral({t[0], t[1], inner}, x) + integral({t[1], t[2], inner}, x) +
                         integral({t[2], t[0], inner}, x);
    worst = std::max(worst, std::abs(parts / whole - 1));
  }
  CHECK(worst < 1e-13);
}

TEST_CASE("integrals_have_the_limits_of_faces_edges_corners_and_of_far_triangles") {
  const Corners t = {Vec3{0, 0, 0}, Vec3{3, 0, 0}, Vec3{0, 4, 0}};
  const double pi = std::numbers::pi, d = 1e-5;
  CHECK(integral(t, {1, 1, d}) * d * d == doctest::Approx(pi).epsilon(1e-5));
  CHECK(integral(t, {1, 1, -d}) * d * d == doctest::Approx(pi).epsilon(1e-5));
  CHECK(integral(t, {1, 0, d}) * d * d == doctest::Approx(pi / 2).epsilon(1e-4));
  CHECK(integral(t, {0, 0, d}) * d * d == doctest::Approx(pi / 4).epsilon(1e-4));
  CHECK(integral(t, {1, -d, 0}) * d * d ==
        doctest::Approx(pi / 4).epsilon(1e-4));  // a half-plane, in the plane
  for (const Vec3& direction : {Vec3{0, 0, 1}, Vec3{1, 0, 0}, Vec3{0.6, 0, 0.8}, Vec3{0.6, 0.8, 1e-9}}) {
    const double far = 1e9;
    CHECK(integral(t, far * direction) * std::pow(far, 4) == doctest::Approx(6).epsilon(1e-7));
  }
}

TEST_CASE("integrals_do_not_jump_where_the_formula_changes") {
  const Corners t = {Vec3{0, 0, 0}, Vec3{1, 0, 0}, Vec3{0.3, 0.8, 0}};
  for (const auto& [from, to] : {std::pair{Vec3{0.4, -0.5, 0.4}, Vec3{0.4, -0.5, 0}},
                                 {Vec3{-1, 0, 0.3}, Vec3{2, 0, 0.3}},
                                 {Vec3{0.4, 0.3, 0.1}, Vec3{0.4, 0.3, 20}},
                                 {Vec3{0.4, 0.3, 0.1}, Vec3{0.4, -3, 0.1}}}) {
    double jump = 0;
    const auto at = [&, a = from, b = to](double s) { return std::log(integral(t, a + s * (b - a))); };
    for (int i = 0; i < 2000; ++i) {
      const double s = i / 2000.0, step = 1e-9;
      jump = std::max(jump, std::abs(at(s + 2 * step) - 2 * at(s + step) + at(s)));
    }
    CHECK(jump < 1e-12);
  }
}

TEST_CASE("on_a_corner_elements_share_by_their_angles_on_an_edge_equally") {
  const Cage cage = make_cage(box());
  for (std::size_t v = 0; v < 8; ++v) {
    const auto w = integrated_at(cage, cage.surface.positions[v]);
    for (std::size_t e = 0; e < w.size(); ++e) {
      const auto& t = cage.surface.triangles[e];
      double angle = 0;
      for (int i = 0; i < 3; ++i) {
        const auto &a = cage.surface.positions[t[i]], &b = cage.surface.positions[t[(i + 1) % 3]],
                   &c = cage.surface.positions[t[(i + 2) % 3]];
        if (t[i] == v) angle = std::acos(dot(b - a, c - a) / (norm(b - a) * norm(c - a)));
      }
      CHECK(std::abs(w[e] - angle / (1.5 * std::numbers::pi)) < 1e-7);
    }
  }
  const auto w = integrated_at(cage, {0.3, 1, 1});
  CHECK(std::count_if(w.begin(), w.end(), [](double x) { return std::abs(x - 0.5) < 1e-6; }) == 2);
}

TEST_CASE("on_a_face_its_element_has_all_the_weight_and_near_it_nearly") {
  const Cage cage = make_cage(box());
  for (std::size_t e = 0; e < cage.element_count(); ++e)
    CHECK(integrated_at(cage, cage.centers[e])[e] == doctest::Approx(1));
  for (double d = 1e-1; d > 1e-20; d /= 10) {
    const auto w = integrated_at(cage, cage.centers[0] + Vec3{0, 0, d});
    CHECK(w[0] > 1 - 100 * d * d - 1e-14);
    CHECK(total(w) == doctest::Approx(1));
  }
}

TEST_CASE("integrated_weights_are_the_same_at_every_length_scale_and_finite_everywhere") {
  check_every_length_scale([](const Cage& cage, const Vec3& p) { return integrated_at(cage, p); });
  for (const double s : {1e-30, 1.0, 1e30}) {
    const Cage cage = make_cage(box({s, 2 * s, 3 * s}));
    for (double far = 1; far < 1e40; far *= 1e3) {
      const auto w = integrated_at(cage, {s * far, 0, 0.3 * s * far});
      CHECK(total(w) == doctest::Approx(1));
      if (far > 1e7) CHECK(w[0] == doctest::Approx(2.0 / 44).epsilon(1e-6));  // its share of the area
    }
  }
}

TEST_CASE("elements_without_area_have_no_integrated_weight") {
  auto surface = box();
  auto t = surface.triangles;
  t.push_back({0, 1, 1});
  const Cage cage = make_cage(viete::mesh::from_triangles(surface.positions, t));
  CHECK(integrated_at(cage, {0.1, 0.2, 0.3}).back() == 0);
  CHECK(integrated_at(cage, surface.positions[0]).back() == 0);
  CHECK(total(integrated_at(cage, surface.positions[1])) == doctest::Approx(1));
}

TEST_CASE("cutting_a_face_shares_its_weight_and_changes_no_other") {
  const auto plain = box({1, 2, 3});
  const Cage whole = make_cage(plain), cut = make_cage(with_a_cut_face(plain));
  Random random(7);
  for (int n = 0; n < 200; ++n) {
    const Vec3 p = random.vector(4);
    auto a = integrated_at(whole, p), b = integrated_at(cut, p);
    for (std::size_t e = 12; e < 16; ++e) b[0] += b[e];
    for (std::size_t e = 0; e < 12; ++e) CHECK(std::abs(a[e] - b[e]) < 1e-13);
  }
}

TEST_CASE("cutting_a_face_changes_no_deformed_vertex_where_maps_are_averaged") {
  const auto plain = box({1, 2, 3});
  viete::mesh::Surface model;
  Random random(8);
  for (int n = 0; n < 100; ++n) model.positions.push_back(random.vector(4));
  Bound whole(model, plain, face_integrals, 2, Blend::linear);
  Bound cut(model, with_a_cut_face(plain), face_integrals, 2, Blend::linear);
  auto posed = plain;
  for (auto& p : posed.positions) p = similarity({1, 2, 3}, 0.7)(p) + random.vector(0.3);
  const auto a = whole.deform({posed.positions, {}}), b = cut.deform({with_a_cut_face(posed).positions, {}});
  CHECK(largest_distance(a, b) < 1e-12 * whole.cage->diagonal);

  Bound counted(model, with_a_cut_face(plain), faces, 2, Blend::linear),
      once(model, plain, faces, 2, Blend::linear);
  CHECK(largest_distance(counted.deform({with_a_cut_face(posed).positions, {}}),
                         once.deform({posed.positions, {}})) > 1e-3);
}
