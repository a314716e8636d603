// Dense steps of sparse factorisation, and solves, in vector code. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sym3/highway_targets.h"
#include "sym3/kernel.h"

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
           : (target) == HWY_SSE4 ? HWY_CHOOSE_SSE4(name) \
           : (target) == HWY_NEON ? HWY_CHOOSE_NEON(name) \
                                  : VIETE_CHOOSE_SCALAR(name))

namespace viete::deform {

inline constexpr std::size_t solved_columns = 16;  ///< right-hand sides at once

inline constexpr std::size_t column_group = 4;  ///< columns at once

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
  std::size_t stride;  ///< rows: a multiple of front_lanes
};

/// into[i, j] -= sum over p of left[i, p] right[j, p], i >= j.
struct ProductJob {
  Front into, left;     ///< with all of their rows; the first row of both is that of column 0
  std::size_t rows;     ///< a multiple of front_lanes
  const double* right;  ///< [j / column_group][p][column_group], padded with 0
  std::size_t depth;    ///< range of p
};

struct SparseKernel {
  /// block [row][solved_columns], aligned; replaces right-hand sides by solutions.
  void (*solve_columns)(const TriangularFactor& factor, double* block);
  /// The two halves of a solve, for [row][4]: forward by L, then backward by D and L^T. For a subset of the
  /// supernodes that is closed under parents, they solve for the rows of the subset.
  void (*forward_four)(const TriangularFactor& factor, double* block);
  void (*backward_four)(const TriangularFactor& factor, double* block);
  /// Turns columns [begin, end) into those of L, and writes their pivots D. The updates by columns before
  /// `begin` must already be subtracted. Meant for few columns: the cost per entry is proportional to their
  /// number.
  void (*eliminate)(const Front& front, std::size_t begin, std::size_t end, double* pivots);
  /// Processes column groups [begin, end).
  void (*subtract_product)(const ProductJob& job, std::size_t begin, std::size_t end);
};

/// The kernel for the same instruction set.
const SparseKernel& sparse_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
