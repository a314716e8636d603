#include "deform/leaves.h"

#include <numeric>

namespace viete::deform {

namespace {

using Run = std::span<std::uint32_t>;

int longest_side(std::span<const mesh::Point> positions, Run run) {
  const auto [low, high] = mesh::bounds(positions, run);
  int side = 0;
  for (int i = 1; i < 3; ++i) {
    if (high[i] - low[i] > high[side] - low[side]) side = i;
  }
  return side;
}

void sort_run(std::span<const mesh::Point> positions, Run run) {
  if (run.size() <= leaf_slots) return;
  const int side = longest_side(positions, run);
  const std::size_t half = (run.size() / 2 + leaf_slots - 1) / leaf_slots * leaf_slots;
  std::nth_element(run.begin(), run.begin() + static_cast<std::ptrdiff_t>(half), run.end(),
                   [&](std::uint32_t a, std::uint32_t b) {
                     const double x = positions[a][side], y = positions[b][side];
                     return x != y ? x < y : a < b;
                   });
  sort_run(positions, run.first(half));
  sort_run(positions, run.subspan(half));
}

}  // namespace

std::vector<std::uint32_t> slots_of(const Leaves& leaves) {
  std::vector<std::uint32_t> slots(leaves.vertices);
  for (std::uint32_t s = 0; s < leaves.vertices; ++s) slots[leaves.order[s]] = s;
  return slots;
}

Leaves make_leaves(std::span<const mesh::Point> positions, std::span<const std::uint32_t> triangles_around) {
  Leaves leaves;
  leaves.vertices = positions.size();
  leaves.order.resize(positions.size());
  std::iota(leaves.order.begin(), leaves.order.end(), 0u);
  sort_run(positions, leaves.order);
  for (std::size_t s = 0; s < positions.size(); s += leaf_slots) {
    const auto leaf = Run(leaves.order).subspan(s, std::min(leaf_slots, positions.size() - s));
    std::sort(leaf.begin(), leaf.end(), [&](std::uint32_t a, std::uint32_t b) {
      const auto x = triangles_around[a], y = triangles_around[b];
      return x != y ? x < y : a < b;
    });
  }
  leaves.order.resize((positions.size() + slot_block - 1) / slot_block * slot_block, leaves.order.back());
  return leaves;
}

}  // namespace viete::deform
