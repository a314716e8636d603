#include "sym3/decomposition.h"

#include <bit>
#include <limits>

#include "sym3/arranged.h"
#include "sym3/eigenvalues.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"
#include "sym3/with_condition.h"

using sym3::Eigensystem;
using sym3::Mat3;
using sym3::SingularSystem;
using sym3::Vec3;

namespace {

QuadMat transposed(const QuadMat& m) {
  return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
}

template <class T>
QuadMat scaled_columns(const Mat3<T>& m, const Vec3<T>& by) {
  QuadMat scaled = to_quad(m);
  for (std::size_t i = 0; i < 9; ++i) scaled[i] *= by[i % 3];
  return scaled;
}

/// Returns |R^T R - I| in u, or infinity if R mirrors.
template <class T>
double rotation_error(const Mat3<T>& r) {
  const QuadMat q = to_quad(r);
  if (!(determinant(q) > 0)) return INFINITY;
  return static_cast<double>(quad_norm(quad_combined(quad_product(transposed(q), q), quad_identity, 1, -1))) /
         unit_roundoff<T>;
}

/// Returns |A diag(values) B^T - M| / |M| in u.
template <class T>
double product_error(const Mat3<T>& a, const Vec3<T>& values, const Mat3<T>& b, const QuadMat& m) {
  const QuadMat product = quad_product(scaled_columns(a, values), transposed(to_quad(b)));
  return static_cast<double>(quad_norm(quad_combined(product, m, 1, -1)) / quad_norm(m)) / unit_roundoff<T>;
}

template <class T>
QuadMat nine_entries(const Sym3<T>& s) {
  return {s.xx, s.xy, s.xz, s.xy, s.yy, s.yz, s.xz, s.yz, s.zz};
}

template <class T>
bool has_positive_largest(const Mat3<T>& m, std::size_t column) {
  Vec3<T> c = {m[column], m[3 + column], m[6 + column]};
  return *std::ranges::max_element(c, {}, [](T x) { return std::fabs(x); }) > 0;
}

template <class T>
Eigensystem<T> eigh_with(const sym3::Kernel& kernel, const Sym3<T>& s) {
  Eigensystem<T> e;
  sym3::eigh(sym3::packed(&s), {sym3::Layout::packed, e.values.data()},
             {sym3::Layout::packed, e.vectors.data()}, 1, {&kernel});
  return e;
}

template <class T>
SingularSystem<T> svd_with(const sym3::Kernel& kernel, const Mat3<T>& m) {
  SingularSystem<T> s;
  sym3::svd({sym3::Layout::packed, m.data()}, {sym3::Layout::packed, s.u.data()},
            {sym3::Layout::packed, s.values.data()}, {sym3::Layout::packed, s.v.data()}, 1, {&kernel});
  return s;
}

template <class T>
void check_eigh(const Sym3<T>& s) {
  for (const auto& kernel : sym3::kernels()) {
    const Eigensystem<T> e = eigh_with(kernel, s);
    CAPTURE(kernel.name);
    CHECK(rotation_error(e.vectors) <= 20);
    CHECK(product_error(e.vectors, e.values, e.vectors, nine_entries(s)) <= 24);
    CHECK(std::ranges::is_sorted(e.values));
    CHECK(has_positive_largest(e.vectors, 1));
    CHECK(has_positive_largest(e.vectors, 2));
  }
}

/// Returns a product B D: random columns of length about 1, multiplied by the numbers of `lengths`.
template <class T>
Mat3<T> with_columns(const std::array<double, 3>& lengths, Random& random) {
  const auto a = random_rotation(random);
  Mat3<T> m;
  for (std::size_t i = 0; i < 9; ++i) m[i] = T((a[i / 3][i % 3] + uniform(random, -.2, .2)) * lengths[i % 3]);
  return m;
}

/// Returns the singular values in descending order, with 113 bits; the last value has the sign of det M.
std::array<Quad, 3> quad_singular_values(const QuadMat& m) {
  auto s = quad_eigen(gram(m)).values;
  std::ranges::sort(s, std::greater());
  for (Quad& x : s) x = sqrtq(std::max<Quad>(x, 0));
  if (determinant(m) < 0) s[2] = -s[2];
  return s;
}

template <class T>
void check_svd(const Mat3<T>& m) {
  for (const auto& kernel : sym3::kernels()) {
    const SingularSystem<T> s = svd_with(kernel, m);
    CAPTURE(kernel.name);
    CHECK(rotation_error(s.u) <= 24);
    CHECK(rotation_error(s.v) <= 24);
    CHECK(product_error(s.u, s.values, s.v, to_quad(m)) <= 16);
    CHECK(s.values[0] >= s.values[1]);
    CHECK(s.values[1] >= std::fabs(s.values[2]));
    CHECK(has_positive_largest(s.v, 0));
    CHECK(has_positive_largest(s.v, 1));
  }
}

/// Returns the largest relative error of the singular values, in u.
template <class T>
double relative_error(const Vec3<T>& values, const QuadMat& m) {
  const auto exact = quad_singular_values(m);
  double worst = 0;
  for (std::size_t k = 0; k < 3; ++k)
    worst = std::max(worst, static_cast<double>(fabsq(values[k] - exact[k]) / fabsq(exact[k])));
  return worst / unit_roundoff<T>;
}

}  // namespace

