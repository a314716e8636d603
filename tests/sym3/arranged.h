// Matrices in every layout and with every kernel, and their entries.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

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
sym3::Sym3<T> negated(const sym3::Sym3<T>& s) {
  return {-s.xx, -s.xy, -s.xz, -s.yy, -s.yz, -s.zz};
}

/// `count` matrices of six numbers each.
template <class T>
void run(const sym3::Kernel& kernel, const T* in, T* out, std::size_t count) {
  sym3::exp(sym3::SymView<const T>(sym3::Layout::packed, in), sym3::SymView<T>(sym3::Layout::packed, out),
            count, {&kernel});
}

template <class T>
sym3::Sym3<T> exp_with(const sym3::Kernel& kernel, const sym3::Sym3<T>& s) {
  sym3::Sym3<T> out;
  run(kernel, &s.xx, &out.xx, 1);
  return out;
}

inline constexpr sym3::Layout layouts[] = {sym3::Layout::planes, sym3::Layout::blocks, sym3::Layout::packed,
                                           sym3::Layout::full};
inline constexpr int in_full[6] = {0, 1, 2, 4, 5, 8};

/// Matrices in one layout, `offset` numbers off a 64-byte boundary, followed by a guard that must not change.
template <class T>
class Arranged {
public:
  Arranged(sym3::Layout layout, std::size_t count, std::size_t offset) : layout_(layout), count_(count) {
    stride_ = sym3::padded_stride<T>(count);
    const std::size_t whole = std::max({6 * stride_, 9 * count, sym3::block_size<T>(count)});
    memory_.assign(whole + 128, guard);
    const auto bytes = reinterpret_cast<std::uintptr_t>(memory_.data());
    data_ = memory_.data() + (64 - bytes % 64) % 64 / sizeof(T) + offset;
  }

  sym3::SymView<T> view() {
    return layout_ == sym3::Layout::planes ? sym3::SymView<T>(data_, stride_)
                                           : sym3::SymView<T>(layout_, data_);
  }

  T& entry(int k, std::size_t i) {
    constexpr std::size_t line = 64 / sizeof(T);
    if (layout_ == sym3::Layout::planes) return data_[k * stride_ + i];
    if (layout_ == sym3::Layout::blocks) return data_[(i / line * 6 + k) * line + i % line];
    if (layout_ == sym3::Layout::packed) return data_[6 * i + k];
    return data_[9 * i + in_full[k]];
  }

  void set(std::size_t i, const sym3::Sym3<T>& s) {
    const auto e = entries_of(s);
    for (int k = 0; k < 6; ++k) entry(k, i) = e[k];
  }

  sym3::Sym3<T> get(std::size_t i) {
    return {entry(0, i), entry(1, i), entry(2, i), entry(3, i), entry(4, i), entry(5, i)};
  }

  bool is_symmetric(std::size_t i) {
    const T* m = data_ + 9 * i;
    const auto same = [](T a, T b) { return std::memcmp(&a, &b, sizeof(T)) == 0; };
    return layout_ != sym3::Layout::full || (same(m[1], m[3]) && same(m[2], m[6]) && same(m[5], m[7]));
  }

  std::size_t untouched() const { return std::count(memory_.begin(), memory_.end(), guard); }

  static constexpr T guard = T(-12345);

private:
  sym3::Layout layout_;
  std::size_t count_, stride_;
  std::vector<T> memory_;
  T* data_;
};

}  // namespace viete::test
