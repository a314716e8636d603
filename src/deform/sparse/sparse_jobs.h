// What the kernels of sparse factors work on. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

namespace viete::deform {

inline constexpr std::size_t solved_columns = 16;  ///< right-hand sides at once

inline constexpr std::size_t column_group = 4;  ///< columns at once

/// Columns [first, first + columns) of L, whose entries below lie in the same rows. Values: of one column
/// group after the other, of these row by row, first those of its own columns, of which the first has 0
/// entries, the second 1, and so on (the diagonal of ones is not kept), then of the supernode's other columns
/// and of the rows below it.
struct Supernode {
  std::uint32_t first, columns, below;
  std::size_t rows, values;  ///< where they begin

  std::size_t entries() const {
    return std::size_t{columns} * (columns - 1) / 2 + std::size_t{columns} * below;
  }
};

/// L and D of a matrix L D L^T.
struct TriangularFactor {
  const Supernode* supernodes;
  std::size_t count;
  const std::uint32_t* rows;
  const double* values;
  const double* inverse;  ///< of D
};

inline constexpr std::size_t front_lanes = 8;  ///< what fronts are padded to a multiple of

/// Columns of a front, the dense matrix that unknowns are eliminated in, by columns; what is above the
/// diagonal is of no use.
struct Front {
  double* values;      ///< aligned
  std::size_t stride;  ///< rows: a multiple of front_lanes
};

/// into[i, j] -= sum over p of left[i, p] right[j, p], i >= j.
struct ProductJob {
  Front into, left;     ///< all of their rows; the first row of both is that of column 0
  std::size_t rows;     ///< a multiple of front_lanes
  const double* right;  ///< [j / column_group][p][column_group], padded with 0
  std::size_t depth;    ///< p
};

}  // namespace viete::deform