TEST_CASE_TEMPLATE("eigh_multiplies_back_and_is_a_rotation_at_every_gap", T, double, float) {
  for (const auto& set : all_gaps<T>())
    for (const auto& s : set) check_eigh(s);
}

TEST_CASE_TEMPLATE("eigenvalues_of_eigh_are_the_bits_of_eigenvalues", T, double, float) {
  for (const auto& s : paper_ensemble<T>(500)) CHECK(sym3::eigh(s).values == sym3::eigenvalues(s));
  const Sym3<T> huge = diagonal<T>(1, 2, std::numeric_limits<T>::max());
  CHECK(sym3::eigh(huge).values == sym3::eigenvalues(huge));
}

TEST_CASE_TEMPLATE("eigh_takes_any_size_and_rank", T, double, float) {
  Random random(91);
  for (const double size : {1e-150, 1e-35, 1e-12, 1.0, 1e12, 1e35, 1e150})
    for (const auto& values :
         {std::array{1.0, 0.0, 0.0}, std::array{1.0, 1.0, 0.0}, std::array{-1.0, 0.0, 0.0},
          std::array{1.0, -1.0, 1e-9}, std::array{3.0, 2.0, 1.0}}) {
      if (sizeof(T) == 4 && (size > 1e36 || size < 1e-36)) continue;
      for (int i = 0; i < 20; ++i)
        check_eigh(with_eigenvalues<T>({size * values[0], size * values[1], size * values[2]}, random));
    }
  for (int i = 0; i < 200; ++i) {
    const T x = T(uniform(random, -1, 1)), y = T(uniform(random, -1, 1)), z = T(uniform(random, -1, 1));
    check_eigh(Sym3<T>{x * x, x * y, x * z, y * y, y * z, z * z});
    check_eigh(diagonal(x, y, i % 2 ? z : x));
  }
}

TEST_CASE("eigenvectors_are_those_of_113_bits_within_u_times_size_over_gap") {
  Random random(92);
  for (const double gap : {1.0, 1e-2, 1e-5, 1e-8})
    for (int i = 0; i < 100; ++i) {
      const auto s = with_eigenvalues<double>({1, 1 + gap, 3}, random);
      const auto exact = quad_eigen(to_quad(s));
      const auto e = sym3::eigh(s);
      for (std::size_t k = 0; k < 3; ++k) {
        const auto nearest = std::ranges::min_element(
            exact.values, {}, [&](Quad x) { return static_cast<double>(fabsq(x - e.values[k])); });
        const std::size_t n = nearest - exact.values.begin();
        Quad cosine = 0;
        for (std::size_t j = 0; j < 3; ++j) cosine += exact.vectors[j][n] * e.vectors[3 * j + k];
        Quad sine2 = 0;
        for (std::size_t j = 0; j < 3; ++j) {
          const Quad x = e.vectors[3 * j + k] - cosine * exact.vectors[j][n];
          sine2 += x * x;
        }
        CHECK(static_cast<double>(sqrtq(sine2)) <= 24 * 0x1p-53 * (1 + 3 / gap));
      }
    }
}

TEST_CASE_TEMPLATE("zero_gives_identities", T, double, float) {
  const Mat3<T> identity = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  for (const auto& kernel : sym3::kernels()) {
    CHECK(eigh_with(kernel, Sym3<T>{}).vectors == identity);
    CHECK(eigh_with(kernel, Sym3<T>{}).values == Vec3<T>{});
    const auto s = svd_with(kernel, Mat3<T>{});
    CHECK(s.u == identity);
    CHECK(s.v == identity);
    CHECK(s.values == Vec3<T>{});
  }
}

