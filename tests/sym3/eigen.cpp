#include "sym3/eigen.h"

#include <doctest/doctest.h>

#include "sym3/derivative.h"

using namespace viete;
using sym3::Sym3;

namespace {
const Sym3<double> sample{1, 2, 3, 4, 5, 6};
}

TEST_CASE("eigen_matrix_is_symmetric_and_comes_back") {
  const Eigen::Matrix3d m = sym3::to_eigen(sample);
  CHECK(m == m.transpose());
  CHECK(m(0, 2) == 3);
  CHECK(m(2, 1) == 5);
  CHECK(sym3::from_eigen<double>(m) == sample);
}

TEST_CASE("from_eigen_reads_the_upper_triangle_only") {
  Eigen::Matrix3d m = sym3::to_eigen(sample);
  m(1, 0) = m(2, 0) = m(2, 1) = -100;
  CHECK(sym3::from_eigen<double>(m) == sample);
}

TEST_CASE("voigt_orders_are_those_of_mechanics_and_come_back") {
  const auto stress = sym3::to_voigt_stress(sample), strain = sym3::to_voigt_strain(sample);
  CHECK(stress == (Eigen::Matrix<double, 6, 1>() << 1, 4, 6, 5, 3, 2).finished());
  CHECK(strain == (Eigen::Matrix<double, 6, 1>() << 1, 4, 6, 10, 6, 4).finished());
  CHECK(sym3::from_voigt_stress<double>(stress) == sample);
  CHECK(sym3::from_voigt_strain<double>(strain) == sample);
  CHECK(stress.dot(strain) == doctest::Approx(sym3::to_eigen(sample).squaredNorm()));
}

TEST_CASE("the_voigt_tangent_takes_strains_to_derivatives_of_stresses") {
  const Sym3<double> s{0.1, 0.2, -0.3, 0.4, 0.5, -0.6};
  const auto tangent = sym3::to_voigt_tangent(sym3::exp_tangent(s));
  const auto stress = sym3::to_voigt_stress(sym3::exp_derivative(s, sample));
  CHECK((tangent * sym3::to_voigt_strain(sample) - stress).norm() <= 1e-14 * stress.norm());
  CHECK((tangent - tangent.transpose()).norm() <= 1e-14 * tangent.norm());
}
