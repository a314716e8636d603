#include "sym3/polar.h"

#include <limits>

#include "sym3/arranged.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"
#include "sym3/with_condition.h"

using sym3::Mat3;

namespace {

/// `rotation` comes from the eigenvectors of M^T M in 113 bits. `condition` is 1 + s1 / (s2 + s3), see
/// polar.h.
struct Truth {
  QuadMat rotation{};
  double condition;
};

Truth quad_polar(const QuadMat& m) {
  const auto e = quad_eigen(gram(m));
  const auto least = std::min_element(e.values.begin(), e.values.end()) - e.values.begin();
  Truth truth;
  Quad top = 0, sum = 0;
  for (int k = 0; k < 3; ++k) {
    const Quad s = sqrtq(e.values[k]) * (k == least && determinant(m) < 0 ? -1 : 1);
    top = std::max(top, s);
    sum += s;
    for (int i = 0; i < 3; ++i) {
      Quad image = 0;
      for (int j = 0; j < 3; ++j) image += m[3 * i + j] * e.vectors[j][k];
      for (int j = 0; j < 3; ++j) truth.rotation[3 * i + j] += image / s * e.vectors[j][k];
    }
  }
  truth.condition = static_cast<double>(1 + top / (sum - top));
  return truth;
}

template <class T>
double error(const Mat3<T>& r, const Truth& truth) {
  Quad sum = 0;
  for (int k = 0; k < 9; ++k) sum += (r[k] - truth.rotation[k]) * (r[k] - truth.rotation[k]);
  return static_cast<double>(sqrtq(sum)) / unit_roundoff<T>;
}

template <class T>
Mat3<T> polar_with(const sym3::Kernel& kernel, const Mat3<T>& m) {
  Mat3<T> r;
  sym3::polar(sym3::MatView<const T>(sym3::Layout::packed, m.data()),
              sym3::MatView<T>(sym3::Layout::packed, r.data()), 1, {&kernel});
  return r;
}

}  // namespace

TEST_CASE_TEMPLATE("polar_keeps_its_bound_for_either_sign_of_the_determinant", T, double, float) {
  Random random(81);
  const std::array<double, 3> shapes[] = {
      {1, 1, 1},    {2, 1, .5},   {1.5, 1.2, .7}, {10, 1, 1},      {3, 1, .1},  {4, .5, .5},
      {1, .1, .05}, {100, 1, 1},  {1, .9, .9},    {1, 1e-3, 1e-3}, {1, 1, -.5}, {1, .9, -.8},
      {1, .5, -.1}, {1, .5, -.4}, {1, .3, -.29},  {7, 6.9, -1e-3}, {1, 1, 1e-3}};
  for (const auto& shape : shapes)
    for (int i = 0; i < 30; ++i) {
      const double size = i % 3 ? 1 : std::pow(10.0, uniform(random, -3, 3));
      const auto m = with_singular_values<T>({size * shape[0], size * shape[1], size * shape[2]}, random);
      const Truth truth = quad_polar(to_quad(m));
      for (const auto& kernel : sym3::kernels()) {
        CAPTURE(kernel.name);
        CAPTURE(shape[0]);
        CAPTURE(shape[1]);
        CAPTURE(shape[2]);
        CHECK(error(polar_with(kernel, m), truth) <= 8 * truth.condition);
      }
    }
}

TEST_CASE_TEMPLATE("polar_keeps_its_bound_on_random_matrices", T, double, float) {
  for (const auto& m : random_matrices<T>(2000, 82)) {
    const Truth truth = quad_polar(to_quad(m));
    CHECK(error(sym3::polar(m).rotation, truth) <= 8 * truth.condition);
  }
}

TEST_CASE_TEMPLATE("stretch_is_symmetric_and_multiplies_back", T, double, float) {
  for (const auto& m : random_matrices<T>(300, 83)) {
    const auto [r, u] = sym3::polar(m);
    const T s[9] = {u.xx, u.xy, u.xz, u.xy, u.yy, u.yz, u.xz, u.yz, u.zz};
    for (int k = 0; k < 9; ++k) {
      const T* row = &r[k / 3 * 3];
      const T product = row[0] * s[k % 3] + row[1] * s[3 + k % 3] + row[2] * s[6 + k % 3];
      CHECK(std::fabs(product - m[k]) <= 1000 * unit_roundoff<T>);
    }
  }
}

TEST_CASE_TEMPLATE("singular_matrices_still_have_a_rotation", T, double, float) {
  const Mat3<T> identity = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  CHECK(sym3::polar(Mat3<T>{}).rotation == identity);
  CHECK(sym3::polar(Mat3<T>{}).stretch == sym3::Sym3<T>{});
  for (const auto& m : {Mat3<T>{1, 0, 0, 0, 0, 0, 0, 0, 0}, Mat3<T>{1, 2, 3, 2, 4, 6, -1, -2, -3},
                        Mat3<T>{-1, 0, 0, 0, -1, 0, 0, 0, -1}, Mat3<T>{0, 0, 0, 1, 1, 0, 0, 0, 0}}) {
    const auto r = sym3::polar(m).rotation;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const T dot = r[i] * r[j] + r[3 + i] * r[3 + j] + r[6 + i] * r[6 + j];
        CHECK(std::fabs(dot - (i == j)) <= 16 * unit_roundoff<T>);
      }
    CHECK(determinant(r) > 0.99);
  }
}

