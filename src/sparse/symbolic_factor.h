// Symbolic factorisation of a symmetric matrix: elimination order and positions of the factor's entries.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "mesh/adjacency.h"
#include "sparse/sparse_kernel.h"
#include "sparse/sparse_matrix.h"

namespace viete::sparse {

/// Is called often with the progress in [0, 1], from any thread of the pool. If it throws, the work ends.
using FactorReport = std::function<void(double)>;

/// Returns the neighbours of each unknown: two unknowns with an entry in the lower triangle are neighbours.
mesh::Adjacency neighbours_of_unknowns(const SparseMatrix& matrix);

/// Returns an elimination order with little fill-in, by approximate minimum degree (P. R. Amestoy, T. A.
/// Davis, I. S. Duff, 1996; Eigen's implementation). Takes 0.04 s for 100,000 unknowns, and cannot be
/// interrupted.
std::vector<std::uint32_t> elimination_order(const mesh::Adjacency& neighbours);

inline constexpr std::uint32_t no_parent = 0xffffffff;

/// The entries of a factor L, grouped into supernodes. A supernode is a group of consecutive columns with
/// entries in nearly the same rows. Supernodes are in postorder: each subtree is contiguous, its root last.
struct SymbolicFactor {
  std::vector<std::uint32_t> order;  // unknowns in elimination order
  std::vector<Supernode> supernodes;
  std::vector<std::uint32_t> rows;     // per supernode: rows below its own columns, ascending
  std::vector<std::uint32_t> parents;  // parent of each supernode, or no_parent
  mesh::Adjacency children;
  std::size_t entries = 0;  // the total number of entries of L
};

/// Returns the position of each unknown in an order.
std::vector<std::uint32_t> inverted(const std::vector<std::uint32_t>& order);

/// Finds the elimination tree (J. W. H. Liu, SIAM J. Matrix Anal. Appl. 11, 1990) and the supernodes (C.
/// Ashcraft and R. Grimes, ACM Trans. Math. Softw. 15, 1989). Changes the order to a postorder of the tree,
/// which has equal fill-in. Throws std::bad_alloc and the exceptions that report throws.
SymbolicFactor analyse(const mesh::Adjacency& neighbours, std::vector<std::uint32_t> order,
                       const FactorReport& report);

}  // namespace viete::sparse
