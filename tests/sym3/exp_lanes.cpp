// The functions of registers for loops of one's own: exp's derivatives and value from one point.
#include "sym3/highway_targets.h"
// Highway's headers behind it.
#include "sym3/exp_derivative-inl.h"
//
#include "sym3/call_kernel.h"
#include "sym3/kernel.h"
#include "sym3/preamble.h"
#include "sym3/quad_reference.h"

namespace {

namespace lanes = viete::sym3::HWY_NAMESPACE;

template <class T>
void check_lanes(double spread) {
  const hwy::HWY_NAMESPACE::CappedTag<T, 1> d;
  const auto all = spreads<T>(spread, -spread / 2, 100);
  const sym3::Kernel& kernel = sym3::kernels().back();
  using V = hwy::HWY_NAMESPACE::Vec<std::remove_const_t<decltype(d)>>;
  const auto load = [&](const Sym3<T>& s) {
    const auto set = [&](T x) { return hwy::HWY_NAMESPACE::Set(d, x); };
    return lanes::Six<V>(set(s.xx), set(s.xy), set(s.xz), set(s.yy), set(s.yz), set(s.zz));
  };
  const auto store = [](const lanes::Six<V>& s) {
    using hwy::HWY_NAMESPACE::GetLane;
    return Sym3<T>{GetLane(s.xx), GetLane(s.xy), GetLane(s.xz), GetLane(s.yy), GetLane(s.yz), GetLane(s.zz)};
  };
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    const auto point = lanes::exp_point(d, load(all[i]));
    Sym3<T> expected;
    sym3::functions<T>(kernel).derivative->one(&all[i].xx, &all[i + 1].xx, &expected.xx, sym3::Of::exp, 0);
    CHECK(store(lanes::exp_derivative(d, point, load(all[i + 1]))) == expected);
    CHECK(error_in_u(store(lanes::exp_value(d, point)), quad_exp(to_quad(all[i]))) <= 8 + 2.5 * spread);
  }
}

}  // namespace

TEST_CASE_TEMPLATE("exp_and_its_derivative_of_registers_come_from_one_point", T, double, float) {
  for (const double spread : {0.0, 1.0, 4.9, 30.0}) check_lanes<T>(spread);
}