TEST_CASE_TEMPLATE("polar_takes_entries_of_any_size", T, double, float) {
  const T big = std::numeric_limits<T>::max(), small = std::numeric_limits<T>::denorm_min();
  const Mat3<T> turn = {0, -1, 0, 1, 0, 0, 0, 0, 1};
  for (const T size : {big, small}) {
    Mat3<T> m = turn;
    for (T& x : m) x *= size;
    CHECK(sym3::polar(m).rotation == turn);
  }
}

TEST_CASE_TEMPLATE("every_length_of_a_batch_of_polars_gives_the_bits_of_one", T, double, float) {
  auto in = random_matrices<T>(60, 84);
  in[20] = {};
  for (const auto& kernel : sym3::kernels()) {
    std::vector<Mat3<T>> expected;
    for (const auto& m : in) expected.push_back(polar_with(kernel, m));
    check_every_batch<T>(
        in, expected, [&](const sym3::MatView<const T>& from, const sym3::MatView<T>& to, std::size_t count) {
          sym3::polar(from, to, count, {&kernel});
        });
  }
}

TEST_CASE_TEMPLATE("a_batch_of_polars_with_stretches_gives_the_bits_of_one_in_any_layout_and_in_place", T,
                   double, float) {
  auto in = random_matrices<T>(150, 85);
  in[20] = {};
  in[77] = {1, 2, 3, 2, 4, 6, -1, -2, -3};
  for (const auto& kernel : sym3::kernels()) {
    const auto run = [&](std::vector<Mat3<T>>& r, const sym3::SymView<T>& u, std::size_t count) {
      const sym3::MatView<T> both(sym3::Layout::packed, r[0].data());
      sym3::polar(both, both, u, count, {&kernel});
    };
    std::vector<Mat3<T>> rotations;
    std::vector<sym3::Sym3<T>> stretches(in.size());
    for (std::size_t i = 0; i < in.size(); ++i) {
      std::vector<Mat3<T>> r = {in[i]};
      run(r, sym3::packed(&stretches[i]), 1);
      rotations.push_back(r[0]);
      CHECK(r[0] == polar_with(kernel, in[i]));
      if (&kernel == &sym3::kernel()) CHECK(stretches[i] == sym3::polar(in[i]).stretch);
    }
    check_every_batch<T>(in, stretches, [&](const auto&, const sym3::SymView<T>& to, std::size_t count) {
      std::vector<Mat3<T>> r = in;
      run(r, to, count);
      for (std::size_t i = 0; i < in.size(); ++i) CHECK(r[i] == (i < count ? rotations[i] : in[i]));
    });
  }
}

TEST_CASE_TEMPLATE("entries_near_the_largest_number_overflow_no_intermediate_step", T, double, float) {
  const T x = std::numeric_limits<T>::max() / T(1.06), small = std::exp2(T(-12));
  for (const auto& kernel : sym3::kernels()) {
    for (const Mat3<T>& m :
         {Mat3<T>{x, x, x, x, x, x, x, x, x}, Mat3<T>{x, -x, 0, x, x, 0, 0, 0, x},
          Mat3<T>{x, x, -x, x, -x, x, -x, x, x}, Mat3<T>{x, x / 2, 0, -x / 3, x / 4, x / 7, 0, x / 5, -x}}) {
      const auto of = [&](Mat3<T> in) {
        sym3::Polar<T> p;
        sym3::polar(sym3::MatView<const T>(sym3::Layout::packed, in.data()),
                    sym3::MatView<T>(sym3::Layout::packed, p.rotation.data()), sym3::packed(&p.stretch), 1,
                    {&kernel});
        return p;
      };
      Mat3<T> less = m;
      for (T& entry : less) entry *= small;
      const auto p = of(m), q = of(less);
      CHECK(p.rotation == q.rotation);
      for (int k = 0; k < 6; ++k) CHECK((&p.stretch.xx)[k] == (&q.stretch.xx)[k] / small);
    }
  }
  CHECK(sym3::polar(Mat3<T>{x, x, x, x, x, x, x, x, x}).stretch.xx == doctest::Approx(x));
}

TEST_CASE_TEMPLATE("subnormal_matrices_have_their_rotation_and_stretch", T, double, float) {
  const T x = std::numeric_limits<T>::denorm_min() * 1000;
  const auto p = sym3::polar(Mat3<T>{x, -x, 0, x, x, 0, 0, 0, x});
  CHECK(p.rotation[0] == doctest::Approx(std::sqrt(0.5)).epsilon(1e-6));
  CHECK(p.stretch.xx / x == doctest::Approx(std::sqrt(2.0)).epsilon(1e-3));
  CHECK(p.stretch.zz == x);
}
