// Views of many small matrices in three memory layouts. A view does not own its data.
#pragma once

#include <array>
#include <cstddef>

#include "sym3/sym3.h"

namespace viete::sym3 {

enum class Layout : unsigned char {
  planes,  ///< structure of arrays: entry k of item i at plane[k][i]
  packed,  ///< array of structures: entry k of item i at data[N * i + k]
  full,    ///< symmetric matrices with all nine entries: data[9 * i + k], by rows or by columns
};

/// A view of many items of N numbers of type T. T may be const. An item is a symmetric matrix in the order of
/// Sym3 (N = 6), a general matrix by rows (N = 9) or a vector (N = 3). Data may have any alignment. Planes
/// must not overlap each other. If the layout is `full`, functions read the entries 0 1 2 4 5 8 of a
/// symmetric matrix and write all nine. Planes are the fastest layout. They are slow only if a distance
/// between planes is a multiple of 4096 bytes, see padded_stride().
template <class T, int N>
struct View {
  Layout layout = Layout::packed;
  T* plane[N] = {};  ///< `planes` uses all N pointers; other layouts use only plane[0], the data

  constexpr View() = default;
  constexpr View(Layout layout, T* data) : layout(layout) { plane[0] = data; }
  /// Plane k starts at data + k * stride.
  constexpr View(T* data, std::size_t stride) : layout(Layout::planes) {
    for (int k = 0; k < N; ++k) plane[k] = data + k * stride;
  }
  constexpr explicit View(const std::array<T*, N>& planes) : layout(Layout::planes) {
    for (int k = 0; k < N; ++k) plane[k] = planes[k];
  }
  /// Makes a read-only view from a writable one.
  template <class U>
  requires(sizeof(U) == sizeof(T)) constexpr View(const View<U, N>& v) : layout(v.layout) {
    for (int k = 0; k < N; ++k) plane[k] = v.plane[k];
  }
};

template <class T>
using SymView = View<T, 6>;
template <class T>
using MatView = View<T, 9>;
template <class T>
using VecView = View<T, 3>;

template <class T>
SymView<T> packed(Sym3<T>* data) {
  return {Layout::packed, reinterpret_cast<T*>(data)};
}
template <class T>
SymView<const T> packed(const Sym3<T>* data) {
  return {Layout::packed, reinterpret_cast<const T*>(data)};
}

/// Returns a fast stride between planes of `count` numbers: a multiple of 4096 bytes plus 448 bytes. Planes
/// then use different cache sets, and no load waits for a store to another plane. If the first plane is
/// aligned to 64 bytes, all planes are aligned.
template <class T>
constexpr std::size_t padded_stride(std::size_t count) {
  constexpr std::size_t page = 4096 / sizeof(T), step = 448 / sizeof(T);
  return count <= step ? step : (count - step + page - 1) / page * page + step;
}

}  // namespace viete::sym3
