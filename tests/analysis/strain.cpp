#include "analysis/strain.h"

#include <doctest/doctest.h>

#include "analysis/field.h"
#include "sym3/rotation.h"

using namespace viete;
using analysis::Field;
using mesh::Point;

namespace {

// Returns a bumpy sheet far from the origin. One triangle has no area.
mesh::Surface sheet() {
  mesh::Surface surface;
  constexpr std::uint32_t n = 12;
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j)
      surface.positions.push_back({100 + 0.3 * i, 50 + 0.2 * j, 0.1 * std::sin(double(i * j))});
  for (std::uint32_t i = 0; i + 1 < n; ++i)
    for (std::uint32_t j = 0; j + 1 < n; ++j) {
      const std::uint32_t a = i * n + j;
      surface.triangles.push_back({a, a + n, a + 1});
      surface.triangles.push_back({a + n, a + n + 1, a + 1});
    }
  surface.triangles.push_back({0, 1, 0});
  return surface;
}

std::vector<Point> moved(const mesh::Surface& surface, const std::function<Point(const Point&)>& by) {
  std::vector<Point> positions;
  for (const Point& p : surface.positions) positions.push_back(by(p));
  return positions;
}

analysis::FieldValues measured(Field field, const mesh::Surface& rest, const std::vector<Point>& drawn,
                               int threads = 1) {
  const analysis::Strain strain(rest);
  base::WorkerPool pool(threads);
  analysis::FieldInput input{};
  input.strain = &strain;
  input.drawn = drawn;
  input.pool = &pool;
  return analysis::measure(field, input);
}

void check_all(Field field, const mesh::Surface& rest, const std::vector<Point>& drawn, double expected) {
  INFO(choices(field)[std::size_t(field)].word);
  for (const float value : measured(field, rest, drawn).values)
    CHECK(double(value) == doctest::Approx(expected).epsilon(2e-6));
}

}  // namespace

TEST_CASE("rigid_motion_has_rotation_without_stretch") {
  const mesh::Surface rest = sheet();
  for (const double degrees : {0.0, 30.0, 170.0}) {
    const auto turn = sym3::exp_rotation<double>(
        {0, degrees / 180 * std::acos(-1.0) * 0.6, degrees / 180 * std::acos(-1.0) * 0.8});
    const auto drawn = moved(rest, [&](const Point& p) {
      Point q{1, -2, 3};
      for (std::size_t k = 0; k < 3; ++k)
        for (std::size_t l = 0; l < 3; ++l) q[k] += turn[3 * k + l] * p[l];
      return q;
    });
    for (const float value : measured(Field::turn, rest, drawn).values)
      CHECK(std::abs(double(value) - degrees) < 1e-5);
    for (const Field field : {Field::area, Field::larger_stretch, Field::smaller_stretch, Field::shear})
      for (const float value : measured(field, rest, drawn).values) CHECK(std::abs(value) < 1e-9);
    CHECK(measured(Field::energy, rest, drawn).stats.most == -6);
  }
}

TEST_CASE("a_stretch_of_a_plane_is_measured_exactly") {
  mesh::Surface rest = sheet();
  for (Point& p : rest.positions) p[2] = 0;
  const double a = 1.7, b = 0.6;
  // Stretches along oblique axes, and rotates the sheet out of its plane.
  const double c = std::cos(0.4), s = std::sin(0.4);
  const auto drawn = moved(rest, [&](const Point& p) {
    const double u = a * (c * p[0] + s * p[1]), v = b * (c * p[1] - s * p[0]);
    return Point{u, 0, v};
  });
  check_all(Field::area, rest, drawn, std::log2(a * b));
  check_all(Field::larger_stretch, rest, drawn, std::log2(a));
  check_all(Field::smaller_stretch, rest, drawn, std::log2(b));
  check_all(Field::shear, rest, drawn, std::log2(a / b));
  check_all(Field::energy, rest, drawn, std::log10(a * a + b * b + 1 / (a * a) + 1 / (b * b) - 4));
}

TEST_CASE("collapsed_triangles_have_the_worst_finite_value") {
  const mesh::Surface rest = sheet();
  auto drawn = rest.positions;
  for (const std::size_t v : {13, 14, 25, 26}) drawn[v] = rest.positions[13];
  for (const Field field : {Field::area, Field::smaller_stretch, Field::shear, Field::energy, Field::turn}) {
    const auto values = measured(field, rest, drawn);
    for (const float value : values.values) CHECK(std::isfinite(value));
  }
  const auto area = measured(Field::area, rest, drawn);
  CHECK(area.stats.least < -2);
  CHECK(double(area.values[area.stats.worst]) == area.stats.least);
}

TEST_CASE("differences_are_from_the_first_view_and_signed_along_its_normals") {
  const mesh::Surface rest = sheet();
  const auto first = moved(rest, [](const Point& p) { return Point{p[0], p[1], 0}; });
  const auto drawn = moved(rest, [](const Point& p) { return Point{p[0] + 0.1, p[1], -0.2}; });
  const analysis::Strain strain(rest);
  base::WorkerPool pool(2);
  analysis::FieldInput input{};
  input.strain = &strain;
  input.first = first;
  input.drawn = drawn;
  input.pool = &pool;
  const auto along = analysis::measure(Field::signed_difference, input);
  for (const float value : along.values)
    CHECK(double(value) * strain.diagonal() == doctest::Approx(-0.2).epsilon(1e-6));
  CHECK(along.stats.low == -along.stats.high);
  for (const float value : analysis::measure(Field::difference, input).values)
    CHECK(std::pow(10, double(value)) * strain.diagonal() ==
          doctest::Approx(std::hypot(0.1, 0.2)).epsilon(1e-5));
}

TEST_CASE("displacements_are_in_diagonals_and_values_do_not_depend_on_threads") {
  const mesh::Surface rest = sheet();
  const double diagonal = mesh::bounds(rest.positions).diagonal();
  check_all(Field::displacement, rest,
            moved(rest,
                  [](const Point& p) {
                    return p + Point{0, 3, 4};
                  }),
            5 / diagonal);
  const auto bent = moved(rest, [](const Point& p) { return Point{p[0], p[1] * p[1] / 50, std::sin(p[0])}; });
  for (const Field field : {Field::area, Field::shear, Field::turn, Field::energy})
    CHECK(measured(field, rest, bent, 1).values == measured(field, rest, bent, 3).values);
}
