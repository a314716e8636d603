// Disjoint sets (union-find) for connected components.
#pragma once

#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "mesh/surface.h"

namespace viete::mesh {

/// Disjoint sets of the numbers from 0 to n - 1. At the beginning, each number is a set.
class UnionFind {
public:
  explicit UnionFind(std::size_t n = 0) { reset(n); }

  void reset(std::size_t n) {
    parent_.resize(n);
    std::iota(parent_.begin(), parent_.end(), 0u);
  }

  /// Returns the representative of the set of i.
  std::uint32_t find(std::uint32_t i) {
    while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
    return i;
  }

  /// Merges the sets of a and b. Returns true if the sets were different.
  bool join(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    parent_[a] = b;
    return a != b;
  }

private:
  std::vector<std::uint32_t> parent_;
};

/// Returns sets of vertices. Vertices that triangles connect are in one set.
inline UnionFind parts_by_triangles(std::size_t vertices, std::span<const Triangle> triangles) {
  UnionFind parts(vertices);
  for (const auto& [a, b, c] : triangles) {
    parts.join(a, b);
    parts.join(b, c);
  }
  return parts;
}

}  // namespace viete::mesh
