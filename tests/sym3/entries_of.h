// The six numbers of a matrix as an array, and tests of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "sym3/sym3.h"

namespace viete::test {

template <class T>
std::array<T, 6> entries_of(const sym3::Sym3<T>& s) {
  return {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
}

template <class T>
bool all_nan(const sym3::Sym3<T>& s) {
  return std::ranges::all_of(entries_of(s), [](T x) { return std::isnan(x); });
}

template <class T>
bool none_nan(const sym3::Sym3<T>& s) {
  return std::ranges::none_of(entries_of(s), [](T x) { return std::isnan(x); });
}

template <class T>
sym3::Sym3<T> diagonal(T x, T y, T z) {
  return {x, 0, 0, y, 0, z};
}

template <class T>
sym3::Sym3<T> negated(const sym3::Sym3<T>& s) {
  return {-s.xx, -s.xy, -s.xz, -s.yy, -s.yz, -s.zz};
}

}  // namespace viete::test
