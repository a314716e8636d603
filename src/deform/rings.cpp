#include "deform/rings.h"

#include <algorithm>
#include <array>

#include "mesh/normals.h"
#include "mesh/triangle.h"

namespace viete::deform {

namespace {

using Step = std::array<std::uint32_t, 2>;  // a triangle seen from one of its corners: the other two

constexpr std::size_t crowd =
    60;  // triangles around a hub; 512 vertices with fewer have halves of places for 16 bits

// The steps around a vertex, in an order in which they hang together as far as they can.
class Walker {
public:
  void add(const Step& step) { steps_.push_back(step); }
  std::size_t size() const { return steps_.size(); }

  // Takes the steps.
  void walk(std::uint32_t self, std::vector<std::uint32_t>& out) {
    out.clear();
    while (!steps_.empty()) {
      if (!out.empty()) out.push_back(self);
      Step step = take(start());
      out.insert(out.end(), step.begin(), step.end());
      for (std::size_t next; (next = leaving(step[1])) < steps_.size();) {
        step = take(next);
        out.push_back(step[1]);
      }
    }
  }

  // The same without order, where ordering would take too long.
  void walk_each(std::uint32_t self, std::vector<std::uint32_t>& out) {
    out.clear();
    for (const Step& step : steps_) out.insert(out.end(), {step[0], step[1], self});
    steps_.clear();
  }

private:
  Step take(std::size_t index) {
    const Step step = steps_[index];
    steps_.erase(steps_.begin() + static_cast<std::ptrdiff_t>(index));
    return step;
  }

  std::size_t leaving(std::uint32_t corner) const {
    std::size_t i = 0;
    while (i < steps_.size() && steps_[i][0] != corner) ++i;
    return i;
  }

  // A step that no other leads to, where a fan begins; any one of a closed ring.
  std::size_t start() const {
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      std::size_t j = 0;
      while (j < steps_.size() && steps_[j][1] != steps_[i][0]) ++j;
      if (j == steps_.size()) return i;
    }
    return 0;
  }

  std::vector<Step> steps_;
};

class Builder {
public:
  Builder(const Leaves& leaves, std::span<const mesh::Triangle> triangles)
      : leaves_(leaves),
        triangles_(triangles),
        around_(mesh::vertex_triangles(leaves.vertices, triangles)),
        slot_of_(leaves.vertices),
        local_(leaves.slot_count(), outside) {
    for (std::uint32_t s = 0; s < leaves.vertices; ++s) slot_of_[leaves.order[s]] = s;
  }

  Rings build() {
    rings_.walk.reserve(3 * triangles_.size() + leaves_.vertices);
    rings_.places.push_back(0);
    rings_.walk_starts.push_back(0);
    for (std::size_t leaf = 0; leaf < leaves_.count(); ++leaf) add_leaf(leaf);
    slots_to_places();
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
      walker_.add({slot_of_[t[(corner + 1) % 3]], slot_of_[t[(corner + 2) % 3]]});
    }
  }

  // Number of a slot among the leaf's places, a new one of the halo if it is seen for the first time.
  std::uint32_t local(std::uint32_t slot, std::size_t begin, std::size_t end) {
    if (slot >= begin && slot < end) return static_cast<std::uint32_t>(slot - begin);
    if (local_[slot] == outside) {
      local_[slot] = static_cast<std::uint32_t>(end - begin + rings_.halo.size() - halo_begin_);
      rings_.halo.push_back(slot);
    }
    return local_[slot];
  }

  void add_leaf(std::size_t leaf) {
    const std::size_t begin = leaves_.begin(leaf), end = leaves_.end(leaf);
    halo_begin_ = rings_.halo.size();
    for (std::size_t s = begin; s < end; s += ring_group) add_group(s, begin, end);
    for (std::size_t i = halo_begin_; i < rings_.halo.size(); ++i) local_[rings_.halo[i]] = outside;
    while (rings_.halo.size() % ring_group) rings_.halo.push_back(rings_.halo.back());
    rings_.places.push_back(static_cast<std::uint32_t>(end + rings_.halo.size()));
    rings_.walk_starts.push_back(static_cast<std::uint32_t>(rings_.walk.size()));
  }

  void add_group(std::size_t first, std::size_t begin, std::size_t end) {
    std::size_t longest = 0;
    for (std::size_t k = 0; k < ring_group; ++k) {
      make_walk(static_cast<std::uint32_t>(first + k), walks_[k]);
      longest = std::max(longest, walks_[k].size());
    }
    const bool closed = are_rings();
    const std::size_t length = closed ? longest - 1 : longest | 1;
    for (std::size_t i = 0; i < length; ++i) {
      for (std::size_t k = 0; k < ring_group; ++k) {
        const auto self = static_cast<std::uint32_t>(first + k);
        const std::uint32_t place = local(i < walks_[k].size() ? walks_[k][i] : self, begin, end);
        rings_.walk.push_back(static_cast<std::uint16_t>(4 / walk_floats * place));
      }
    }
    rings_.lengths.push_back(static_cast<std::uint16_t>(length + (closed ? closed_ring : 0)));
  }

  // Of the same length and ending where they began.
  bool are_rings() const {
    const std::size_t size = walks_[0].size();
    return size > 2 && std::all_of(walks_.begin(), walks_.end(), [=](const auto& walk) {
             return walk.size() == size && walk.front() == walk.back();
           });
  }

  void make_walk(std::uint32_t slot, std::vector<std::uint32_t>& walk) {
    walk.clear();
    if (slot >= leaves_.vertices) return;
    collect(slot);
    if (walker_.size() <= crowd) return walker_.walk(slot, walk);
    rings_.hubs.push_back({slot, 0, {}});
    auto& around = rings_.hubs.back().walk;
    walker_.walk_each(slot, around);
    if (around.size() % 2 == 0) around.push_back(slot);
  }

  std::uint32_t place_of(std::uint32_t slot) const {
    const std::size_t leaf = slot / leaf_slots;
    return static_cast<std::uint32_t>(rings_.places[leaf] + slot - leaves_.begin(leaf));
  }

  void slots_to_places() {
    for (auto& slot : rings_.halo) slot = place_of(slot);
    for (auto& hub : rings_.hubs) {
      hub.place = place_of(hub.slot);
      for (auto& slot : hub.walk) slot = place_of(slot);
    }
  }

  const Leaves& leaves_;
  std::span<const mesh::Triangle> triangles_;
  mesh::Adjacency around_;
  std::vector<std::uint32_t> slot_of_, local_;
  std::array<std::vector<std::uint32_t>, ring_group> walks_;
  std::size_t halo_begin_ = 0;
  Walker walker_;
  Rings rings_;
};

}  // namespace

std::size_t Rings::bytes() const {
  return sizeof(std::uint32_t) * (places.size() + halo.size() + walk_starts.size()) +
         sizeof(std::uint16_t) * (walk.size() + lengths.size());
}

Rings make_rings(const Leaves& leaves, std::span<const mesh::Triangle> triangles) {
  return Builder(leaves, triangles).build();
}

}  // namespace viete::deform
