// Disjoint sets (union-find), for finding connected components.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Disjoint sets of the numbers 0 to n - 1. At first, each number is a set.
class UnionFind {
public:
  explicit UnionFind(std::size_t n = 0) { reset(n); }

  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// Returns the representative of the set that contains i.
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

/// Returns the sets of vertices that triangles connect.
inline UnionFind parts_by_triangles(std::size_t vertices, std::span<const Triangle> triangles) {
  UnionFind parts(vertices);
  for (const auto& [a, b, c] : triangles) parts.join(a, b), parts.join(b, c);
  return parts;
}

}  // namespace viete::mesh
