// The type: a 3x3 real symmetric matrix as six numbers.
#pragma once

namespace viete::sym3 {

/// The upper triangle by rows. This order is used everywhere: in memory, in planes, in packed arrays.
template <class T>
struct Sym3 {
  T xx{}, xy{}, xz{}, yy{}, yz{}, zz{};

  friend bool operator==(const Sym3&, const Sym3&) = default;
};

template <class T>
constexpr Sym3<T> identity() {
  return {T(1), T(0), T(0), T(1), T(0), T(1)};
}

/// A value hi + lo, |lo| <= ulp(hi) / 2: about 106 bits.
struct DoubleDouble {
  double hi = 0, lo = 0;
};

}  // namespace viete::sym3
