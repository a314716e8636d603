#include "mesh/point_index.h"

#include <bit>

namespace viete::mesh {

namespace {

// A hash function, based on the finaliser of splitmix64 (Steele et al. 2014).
std::uint64_t hash(const Point& p) {
  std::uint64_t h = 0;
  for (const double x : p) {
    h = (h ^ std::bit_cast<std::uint64_t>(x)) * 0xbf58476d1ce4e5b9u;
    h ^= h >> 31;
  }
  h *= 0x94d049bb133111ebu;
  return h ^ h >> 31;
}

}  // namespace

std::size_t PointIndex::slot_of(const Point& p, const std::vector<Point>& positions) const {
  const std::size_t mask = slots_.size() - 1;
  std::size_t slot = hash(p) & mask;
  while (slots_[slot] != 0 && positions[slots_[slot] - 1] != p) slot = (slot + 1) & mask;
  return slot;
}

void PointIndex::grow(const std::vector<Point>& positions) {
  slots_.assign(2 * slots_.size(), 0);
  for (std::size_t v = 0; v < used_; ++v)
    slots_[slot_of(positions[v], positions)] = static_cast<std::uint32_t>(v + 1);
}

std::uint32_t PointIndex::find_or_add(const Point& p, const std::vector<Point>& positions) {
  if (2 * (used_ + 1) > slots_.size()) grow(positions);
  const std::size_t slot = slot_of(p, positions);
  if (slots_[slot] != 0) return slots_[slot] - 1;
  slots_[slot] = static_cast<std::uint32_t>(++used_);
  return static_cast<std::uint32_t>(used_ - 1);
}

std::vector<std::uint32_t> lowest_in_place(std::span<const Point> positions) {
  std::vector<std::uint32_t> lowest(positions.size());
  std::vector<std::uint32_t> slots(std::bit_ceil(2 * positions.size() + 2), 0);  // vertex + 1, or 0
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    Point p = positions[v];
    for (double& x : p) x += 0.0;  // -0 becomes 0
    std::size_t slot = hash(p) & (slots.size() - 1);
    while (slots[slot] != 0 && positions[slots[slot] - 1] != p) slot = (slot + 1) & (slots.size() - 1);
    if (slots[slot] == 0) slots[slot] = v + 1;
    lowest[v] = slots[slot] - 1;
  }
  return lowest;
}

}  // namespace viete::mesh
