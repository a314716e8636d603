// Every function on every combination of zero, infinities, NaN, the smallest and the largest number.
#include <limits>

#include "sym3/arranged.h"
#include "sym3/derivative.h"
#include "sym3/eigenvalues.h"
#include "sym3/general.h"
#include "sym3/log.h"
#include "sym3/polar.h"
#include "sym3/preamble.h"

namespace {

using sym3::Mat3;
using sym3::Vec3;

/// All items whose numbers are combinations of special values, and ordinary items with one bad number. Of
/// combinations with more than six numbers, the later numbers repeat the first ones.
template <class T, class Item>
std::vector<Item> special_items() {
  using Limits = std::numeric_limits<T>;
  const T special[] = {
      0, Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN(), Limits::denorm_min(), Limits::max()};
  constexpr std::size_t numbers = sizeof(Item) / sizeof(T), kinds = std::size(special);
  std::size_t combinations = 1;
  for (std::size_t k = 0; k < std::min<std::size_t>(numbers, 6); ++k) combinations *= kinds;
  std::vector<Item> items;
  for (std::size_t i = 0; i < combinations; ++i) {
    std::array<T, numbers> item;
    for (std::size_t k = 0, rest = i; k < numbers; ++k, rest /= kinds)
      item[k] = k < 6 ? special[rest % kinds] : item[k - 6];
    items.push_back(std::bit_cast<Item>(item));
  }
  for (const T size : {T(1), T(100)})
    for (const T bad : {Limits::infinity(), -Limits::infinity(), Limits::quiet_NaN()})
      for (std::size_t bad_at = 0; bad_at < numbers; ++bad_at) {
        std::array<T, numbers> item;
        for (std::size_t k = 0; k < numbers; ++k) item[k] = size * T(k % 2 ? -double(k) : double(k));
        item[bad_at] = bad;
        items.push_back(std::bit_cast<Item>(item));
      }
  return items;
}

template <class T, class Item>
bool is_finite(const Item& item) {
  const auto numbers = std::bit_cast<std::array<T, sizeof(Item) / sizeof(T)>>(item);
  return std::ranges::all_of(numbers, [](T x) { return std::isfinite(x); });
}

template <class T, class Item>
bool is_all_nan(const Item& item) {
  const auto numbers = std::bit_cast<std::array<T, sizeof(Item) / sizeof(T)>>(item);
  return std::ranges::all_of(numbers, [](T x) { return std::isnan(x); });
}

/// Checks that items that are not finite give only NaN.
template <class T, class In, class One>
void check_one(const char* name, const One& one) {
  std::size_t wrong = 0;
  for (const In& item : special_items<T, In>()) {
    const auto result = one(item);
    if (!is_finite<T>(item) && !is_all_nan<T>(result)) ++wrong;
  }
  CAPTURE(name);
  CHECK(wrong == 0);
}

/// Checks the same for every kernel, and that a batch gives the same bits as single calls.
template <class T, class In, class One, class Many>
void check_both(const char* name, const One& one, const Many& many) {
  using Out = decltype(one(In{}));
  check_one<T, In>(name, one);
  const auto items = special_items<T, In>();
  const auto stride = sym3::padded_stride<T>(items.size());
  constexpr std::size_t in_numbers = sizeof(In) / sizeof(T), out_numbers = sizeof(Out) / sizeof(T);
  std::vector<T> in(in_numbers * stride), out(out_numbers * stride);
  for (std::size_t i = 0; i < items.size(); ++i) {
    const auto numbers = std::bit_cast<std::array<T, in_numbers>>(items[i]);
    for (std::size_t k = 0; k < in_numbers; ++k) in[k * stride + i] = numbers[k];
  }
  for (const auto& kernel : sym3::kernels()) {
    many(sym3::View<const T, in_numbers>(in.data(), stride), sym3::View<T, out_numbers>(out.data(), stride),
         items.size(), sym3::Batch{&kernel});
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < items.size(); ++i) {
      std::array<T, out_numbers> numbers;
      for (std::size_t k = 0; k < out_numbers; ++k) numbers[k] = out[k * stride + i];
      if (&kernel == &sym3::kernel() && !same_or_nan<T>(std::bit_cast<Out>(numbers), one(items[i]))) ++wrong;
      if (!is_finite<T>(items[i]) && !is_all_nan<T>(numbers)) ++wrong;
    }
    CAPTURE(name);
    CAPTURE(kernel.name);
    CHECK(wrong == 0);
  }
}

}  // namespace

