// Dense steps of sparse factorisation, and solves, in vector code. Internal.
#pragma once

#include <cstddef>
#include <cstdint>

#include "sym3/highway_targets.h"
#include "sym3/kernel.h"

// Not where another one is what all machines have.
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

struct SparseKernel {
  /// block [row][solved_columns], aligned, in place: right-hand sides become solutions.
  void (*solve_columns)(const TriangularFactor& factor, double* block);
  /// The two halves of that, of [row][4]: by L from the left, then by D and L^T. Of a part of the supernodes
  /// that contains the parents of all, they solve for the rows of these.
  void (*forward_four)(const TriangularFactor& factor, double* block);
  void (*backward_four)(const TriangularFactor& factor, double* block);
  /// Columns [begin, end) become those of L, and their pivots D: what earlier columns before `begin` take
  /// from them is taken. Few columns: their number is that of operations for each entry.
  void (*eliminate)(const Front& front, std::size_t begin, std::size_t end, double* pivots);
  /// Of column groups [begin, end).
  void (*subtract_product)(const ProductJob& job, std::size_t begin, std::size_t end);
};

/// That of the same instruction set.
const SparseKernel& sparse_kernel(const sym3::Kernel& kernel);

}  // namespace viete::deform
