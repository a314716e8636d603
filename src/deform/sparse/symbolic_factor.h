// In which order the unknowns of a sparse symmetric system are eliminated, and where its factor has entries
// then, before any of them is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "deform/sparse/sparse_kernel.h"
#include "deform/sparse/sparse_matrix.h"
#include "mesh/adjacency.h"

namespace viete::deform {

/// Called often, from any thread of the pool, with how much is done, in [0, 1]; what it throws ends the work.
using FactorReport = std::function<void(double)>;

/// The unknowns that each one shares an entry of the lower triangle with, itself excluded.
mesh::Adjacency neighbours_of_unknowns(const SparseMatrix& matrix);

/// A permutation of the unknowns, the first to be eliminated first, so that little fills in: approximate
/// minimum degree (P. R. Amestoy, T. A. Davis, I. S. Duff, 1996; Eigen's), which nothing can interrupt: 0.04
/// seconds for 100,000.
std::vector<std::uint32_t> elimination_order(const mesh::Adjacency& neighbours);

inline constexpr std::uint32_t no_parent = 0xffffffff;

/// Neighbouring columns with (nearly) the same rows are one supernode, a few zeros among its entries. A
/// supernode comes after its children, and its subtree is without gaps.
struct SymbolicFactor {
  std::vector<std::uint32_t> order;  // the unknowns, the first to be eliminated first
  std::vector<Supernode> supernodes;
  std::vector<std::uint32_t> rows;     // of the supernodes, below their own columns, ascending
  std::vector<std::uint32_t> parents;  // of the supernodes, or no_parent
  mesh::Adjacency children;
  std::size_t entries = 0;  // of all supernodes
};

/// Where each unknown is in an order.
std::vector<std::uint32_t> inverted(const std::vector<std::uint32_t>& order);

/// By the elimination tree (J. W. H. Liu, SIAM J. Matrix Anal. Appl. 11, 1990) and supernodes of it (C.
/// Ashcraft and R. Grimes, ACM Trans. Math. Softw. 15, 1989); the order becomes a postorder of the tree,
/// which fills in as little. Throws what report throws; std::bad_alloc.
SymbolicFactor analyse(const mesh::Adjacency& neighbours, std::vector<std::uint32_t> order,
                       const FactorReport& report);

}  // namespace viete::deform
