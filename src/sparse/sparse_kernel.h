// Vector code for the dense steps of sparse factorisation and for solves. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sym3/kernel.h"

namespace viete::sparse {

inline constexpr std::size_t solved_columns = 16;  ///< right-hand sides that are solved together

inline constexpr std::size_t column_group = 4;  ///< columns of L that are stored and processed together

/// The columns [first, first + columns) of L, which have entries in the same rows. The values are stored in
/// groups of column_group columns. Each group is stored row by row, without the entries above the diagonal
/// and without the unit diagonal.
struct Supernode {
  std::uint32_t first, columns, below;  ///< below: number of rows below the supernode's own rows
  std::size_t rows, values;             ///< offsets of the supernode's row indices and values

  std::size_t entries() const {
    return std::size_t{columns} * (columns - 1) / 2 + std::size_t{columns} * below;
  }
};

/// L and D of a matrix L * D * L^T.
struct TriangularFactor {
  const Supernode* supernodes;
  std::size_t count;
  const std::uint32_t* rows;
  const double* values;
  const double* inverse;  ///< 1 / D
};

inline constexpr std::size_t front_lanes = 8;  ///< rows of fronts are padded to a multiple of this

/// Columns of a front, which is the dense matrix that eliminates a supernode. Stored by columns. Entries
/// above the diagonal are undefined.
struct Front {
  double* values;      ///< aligned
  std::size_t stride;  ///< number of rows, padded to a multiple of front_lanes
};

/// The computation into[i, j] -= sum over p of left[i, p] * right[j, p], for i >= j.
struct ProductJob {
  Front into, left;     ///< both begin with row i = 0
  std::size_t rows;     ///< a multiple of front_lanes
  const double* right;  ///< [j / column_group][p][column_group], padded with 0
  std::size_t depth;    ///< number of terms of the sum over p
};

struct SparseKernel {
  /// The two halves of a solve: first forward with L, then backward with D and L^T. The block is aligned, and
  /// is [row][solved_columns] or [row][4]. If the factor has only some supernodes, only their rows are
  /// solved. All ancestors of these supernodes must then be in the factor.
  void (*forward_columns)(const TriangularFactor& factor, double* block);
  void (*backward_columns)(const TriangularFactor& factor, double* block);
  void (*forward_four)(const TriangularFactor& factor, double* block);
  void (*backward_four)(const TriangularFactor& factor, double* block);
  /// Converts the columns [begin, end) to columns of L, and writes the pivots D of these columns. The updates
  /// by columns before `begin` must already be subtracted. Use few columns at once, because the cost per
  /// entry is proportional to the number of columns.
  void (*eliminate)(const Front& front, std::size_t begin, std::size_t end, double* pivots);
  /// Runs the job for the column groups [begin, end).
  void (*subtract_product)(const ProductJob& job, std::size_t begin, std::size_t end);
};

/// Returns the functions for the instruction set of `kernel`.
const SparseKernel& sparse_kernel(const sym3::Kernel& kernel);

}  // namespace viete::sparse
