// Many matrices in one of sym3's layouts, for benchmarks.
#pragma once

#include <cstddef>
#include <cstring>
#include <span>

#include "base/memory.h"
#include "sym3/view.h"

namespace viete::bench {

template <class T>
class MatrixArray {
public:
  MatrixArray(sym3::Layout layout, std::size_t count)
      : layout_(layout),
        count_(count),
        stride_(sym3::padded_stride<T>(count)),
        data_(layout == planes ? 6 * stride_ : (layout == full ? 9 : 6) * count) {}

  sym3::SymView<T> view() {
    if (layout_ == planes) return {data_.data(), stride_};
    return {layout_, data_.data()};
  }

  /// Fills the array with these matrices and repeats them as often as necessary.
  void fill(std::span<const sym3::Sym3<T>> matrices) {
    constexpr std::size_t in_full[] = {0, 1, 2, 1, 3, 4, 2, 4, 5};
    const std::size_t size = layout_ == full ? 9 : 6;
    for (std::size_t i = 0; i < count_; ++i) {
      const sym3::Sym3<T>& s = matrices[i % matrices.size()];
      const T entries[6] = {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
      for (std::size_t k = 0; k < size; ++k)
        data_[layout_ == planes ? k * stride_ + i : size * i + k] = entries[size == 9 ? in_full[k] : k];
    }
  }

  /// Reads and writes as many bytes as a computation. The time of this copy is a reference.
  void copy_to(MatrixArray& other) const {
    const std::size_t size = layout_ == planes ? count_ : data_.size();
    for (std::size_t from = 0; from < data_.size(); from += layout_ == planes ? stride_ : size)
      std::memcpy(other.data_.data() + from, data_.data() + from, size * sizeof(T));
  }

private:
  static constexpr auto planes = sym3::Layout::planes, full = sym3::Layout::full;
  sym3::Layout layout_;
  std::size_t count_, stride_;
  base::AlignedVector<T> data_;
};

}  // namespace viete::bench
