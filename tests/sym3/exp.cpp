#include "sym3/exp.h"

#include <limits>
#include <vector>

#include "sym3/each_kernel.h"
#include "sym3/entries_of.h"
#include "sym3/preamble.h"

using sym3::Method;

namespace {

constexpr Method all_methods[] = {Method::diag, Method::sd, Method::improved_sd, Method::improved_sd_faithful,
                                  Method::fast};

template <class T>
bool same_value(const Sym3<T>& a, const Sym3<T>& b) {
  const auto x = entries_of(a), y = entries_of(b);
  return std::ranges::equal(x, y, [](T p, T q) { return p == q || (std::isnan(p) && std::isnan(q)); });
}

}  // namespace

TEST_CASE("every_method_is_found_by_its_name") {
  for (const Method method : all_methods) CHECK(sym3::method_from_name(sym3::name(method)) == method);
  CHECK(sym3::name(Method::improved_sd) == "improved_sd");
  CHECK_FALSE(sym3::method_from_name("improved sd"));
  CHECK_FALSE(sym3::method_from_name(""));
}

TEST_CASE_TEMPLATE("default_is_fast_by_the_running_kernel", T, double, float) {
  for (const auto& s : paper_ensemble<T>(100)) {
    CHECK(sym3::exp(s) == sym3::exp(s, Method::fast));
    CHECK(sym3::exp(s) == exp_with(sym3::kernel(), s));
  }
}

TEST_CASE_TEMPLATE("batch_has_the_bits_of_the_single_call_also_in_place", T, double, float) {
  auto matrices = paper_ensemble<T>(50);
  matrices.push_back({});
  matrices.push_back({std::numeric_limits<T>::quiet_NaN(), 0, 0, 0, 0, 0});
  matrices.push_back(diagonal(T(710), T(0), T(0)));
  for (const Method method : all_methods) {
    std::vector<Sym3<T>> out(matrices.size()), in_place = matrices;
    sym3::exp<T>(matrices, out, method);
    sym3::exp<T>(in_place, in_place, method);
    for (std::size_t i = 0; i < matrices.size(); ++i) {
      CHECK(same_value(out[i], sym3::exp(matrices[i], method)));
      CHECK(same_value(in_place[i], out[i]));
    }
  }
}

TEST_CASE_TEMPLATE("an_empty_batch_writes_nothing", T, double, float) {
  for (const Method method : all_methods) {
    Sym3<T> beside = diagonal(T(1), T(2), T(3));
    sym3::exp<T>(std::span<const Sym3<T>>(), std::span(&beside, 0), method);
    CHECK(beside == diagonal(T(1), T(2), T(3)));
  }
}

TEST_CASE_TEMPLATE("nan_and_infinity_give_six_nan_by_every_method", T, double, float) {
  for (const Method method : all_methods) {
    for (const T bad : {std::numeric_limits<T>::quiet_NaN(), std::numeric_limits<T>::infinity()}) {
      CHECK(all_nan(sym3::exp(Sym3<T>{1, bad, 0, 2, 0, 3}, method)));
      CHECK(all_nan(sym3::exp(Sym3<T>{1, 0, 0, 2, 0, bad}, method)));
    }
  }
}

TEST_CASE_TEMPLATE("zero_gives_the_identity_by_every_guarded_method", T, double, float) {
  for (const Method method : {Method::diag, Method::sd, Method::improved_sd, Method::fast}) {
    CHECK(sym3::exp(Sym3<T>{}, method) == sym3::identity<T>());
  }
}
