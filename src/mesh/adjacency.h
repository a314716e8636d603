// Lists of items for each index: for example, the triangles around each vertex.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <span>
#include <vector>

#include "base/worker_pool.h"
#include "mesh/surface.h"

namespace viete::mesh {

/// A list of items for each index i: items[starts[i]] to items[starts[i + 1] - 1].
struct Adjacency {
  std::vector<std::uint32_t> starts, items;

  std::span<const std::uint32_t> of(std::size_t i) const {
    return std::span(items).subspan(starts[i], starts[i + 1] - starts[i]);
  }
};

/// Makes `count` lists. for_each(add) must call add(i, item) for each item of list i. for_each() is called
/// twice, and must add the same items in the same order. There must be at most 2^32 - 1 items.
template <class ForEach>
Adjacency make_adjacency(std::size_t count, const ForEach& for_each) {
  Adjacency lists;
  lists.starts.assign(count + 1, 0);
  for_each([&](std::uint32_t i, std::uint32_t) { ++lists.starts[i + 1]; });
  std::partial_sum(lists.starts.begin(), lists.starts.end(), lists.starts.begin());
  lists.items.resize(lists.starts.back());
  std::vector<std::uint32_t> next(lists.starts.begin(), lists.starts.end() - 1);
  for_each([&](std::uint32_t i, std::uint32_t item) { lists.items[next[i]++] = item; });
  return lists;
}

/// Works like make_adjacency(), but uses all processors, and sorts each list. Calls for_each(t, add) twice
/// for each t from 0 to elements - 1. Each of these calls must add the items of element t.
template <class ForEach>
Adjacency sorted_adjacency(std::size_t count, std::size_t elements, const ForEach& for_each) {
  Adjacency lists;
  lists.starts.assign(count + 1, 0);
  const auto for_all = [&](const auto& add) {
    base::for_blocks(elements, [&](std::size_t begin, std::size_t end) {
      for (std::size_t t = begin; t < end; ++t) for_each(static_cast<std::uint32_t>(t), add);
    });
  };
  const auto slot = [&](std::uint32_t i) { return std::atomic_ref(lists.starts[i]); };
  for_all([&](std::uint32_t i, std::uint32_t) { slot(i).fetch_add(1, std::memory_order_relaxed); });
  std::partial_sum(lists.starts.begin(), lists.starts.end(), lists.starts.begin());
  lists.items.resize(lists.starts.back());
  for_all([&](std::uint32_t i, std::uint32_t item) {  // fills each list from back to front
    lists.items[slot(i).fetch_sub(1, std::memory_order_relaxed) - 1] = item;
  });
  base::for_blocks(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      std::sort(lists.items.begin() + lists.starts[i], lists.items.begin() + lists.starts[i + 1]);
  });
  return lists;
}

/// Returns the neighbours of each node of a graph, in the order of the edges.
inline Adjacency adjacency(std::size_t nodes, std::span<const Edge> edges) {
  return make_adjacency(nodes, [&](const auto& add) {
    for (const auto& [a, b] : edges) {
      add(a, b);
      add(b, a);
    }
  });
}

}  // namespace viete::mesh
