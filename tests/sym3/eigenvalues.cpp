#include <limits>

#include "sym3/arranged.h"
#include "sym3/eigen.h"
#include "sym3/eigenvalues.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

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

namespace {

/// Returns the largest error, relative to the largest absolute eigenvalue.
template <class T>
double worst_error(std::array<T, 3> (*method)(const Sym3<T>&), const std::vector<Sym3<T>>& matrices) {
  double worst = 0;
  for (const auto& s : matrices) {
    auto exact = quad_eigen(to_quad(s)).values;
    std::sort(exact.begin(), exact.end());
    const Quad size = std::max(fabsq(exact[0]), fabsq(exact[2]));
    const auto computed = method(s);
    for (int k = 0; k < 3; ++k) {
      const double error = static_cast<double>(fabsq(computed[k] - exact[k]) / size);
      worst = std::max(worst, std::isnan(error) ? INFINITY : error);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE_TEMPLATE("qr_errs_by_24_u_of_the_largest", T, double, float) {
  for (const auto& m : all_gaps<T>()) CHECK(worst_error(sym3::eigenvalues_qr<T>, m) <= 24 * unit_roundoff<T>);
}

TEST_CASE_TEMPLATE("eigenvalues_err_by_8_u_of_the_largest_however_close", T, double, float) {
  for (const auto& m : all_gaps<T>()) CHECK(worst_error(sym3::eigenvalues<T>, m) <= 8 * unit_roundoff<T>);
  for (const double size : {1e-35, 1e-12, 1e12, 1e35})
    for (const double gap : {0.0, 1e-12, 1e-3, 1.0}) {
      auto m = pairs<T>(gap, 50);
      for (auto& s : m)
        s = {T(s.xx * size), T(s.xy * size), T(s.xz * size), T(s.yy * size), T(s.yz * size), T(s.zz * size)};
      CHECK(worst_error(sym3::eigenvalues<T>, m) <= 8 * unit_roundoff<T>);
    }
}

TEST_CASE_TEMPLATE("every_kernel_and_length_of_a_batch_of_eigenvalues_agrees_with_one", T, double, float) {
  auto in = paper_ensemble<T>(50);
  in[11] = {};
  in[12] = diagonal(T(3), T(-1), std::numeric_limits<T>::max());
  for (const auto& kernel : sym3::kernels()) {
    const auto many = [&](const sym3::SymView<const T>& from, const sym3::VecView<T>& to, std::size_t count) {
      sym3::eigenvalues(from, to, count, {&kernel});
    };
    std::vector<std::array<T, 3>> expected(in.size());
    for (std::size_t i = 0; i < in.size(); ++i)
      many(sym3::packed(&in[i]), {sym3::Layout::packed, expected[i].data()}, 1);
    check_every_batch<T>(in, expected, many);
  }
}

TEST_CASE_TEMPLATE("viete_errs_by_4_cube_roots_of_u_of_the_largest", T, double, float) {
  for (const auto& m : all_gaps<T>())
    CHECK(worst_error(sym3::eigenvalues_viete<T>, m) <= 4 * std::cbrt(unit_roundoff<T>));
}

TEST_CASE("viete_is_nearly_exact_where_eigenvalues_are_apart") {
  Random random(41);
  std::vector<Sym3<double>> apart;
  for (int i = 0; i < 1000; ++i) apart.push_back(with_eigenvalues<double>({1, 2, 3}, random));
  CHECK(worst_error(sym3::eigenvalues_viete<double>, apart) <= 100 * 0x1p-53);
}

TEST_CASE_TEMPLATE("eigenvalues_ascend", T, double, float) {
  for (const auto& s : paper_ensemble<T>(500)) {
    for (std::array<T, 3> (*const method)(const Sym3<T>&) :
         {sym3::eigenvalues_qr<T>, sym3::eigenvalues_viete<T>, sym3::eigenvalues<T>}) {
      const auto values = method(s);
      CHECK(std::is_sorted(values.begin(), values.end()));
    }
  }
}

TEST_CASE_TEMPLATE("a_triple_eigenvalue_is_found", T, double, float) {
  CHECK(sym3::eigenvalues_viete(diagonal(T(2), T(2), T(2))) == std::array<T, 3>{2, 2, 2});
  CHECK(sym3::eigenvalues_viete(Sym3<T>{}) == std::array<T, 3>{0, 0, 0});
  CHECK(sym3::eigenvalues_qr(Sym3<T>{}) == std::array<T, 3>{0, 0, 0});
  CHECK(sym3::eigenvalues(Sym3<T>{}) == std::array<T, 3>{0, 0, 0});
}
