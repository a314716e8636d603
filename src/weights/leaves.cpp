#include "weights/leaves.h"

#include <algorithm>
#include <array>
#include <utility>

#include "mesh/normals.h"
#include "mesh/triangle.h"

namespace viete::weights {

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
  leaves.order = mesh::first_numbers(positions.size());
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

namespace {

using Opposite = std::array<std::uint32_t, 2>;  // the edge opposite to a vertex in a triangle

// The largest numbers of triangles and neighbours of a vertex in a group. With these limits, a leaf has at
// most 512 * (1 + 63) = 2^15 positions, so 16 bits are enough for index * 4 / index_floats = 2 * index. One
// fan of 60 triangles has 61 neighbours; several fans have more.
constexpr std::size_t most_valence = 60, most_neighbours = 63;

// Collects the opposite edges around a vertex and orders them into fans of triangles.
class Fans {
public:
  void add(const Opposite& edge) { edges_.push_back(edge); }
  std::size_t size() const { return edges_.size(); }

  // Writes the vertices along the fans to `out`, with `self` between fans. Removes all edges.
  void chain(std::uint32_t self, std::vector<std::uint32_t>& out) {
    out.clear();
    while (!edges_.empty()) {
      if (!out.empty()) out.push_back(self);
      Opposite edge = take(start());
      out.insert(out.end(), edge.begin(), edge.end());
      for (std::size_t next; (next = leaving(edge[1])) < edges_.size();) {
        edge = take(next);
        out.push_back(edge[1]);
      }
    }
  }

  // Like chain(), but makes each triangle a separate fan. Takes linear instead of quadratic time.
  void list(std::uint32_t self, std::vector<std::uint32_t>& out) {
    out.clear();
    for (const Opposite& edge : edges_) out.insert(out.end(), {edge[0], edge[1], self});
    edges_.clear();
  }

private:
  Opposite take(std::size_t index) {
    const Opposite edge = edges_[index];
    edges_.erase(edges_.begin() + static_cast<std::ptrdiff_t>(index));
    return edge;
  }

  std::size_t leaving(std::uint32_t corner) const {
    std::size_t i = 0;
    while (i < edges_.size() && edges_[i][0] != corner) ++i;
    return i;
  }

  // Returns the index of the first edge of an open fan, or 0 if all fans are closed.
  std::size_t start() const {
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      std::size_t j = 0;
      while (j < edges_.size() && edges_[j][1] != edges_[i][0]) ++j;
      if (j == edges_.size()) return i;
    }
    return 0;
  }

  std::vector<Opposite> edges_;
};

class Builder {
public:
  Builder(const Leaves& leaves, std::span<const mesh::Triangle> triangles)
      : leaves_(leaves),
        triangles_(triangles),
        around_(mesh::vertex_triangles(leaves.vertices, triangles)),
        slot_of_(slots_of(leaves)),
        local_(leaves.slot_count(), outside) {}

  Rings build() {
    rings_.neighbours.reserve(3 * triangles_.size() + leaves_.vertices);
    rings_.position_starts.push_back(0);
    rings_.neighbour_starts.push_back(0);
    for (std::size_t leaf = 0; leaf < leaves_.count(); ++leaf) add_leaf(leaf);
    slots_to_positions();
    return std::move(rings_);
  }

private:
  static constexpr std::uint32_t outside = ~0u;

  void collect(std::uint32_t slot) {
    const std::uint32_t vertex = leaves_.order[slot];
    for (const std::uint32_t i : around_.of(vertex)) {
      const mesh::Triangle& t = triangles_[i];
      if (mesh::repeats_corner(t)) continue;
      const int corner = t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
      fans_.add({slot_of_[t[(corner + 1) % 3]], slot_of_[t[(corner + 2) % 3]]});
    }
  }

