// Tests matrices in all layouts and with all kernels.
#pragma once

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

#include "sym3/call_kernel.h"
#include "sym3/exp.h"
#include "sym3/kernel.h"
#include "sym3/sym3.h"
#include "sym3/view.h"

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
sym3::Sym3<T> exp_with(const sym3::Kernel& kernel, const sym3::Sym3<T>& s) {
  sym3::Sym3<T> out;
  sym3::functions<T>(kernel).exp->one(&s.xx, &out.xx);
  return out;
}

inline constexpr sym3::Layout layouts[] = {sym3::Layout::planes, sym3::Layout::packed, sym3::Layout::full};
inline constexpr int in_full[6] = {0, 1, 2, 4, 5, 8};

/// Memory for many items in a layout. Begins `offset` numbers after a 64-byte boundary. Memory that no item
/// uses has the value `guard`.
template <class T, class Item = sym3::Sym3<T>>
class Arranged {
public:
  static constexpr int N = sizeof(Item) / sizeof(T);

  Arranged(sym3::Layout layout, std::size_t count, std::size_t offset = 0)
      : layout_(layout), stride_(sym3::padded_stride<T>(count)) {
    memory_.assign(std::max(N * stride_, 9 * count) + 128, guard);
    const auto bytes = reinterpret_cast<std::uintptr_t>(memory_.data());
    data_ = memory_.data() + (64 - bytes % 64) % 64 / sizeof(T) + offset;
  }
  Arranged(sym3::Layout layout, const std::vector<Item>& items, std::size_t count, std::size_t offset = 0)
      : Arranged(layout, count, offset) {
    for (std::size_t i = 0; i < count; ++i) {
      const auto numbers = std::bit_cast<std::array<T, N>>(items[i]);
      for (int k = 0; k < N; ++k) entry(k, i) = numbers[k];
    }
  }

  sym3::View<T, N> view() {
    return layout_ == sym3::Layout::planes ? sym3::View<T, N>(data_, stride_)
                                           : sym3::View<T, N>(layout_, data_);
  }
  Item get(std::size_t i) {
    std::array<T, N> numbers;
    for (int k = 0; k < N; ++k) numbers[k] = entry(k, i);
    return std::bit_cast<Item>(numbers);
  }
  bool is_symmetric(std::size_t i) {
    const T* m = data_ + 9 * i;
    const auto same = [](T a, T b) { return std::memcmp(&a, &b, sizeof(T)) == 0; };
    return layout_ != sym3::Layout::full || (same(m[1], m[3]) && same(m[2], m[6]) && same(m[5], m[7]));
  }
  /// Returns true if exactly the numbers of the first `count` items were written.
  bool holds(std::size_t count) const {
    const std::size_t width = layout_ == sym3::Layout::full ? 9 : N;
    return memory_.size() - std::count(memory_.begin(), memory_.end(), guard) == width * count;
  }

  static constexpr T guard = T(-12345);

private:
  T& entry(int k, std::size_t i) {
    if (layout_ == sym3::Layout::planes) return data_[k * stride_ + i];
    if constexpr (N == 6)
      if (layout_ == sym3::Layout::full) return data_[9 * i + in_full[k]];
    return data_[N * i + k];
  }

  sym3::Layout layout_;
  std::size_t stride_;
  std::vector<T> memory_;
  T* data_;
};

/// Returns true if all numbers of two items are equal. NaN equals NaN.
template <class T, class Item>
bool same_or_nan(const Item& a, const Item& b) {
  using Numbers = std::array<T, sizeof(Item) / sizeof(T)>;
  return std::ranges::equal(std::bit_cast<Numbers>(a), std::bit_cast<Numbers>(b),
                            [](T x, T y) { return x == y || (std::isnan(x) && std::isnan(y)); });
}

/// Checks many(from, to, count) for all pairs of layouts and for many lengths. The results must be as
/// expected, and no other memory may change.
template <class T, class In, class Out, class Many>
void check_every_batch(const std::vector<In>& in, const std::vector<Out>& expected, const Many& many) {
  const auto fits = [](sym3::Layout layout, int n) { return layout != sym3::Layout::full || n == 6; };
  for (const auto from : layouts)
    for (const auto to : layouts) {
      if (!fits(from, Arranged<T, In>::N) || !fits(to, Arranged<T, Out>::N)) continue;
      for (std::size_t count = 0; count <= in.size(); count += count < 70 ? 1 : 40) {
        Arranged<T, In> there(from, in, in.size());
        Arranged<T, Out> here(to, in.size());
        many(sym3::View<const T, Arranged<T, In>::N>(there.view()), here.view(), count);
        bool same = here.holds(count);
        for (std::size_t i = 0; i < count; ++i)
          same = same && same_or_nan<T>(here.get(i), expected[i]) && here.is_symmetric(i);
        CAPTURE(int(from));
        CAPTURE(int(to));
        CAPTURE(count);
        CHECK(same);
      }
    }
}

}  // namespace viete::test
