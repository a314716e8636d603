// Many matrices in one of sym3's layouts, for benchmarks.
#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <new>
#include <span>

#include "sym3/view.h"

namespace viete::bench {

/// Starts at a page boundary, like large arrays. Not initialised.
template <class T>
class MatrixArray {
public:
  MatrixArray(sym3::Layout layout, std::size_t count)
      : layout_(layout), count_(count), stride_(sym3::padded_stride<T>(count)), size_(numbers()) {
    data_.reset(static_cast<T*>(std::aligned_alloc(4096, (size_ * sizeof(T) + 4095) / 4096 * 4096)));
    if (!data_) throw std::bad_alloc();
  }

  sym3::SymView<T> view() const {
    if (layout_ == sym3::Layout::planes) return sym3::SymView<T>(data_.get(), stride_);
    return sym3::SymView<T>(layout_, data_.get());
  }

  /// Fills the array with these matrices, repeated.
  void fill(std::span<const sym3::Sym3<T>> matrices) {
    for (std::size_t i = 0; i < count_; ++i) set(i, matrices[i % matrices.size()]);
  }

  /// The copy as a reference for computations: the same bytes, read once and written once.
  void copy_to(MatrixArray& other) const {
    if (layout_ != sym3::Layout::planes) {
      std::memcpy(other.data_.get(), data_.get(), size_ * sizeof(T));
      return;
    }
    for (std::size_t k = 0; k < 6; ++k) {
      std::memcpy(other.data_.get() + k * stride_, data_.get() + k * stride_, count_ * sizeof(T));
    }
  }

private:
  std::size_t numbers() const {
    switch (layout_) {
      case sym3::Layout::planes: return 6 * stride_;
      case sym3::Layout::blocks: return sym3::block_size<T>(count_);
      case sym3::Layout::packed: return 6 * count_;
      case sym3::Layout::full: break;
    }
    return 9 * count_;
  }

  void set(std::size_t i, const sym3::Sym3<T>& s) {
    const T entries[6] = {s.xx, s.xy, s.xz, s.yy, s.yz, s.zz};
    constexpr std::size_t in_full[] = {0, 1, 2, 1, 3, 4, 2, 4, 5}, line = 64 / sizeof(T);
    T* data = data_.get();
    if (layout_ == sym3::Layout::full) {
      for (std::size_t k = 0; k < 9; ++k) data[9 * i + k] = entries[in_full[k]];
      return;
    }
    for (std::size_t k = 0; k < 6; ++k) {
      const std::size_t at = layout_ == sym3::Layout::planes   ? k * stride_ + i
                             : layout_ == sym3::Layout::blocks ? (i / line * 6 + k) * line + i % line
                                                               : 6 * i + k;
      data[at] = entries[k];
    }
  }

  struct Free {
    void operator()(T* data) const { std::free(data); }
  };
  sym3::Layout layout_;
  std::size_t count_, stride_, size_;
  std::unique_ptr<T[], Free> data_;
};

}  // namespace viete::bench
