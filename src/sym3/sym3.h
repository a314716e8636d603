// A real symmetric 3x3 matrix as six numbers.
#pragma once

namespace viete::sym3 {

/// The upper triangle by rows. The layouts `planes` and `packed` of view.h store entries in this order.
template <class T>
struct Sym3 {
  T xx{}, xy{}, xz{}, yy{}, yz{}, zz{};

  friend bool operator==(const Sym3&, const Sym3&) = default;
};

template <class T>
constexpr Sym3<T> identity() {
  return {T(1), T(0), T(0), T(1), T(0), T(1)};
}

/// The value hi + lo with about 106 bits: |lo| is at most half a unit in the last place of hi.
struct DoubleDouble {
  double hi = 0, lo = 0;
};

}  // namespace viete::sym3
