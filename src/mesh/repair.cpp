#include "mesh/repair.h"

#include <algorithm>
#include <utility>

#include "mesh/half_edges.h"
#include "mesh/point_index.h"

namespace viete::mesh {

namespace {

struct Neighbour {
  std::uint32_t triangle;
  bool agrees;
};

// Across edges of exactly two triangles: at most three each.
std::vector<std::vector<Neighbour>> neighbours(const Surface& surface) {
  std::vector<std::vector<Neighbour>> all(surface.triangles.size());
  const HalfEdges table = half_edges(surface.positions.size(), surface.triangles);
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto sides = table.of(e);
    if (sides.size() != 2) continue;
    const bool agrees = sides[0].forward != sides[1].forward;
    all[sides[0].triangle].push_back({sides[1].triangle, agrees});
    all[sides[1].triangle].push_back({sides[0].triangle, agrees});
  }
  return all;
}

class Orienter {
public:
  explicit Orienter(const Surface& surface)
      : neighbours_(neighbours(surface)), side_(surface.triangles.size(), unseen) {}

  // Whether each triangle is to be turned.
  std::vector<std::uint8_t> turned() {
    std::vector<std::uint8_t> turn(side_.size(), 0);
    for (std::uint32_t seed = 0; seed < side_.size(); ++seed) {
      if (side_[seed] != unseen || !reach(seed)) continue;
      const auto others = std::count_if(part_.begin(), part_.end(), [&](auto t) { return side_[t] == 1; });
      const std::uint8_t minority = 2 * static_cast<std::size_t>(others) > part_.size() ? 0 : 1;
      for (const auto t : part_) turn[t] = side_[t] == minority;
    }
    return turn;
  }

private:
  static constexpr std::uint8_t unseen = 2;

  // All that is connected with the seed; false if two ways around disagree.
  bool reach(std::uint32_t seed) {
    bool agree = true;
    part_.assign(1, seed);
    side_[seed] = 0;
    for (std::size_t i = 0; i < part_.size(); ++i) {
      for (const auto& [next, agrees] : neighbours_[part_[i]]) {
        const std::uint8_t side = agrees ? side_[part_[i]] : 1 - side_[part_[i]];
        if (side_[next] == unseen) {
          side_[next] = side;
          part_.push_back(next);
        }
        agree &= side_[next] == side;
      }
    }
    return agree;
  }

  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<std::uint8_t> side_;  // 0 as the seed of its part, 1 opposite
  std::vector<std::uint32_t> part_;
};

}  // namespace

std::vector<std::uint32_t> lowest_in_place(std::span<const Point> positions) {
  std::vector<std::uint32_t> lowest(positions.size()), first;
  std::vector<Point> distinct;
  PointIndex index;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    Point p = positions[v];
    for (double& x : p) x += 0.0;  // -0 becomes 0, which it equals
    const auto found = index.find_or_add(p, distinct);
    if (found == distinct.size()) {
      distinct.push_back(p);
      first.push_back(v);
    }
    lowest[v] = first[found];
  }
  return lowest;
}

Surface welded(const Surface& surface) {
  const auto lowest = lowest_in_place(surface.positions);
  Surface result = surface;
  for (auto& v : result.corners) v = lowest[v];
  for (Triangle& t : result.triangles) {
    for (auto& v : t) v = lowest[v];
  }
  return result;
}

Surface consistently_oriented(const Surface& surface) {
  const auto turned = Orienter(surface).turned();
  std::vector<Triangle> triangles = surface.triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (turned[t]) std::swap(triangles[t][1], triangles[t][2]);
  }
  return from_triangles(surface.positions, triangles);
}

}  // namespace viete::mesh