#define VIETE_BOTH(In, Out, function)                                                \
  check_both<T, In>(                                                                 \
      #function, [](const In& x) { return Out(sym3::function(x)); },                 \
      [](const auto& in, const auto& out, std::size_t n, const sym3::Batch& batch) { \
        sym3::function(in, out, n, batch);                                           \
      })

TEST_CASE_TEMPLATE("special_values_give_the_documented_results_in_single_calls_and_batches", T, double,
                   float) {
  VIETE_BOTH(Sym3<T>, Sym3<T>, exp);
  VIETE_BOTH(Sym3<T>, Sym3<T>, log);
  VIETE_BOTH(Sym3<T>, Sym3<T>, sqrt);
  VIETE_BOTH(Sym3<T>, Sym3<T>, inv_sqrt);
  VIETE_BOTH(Sym3<T>, Vec3<T>, eigenvalues);
  VIETE_BOTH(Vec3<T>, Mat3<T>, exp_rotation);
  VIETE_BOTH(Mat3<T>, Vec3<T>, log_rotation);
  check_both<T, Mat3<T>>(
      "polar", [](const Mat3<T>& m) { return sym3::polar(m).rotation; },
      [](const auto& in, const auto& out, std::size_t n, const sym3::Batch& batch) {
        sym3::polar(in, out, n, batch);
      });
  for (const double p : {-2.5, 0.5, 3.0})
    check_both<T, Sym3<T>>(
        "pow", [p](const Sym3<T>& s) { return sym3::pow(s, p); },
        [p](const auto& in, const auto& out, std::size_t n, const sym3::Batch& batch) {
          sym3::pow(in, p, out, n, batch);
        });
  check_one<T, Sym3<T>>("eigh", sym3::eigh<T>);
  check_one<T, Mat3<T>>("svd", sym3::svd<T>);
}

TEST_CASE_TEMPLATE("special_values_give_the_documented_results_of_exp_in_single_calls_of_every_kernel", T,
                   double, float) {
  for (const auto& kernel : sym3::kernels()) {
    CAPTURE(kernel.name);
    check_one<T, Sym3<T>>("exp", [&](const Sym3<T>& s) { return exp_with(kernel, s); });
  }
}

TEST_CASE_TEMPLATE("special_values_give_the_documented_results_of_reference_methods", T, double, float) {
  for (const auto method : {sym3::Method::diag, sym3::Method::sd, sym3::Method::improved_sd})
    check_one<T, Sym3<T>>("exp", [method](const Sym3<T>& s) { return sym3::exp(s, method); });
  check_one<T, Sym3<T>>("log_qr", sym3::log_qr<T>);
  check_one<T, Sym3<T>>("eigenvalues_qr", sym3::eigenvalues_qr<T>);
  check_one<T, Sym3<T>>("eigenvalues_viete", sym3::eigenvalues_viete<T>);
}

TEST_CASE("special_values_of_general_matrices_give_nine_nan") {
  check_one<double, Mat3<double>>("exp_general", sym3::exp_general);
  check_one<double, Mat3<double>>("log_general", sym3::log_general);
}

TEST_CASE_TEMPLATE("special_values_and_special_directions_of_derivatives_give_six_nan", T, double, float) {
  const Sym3<T> regular{2, T(0.5), T(0.25), 3, T(0.125), 4};
  const auto check = [&](const char* name, const auto& derivative) {
    check_one<T, Sym3<T>>(name, [&](const Sym3<T>& s) { return derivative(s, regular); });
    check_one<T, Sym3<T>>(name, [&](const Sym3<T>& e) { return derivative(regular, e); });
    check_one<T, Sym3<T>>(name, [&](const Sym3<T>& s) { return derivative(s, s); });
  };
  check("exp_derivative", sym3::exp_derivative<T>);
  check("log_derivative", sym3::log_derivative<T>);
  check("sqrt_derivative", sym3::sqrt_derivative<T>);
  check("pow_derivative", [](const auto& s, const auto& e) { return sym3::pow_derivative(s, -1.5, e); });
}
