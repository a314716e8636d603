// Where the factor of a sparse symmetric matrix has entries, before any of them is known.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "deform/sparse/elimination_order.h"
#include "deform/sparse/sparse_kernel.h"
#include "mesh/adjacency.h"

namespace viete::deform {

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
