// Disjoint sets (union-find): what is connected with what.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

namespace viete::mesh {

/// Sets of the numbers from 0 to n - 1, at first one each.
class UnionFind {
public:
  explicit UnionFind(std::size_t n = 0) { reset(n); }

  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// The same number for all of a set, one of its own. Halves the path to it.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// True if they were in different sets.
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