TEST_CASE_TEMPLATE("svd_multiplies_back_with_rotations_of_any_shape", T, double, float) {
  Random random(93);
  const std::array<double, 3> shapes[] = {{1, 1, 1},       {2, 1, .5},       {1, 1, 1e-3},  {1, 1e-3, 1e-3},
                                          {1, 1e-3, 1e-7}, {1, 1e-7, 1e-7},  {1, 1, -1},    {1, .5, -1e-6},
                                          {1, 1e-9, 1e-9}, {1, 1, 1 - 1e-9}, {5, 5, 4.999}, {1, 0, 0},
                                          {1, 1, 0}};
  for (const double size : {1e-150, 1e-30, 1e-3, 1.0, 1e3, 1e30, 1e150})
    for (const auto& shape : shapes) {
      if (sizeof(T) == 4 && (size > 1e36 || size < 1e-36)) continue;
      for (int i = 0; i < 20; ++i)
        check_svd(with_singular_values<T>({size * shape[0], size * shape[1], size * shape[2]}, random));
    }
  for (const auto& m : random_matrices<T>(3000, 93)) check_svd(m);
}

TEST_CASE_TEMPLATE("singular_values_of_stretched_columns_are_accurate_relative_to_themselves", T, double,
                   float) {
  Random random(94);
  const double far = sizeof(T) == 8 ? 1e-100 : 1e-20;
  const std::array<double, 3> lengths[] = {{1, 1, 1},    {1, 1e-3, 1e-7}, {1e-7, 1, 1e-3}, {1e-7, 1e-7, 1},
                                           {1, 1, 1e-7}, {1, far, 1},     {far, 1, 1e-7},  {1, far, far}};
  for (const auto& three : lengths)
    for (int i = 0; i < 100; ++i) {
      const auto m = with_columns<T>(three, random);
      for (const auto& kernel : sym3::kernels())
        CHECK(relative_error(svd_with(kernel, m).values, to_quad(m)) <= 16);
      check_svd(m);
    }
}

TEST_CASE_TEMPLATE("svd_takes_entries_near_the_ends_of_the_range", T, double, float) {
  const T most = std::numeric_limits<T>::max(), least = std::numeric_limits<T>::denorm_min();
  for (const auto& kernel : sym3::kernels()) {
    CHECK(svd_with(kernel, Mat3<T>{0, most, 0, -most, 0, 0, 0, 0, most / 2}).values ==
          Vec3<T>{most, most, most / 2});
    CHECK(svd_with(kernel, Mat3<T>{0, least, 0, least, 0, 0, 0, 0, 1}).values == Vec3<T>{1, least, -least});
    const auto e = eigh_with(kernel, diagonal<T>(most, -most, least));
    CHECK(e.values[0] == doctest::Approx(-most));
    CHECK(rotation_error(e.vectors) <= 20);
  }
}

TEST_CASE_TEMPLATE("every_kernel_and_length_of_a_batch_of_decompositions_agrees_with_one", T, double, float) {
  auto in = paper_ensemble<T>(60);
  in[11] = {};
  in[12] = diagonal(T(3), T(-1), std::numeric_limits<T>::max());
  auto general = random_matrices<T>(60, 95);
  general[7] = {1, 2, 3, 2, 4, 6, -1, -2, -3};
  general[20] = {};
  for (const auto& kernel : sym3::kernels()) {
    std::vector<Mat3<T>> vectors, u, v;
    for (const auto& s : in) vectors.push_back(eigh_with(kernel, s).vectors);
    for (const auto& m : general) {
      u.push_back(svd_with(kernel, m).u);
      v.push_back(svd_with(kernel, m).v);
    }
    for (const auto side : {sym3::Layout::planes, sym3::Layout::packed}) {
      Arranged<T, Vec3<T>> values(side, in.size());
      Arranged<T, Mat3<T>> other(side, in.size());
      check_every_batch<T>(in, vectors, [&](const auto& from, const sym3::MatView<T>& to, std::size_t count) {
        sym3::eigh(from, values.view(), to, count, {&kernel});
        for (std::size_t i = 0; i < count; ++i) CHECK(values.get(i) == eigh_with(kernel, in[i]).values);
      });
      check_every_batch<T>(general, u, [&](const auto& from, const sym3::MatView<T>& to, std::size_t count) {
        sym3::svd(from, to, values.view(), other.view(), count, {&kernel});
        for (std::size_t i = 0; i < count; ++i)
          CHECK((other.get(i) == v[i] && values.get(i) == svd_with(kernel, general[i]).values));
      });
    }
  }
}
