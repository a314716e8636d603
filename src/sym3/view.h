// Memory layouts of many small matrices: four layouts in one type. Non-owning.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "sym3/sym3.h"

namespace viete::sym3 {

enum class Layout : unsigned char {
  planes,  ///< structure of arrays: entry k of item i at plane[k][i]
  blocks,  ///< of 64 bytes: entry k of item i at data[(i / L * N + k) * L + i % L], L = 64 / sizeof(T)
  packed,  ///< array of structures: entry k of item i at data[N i + k]
  full,    ///< symmetric matrices with all nine entries: data[9 i + k], by rows or by columns
};

/// A view of many items of N numbers of type T (which may be const). N = 6: symmetric matrices in the order
/// of Sym3. N = 9: general matrices by rows. N = 3: vectors. No alignment is needed; planes must not overlap
/// each other. The last block of `blocks` must be complete in memory; numbers beyond the count are neither
/// read nor written. Symmetric matrices in `full` are read at 0 1 2 4 5 8 and written in all places. Blocks
/// and planes are fastest; strides between planes that are multiples of 4096 bytes are slow (see
/// padded_stride).
template <class T, int N>
struct View {
  Layout layout = Layout::packed;
  T* plane[N] = {};  ///< all N for `planes`, otherwise only the first: the data

  constexpr View() = default;
  constexpr View(Layout layout, T* data) : layout(layout) { plane[0] = data; }
  /// The n-th plane starts at data + n stride.
  constexpr View(T* data, std::size_t stride) : layout(Layout::planes) {
    for (int k = 0; k < N; ++k) plane[k] = data + k * stride;
  }
  constexpr explicit View(const std::array<T*, N>& planes) : layout(Layout::planes) {
    for (int k = 0; k < N; ++k) plane[k] = planes[k];
  }
  /// Conversion from writable to read-only.
  template <class U>
  requires(sizeof(U) == sizeof(T)) constexpr View(const View<U, N>& v) : layout(v.layout) {
    for (int k = 0; k < N; ++k) plane[k] = v.plane[k];
  }
};

/// Symmetric matrices.
template <class T>
using SymView = View<T, 6>;
/// General matrices, entries by rows.
template <class T>
using MatView = View<T, 9>;
/// Vectors.
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

/// A stride for planes of `count` numbers that places each plane at a 64-byte boundary and 448 bytes further
/// into a page than the previous one: in other cache sets, and away from stores that processors confuse with
/// loads 4096 bytes apart.
template <class T>
constexpr std::size_t padded_stride(std::size_t count) {
  constexpr std::size_t page = 4096 / sizeof(T), step = 448 / sizeof(T);
  return count <= step ? step : (count - step + page - 1) / page * page + step;
}

/// Size of `blocks` for `count` items of N entries, in numbers.
template <class T, int N = 6>
constexpr std::size_t block_size(std::size_t count) {
  constexpr std::size_t line = 64 / sizeof(T);
  return (count + line - 1) / line * line * N;
}

}  // namespace viete::sym3
