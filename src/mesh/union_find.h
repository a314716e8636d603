// Disjoint sets (union-find) for connected components.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace viete::mesh {

/// Sets of the numbers 0 to n - 1; initially one set per number.
class UnionFind {
public:
  explicit UnionFind(std::size_t n = 0) { reset(n); }

  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// The representative of i's set. Halves the path to it.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Merges the sets of a and b. Returns true if they were different.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[a] = b;
    return a != b;
  }

private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace viete::mesh
