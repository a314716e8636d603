#include "mesh/repair.h"

#include <algorithm>
#include <array>
#include <tuple>
#include <utility>

#include "mesh/point_index.h"

namespace viete::mesh {

namespace {

struct Side {
  std::uint32_t low, high, triangle;
  bool forward;  // the triangle runs from low to high

  bool same_edge(const Side& other) const { return low == other.low && high == other.high; }
};

std::vector<Side> sorted_sides(const Surface& surface) {
  std::vector<Side> sides;
  sides.reserve(3 * surface.triangles.size());
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const Triangle& corners = surface.triangles[t];
    if (repeats_corner(corners)) continue;
    for (int i = 0; i < 3; ++i) {
      const auto a = corners[i], b = corners[(i + 1) % 3];
      sides.push_back({std::min(a, b), std::max(a, b), t, a < b});
    }
  }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return sides;
}

struct Neighbour {
  std::uint32_t triangle;
  bool agrees;
};

// Across edges of exactly two triangles: at most three each.
std::vector<std::vector<Neighbour>> neighbours(const Surface& surface) {
  std::vector<std::vector<Neighbour>> all(surface.triangles.size());
  const auto sides = sorted_sides(surface);
  for (std::size_t i = 0, j = 0; i < sides.size(); i = j) {
    while (j < sides.size() && sides[j].same_edge(sides[i])) ++j;
    if (j - i != 2) continue;
    const Side &a = sides[i], &b = sides[i + 1];
    all[a.triangle].push_back({b.triangle, a.forward != b.forward});
    all[b.triangle].push_back({a.triangle, a.forward != b.forward});
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

Surface welded(const Surface& surface) {
  std::vector<std::uint32_t> lowest(surface.positions.size()), first;
  std::vector<Point> places;
  PointIndex index;
  for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
    Point p = surface.positions[v];
    for (double& x : p) x += 0.0;  // -0 is at the place of 0
    const auto place = index.find_or_add(p, places);
    if (place == places.size()) {
      places.push_back(p);
      first.push_back(v);
    }
    lowest[v] = first[place];
  }
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
