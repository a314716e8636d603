// The data that sparse kernels work on. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sym3/highway_targets.h"

// Null if all machines of the build have a better instruction set.
#if HWY_TARGETS & HWY_SCALAR
#define VIETE_CHOOSE_SCALAR(name) &N_SCALAR::name
#else
#define VIETE_CHOOSE_SCALAR(name) nullptr
#endif
// Use after Highway's foreach_target: returns the object `name` of the namespace of `target`.
#define VIETE_RETURN_COMPILED(name, target)               \
  return *((target) == HWY_AVX3   ? HWY_CHOOSE_AVX3(name) \
           : (target) == HWY_AVX2 ? HWY_CHOOSE_AVX2(name) \
           : (target) == HWY_NEON ? HWY_CHOOSE_NEON(name) \
                                  : VIETE_CHOOSE_SCALAR(name))

namespace viete::deform {

inline constexpr std::size_t solved_columns = 16;  ///< right-hand sides that are solved together

inline constexpr std::size_t column_group = 4;  ///< columns of L that are stored and processed together

/// Columns [first, first + columns) of L, whose entries below these columns lie in the same rows. Values are
/// stored by column group, row by row: first the rows of the group's own columns, with 0 entries in the
/// first, 1 in the second, and so on (the unit diagonal is not stored), then those of the supernode's later
/// columns and of the rows below it.
struct Supernode {
  std::uint32_t first, columns, below;
  std::size_t rows, values;  ///< offsets of its rows and values

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
  const double* inverse;  ///< 1 / D
};

inline constexpr std::size_t front_lanes = 8;  ///< rows of fronts are padded to a multiple of this

/// Columns of a front, the dense matrix in which unknowns are eliminated, column-major; entries above the
/// diagonal are undefined.
struct Front {
  double* values;      ///< aligned
  std::size_t stride;  ///< number of rows, padded to a multiple of front_lanes
};

/// into[i, j] -= sum over p of left[i, p] right[j, p], i >= j.
struct ProductJob {
  Front into, left;     ///< with all of their rows; the first row of both is that of column 0
  std::size_t rows;     ///< a multiple of front_lanes
  const double* right;  ///< [j / column_group][p][column_group], padded with 0
  std::size_t depth;    ///< number of terms of the sum over p
};

}  // namespace viete::deform
