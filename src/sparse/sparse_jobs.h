// The data that sparse kernels work on. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

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

}  // namespace viete::sparse