  // Returns the index of a slot among the leaf's positions. A slot of another leaf becomes a ghost.
  std::uint32_t local(std::uint32_t slot, std::size_t begin, std::size_t end) {
    if (slot >= begin && slot < end) return static_cast<std::uint32_t>(slot - begin);
    if (local_[slot] == outside) {
      local_[slot] = static_cast<std::uint32_t>(end - begin + rings_.ghosts.size() - ghost_begin_);
      rings_.ghosts.push_back(slot);
    }
    return local_[slot];
  }

  void add_leaf(std::size_t leaf) {
    const std::size_t begin = leaves_.begin(leaf), end = leaves_.end(leaf);
    ghost_begin_ = rings_.ghosts.size();
    for (std::size_t s = begin; s < end; s += ring_group) add_group(s, begin, end);
    for (std::size_t i = ghost_begin_; i < rings_.ghosts.size(); ++i) local_[rings_.ghosts[i]] = outside;
    while (rings_.ghosts.size() % ring_group) rings_.ghosts.push_back(rings_.ghosts.back());
    rings_.position_starts.push_back(static_cast<std::uint32_t>(end + rings_.ghosts.size()));
    rings_.neighbour_starts.push_back(static_cast<std::uint32_t>(rings_.neighbours.size()));
  }

  void add_group(std::size_t first, std::size_t begin, std::size_t end) {
    std::size_t longest = 0;
    for (std::size_t k = 0; k < ring_group; ++k) {
      order_neighbours(static_cast<std::uint32_t>(first + k), around_slot_[k]);
      longest = std::max(longest, around_slot_[k].size());
    }
    const bool closed = are_closed();
    const std::size_t length = closed ? longest - 1 : longest | 1;
    for (std::size_t i = 0; i < length; ++i)
      for (std::size_t k = 0; k < ring_group; ++k) {
        const auto self = static_cast<std::uint32_t>(first + k);
        const std::uint32_t index = local(i < around_slot_[k].size() ? around_slot_[k][i] : self, begin, end);
        rings_.neighbours.push_back(static_cast<std::uint16_t>(4 / index_floats * index));
      }
    rings_.lengths.push_back(static_cast<std::uint16_t>(length + (closed ? closed_ring : 0)));
  }

  // Returns true if all rings are closed and have equal lengths.
  bool are_closed() const {
    const std::size_t size = around_slot_[0].size();
    return size > 2 && std::all_of(around_slot_.begin(), around_slot_.end(), [=](const auto& around) {
             return around.size() == size && around.front() == around.back();
           });
  }

  void order_neighbours(std::uint32_t slot, std::vector<std::uint32_t>& out) {
    out.clear();
    if (slot >= leaves_.vertices) return;
    collect(slot);
    fans_.size() <= most_valence ? fans_.chain(slot, out) : fans_.list(slot, out);
    const auto gaps = static_cast<std::size_t>(std::ranges::count(out, slot));
    if (out.size() - gaps <= most_neighbours) return;
    if (out.size() % 2 == 0) out.push_back(slot);
    rings_.high_valence.push_back({slot, 0, std::exchange(out, {})});
  }

  std::uint32_t position_of(std::uint32_t slot) const {
    const std::size_t leaf = slot / leaf_slots;
    return static_cast<std::uint32_t>(rings_.position_starts[leaf] + slot - leaves_.begin(leaf));
  }

  void slots_to_positions() {
    for (auto& slot : rings_.ghosts) slot = position_of(slot);
    for (auto& vertex : rings_.high_valence) {
      vertex.position = position_of(vertex.slot);
      for (auto& slot : vertex.neighbours) slot = position_of(slot);
    }
  }

  const Leaves& leaves_;
  std::span<const mesh::Triangle> triangles_;
  mesh::Adjacency around_;
  std::vector<std::uint32_t> slot_of_, local_;
  std::array<std::vector<std::uint32_t>, ring_group> around_slot_;
  std::size_t ghost_begin_ = 0;
  Fans fans_;
  Rings rings_;
};

}  // namespace

Rings make_rings(const Leaves& leaves, std::span<const mesh::Triangle> triangles) {
  return Builder(leaves, triangles).build();
}

}  // namespace viete::weights
