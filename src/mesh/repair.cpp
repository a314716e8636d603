#include "mesh/repair.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include "mesh/half_edges.h"
#include "mesh/point_index.h"
#include "mesh/summary.h"
#include "mesh/triangle_tree.h"

namespace viete::mesh {

namespace {

struct Neighbour {
  std::uint32_t triangle;
  bool agrees;  // true if both triangles have the same orientation
};

// Returns the neighbours of each triangle, only across edges that have exactly two triangles.
std::vector<std::vector<Neighbour>> neighbours(const Surface& surface) {
  std::vector<std::vector<Neighbour>> all(surface.triangles.size());
  const HalfEdges table = half_edges(surface.positions.size(), surface.triangles);
  for_inner_edges(table, [&](std::size_t, const HalfEdge& s, const HalfEdge& t) {
    all[s.triangle].push_back({t.triangle, s.forward != t.forward});
    all[t.triangle].push_back({s.triangle, s.forward != t.forward});
  });
  return all;
}

class Orienter {
public:
  explicit Orienter(const Surface& surface)
      : neighbours_(neighbours(surface)), side_(surface.triangles.size(), unseen) {}

  // Returns 1 for each triangle that must be flipped, and 0 for each other triangle.
  std::vector<std::uint8_t> turned() {
    std::vector<std::uint8_t> turn(side_.size(), 0);
    for (std::uint32_t seed = 0; seed < side_.size(); ++seed) {
      if (side_[seed] != unseen) continue;
      const bool can_agree = reach(seed);
      parts_.push_back(part_);
      agree_ &= can_agree;
      if (!can_agree) continue;
      const auto others = std::count_if(part_.begin(), part_.end(), [&](auto t) { return side_[t] == 1; });
      const std::uint8_t minority = 2 * static_cast<std::size_t>(others) > part_.size() ? 0 : 1;
      for (const auto t : part_) turn[t] = side_[t] == minority;
    }
    return turn;
  }

  // The triangles of each component. Valid after turned().
  const std::vector<std::vector<std::uint32_t>>& parts() const { return parts_; }
  bool agree() const { return agree_; }  // true if all components are orientable; valid after turned()

private:
  static constexpr std::uint8_t unseen = 2;

  // Visits the component that contains the seed. If the component is not orientable, returns false.
  bool reach(std::uint32_t seed) {
    bool agree = true;
    part_.assign(1, seed);
    side_[seed] = 0;
    for (std::size_t i = 0; i < part_.size(); ++i)
      for (const auto& [next, agrees] : neighbours_[part_[i]]) {
        const std::uint8_t side = agrees ? side_[part_[i]] : 1 - side_[part_[i]];
        if (side_[next] == unseen) {
          side_[next] = side;
          part_.push_back(next);
        }
        agree &= side_[next] == side;
      }
    return agree;
  }

  std::vector<std::vector<Neighbour>> neighbours_;
  std::vector<std::uint8_t> side_;  // 0: orientation of the component's seed; 1: opposite; 2: unseen
  std::vector<std::uint32_t> part_;
  std::vector<std::vector<std::uint32_t>> parts_;
  bool agree_ = true;
};

void turn(Triangle& t) {
  std::swap(t[1], t[2]);
}

Surface part_of(const Surface& whole, std::span<const std::uint32_t> triangles) {
  return from_triangles(whole.positions, picked<Triangle>(whole.triangles, triangles));
}

// True if each edge is used equally often in both directions. If `open_too` is false, ignores boundary edges.
bool balanced(const Surface& surface, bool open_too) {
  const HalfEdges table = half_edges(surface.positions.size(), surface.triangles);
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto sides = table.of(e);
    const auto ahead = static_cast<std::size_t>(std::ranges::count_if(sides, &HalfEdge::forward));
    if (2 * ahead != sides.size() && (open_too || sides.size() > 1)) return false;
  }
  return true;
}

// Orients closed components: outward if an even number of other closed components contain the component,
// otherwise inward. If all closed components would be reversed, does nothing.
void turn_parts(Surface& joined, const std::vector<std::vector<std::uint32_t>>& parts) {
  struct Part {
    Surface surface;
    const std::vector<std::uint32_t>* triangles;
    bool outward, as_it_should_be;
  };
  std::vector<Part> closed;
  for (const auto& triangles : parts) {
    Surface part = part_of(joined, triangles);
    if (!balanced(part, true)) continue;
    const double volume = summarize(part).volume;
    if (volume != 0) closed.push_back({std::move(part), &triangles, volume > 0, true});
  }
  for (Part& part : closed) {
    const Point at = joined.positions[part.surface.triangles.front()[0]];
    int around = 0;
    for (const Part& other : closed)
      around += &other != &part && std::abs(winding_number(other.surface, at)) > 0.5;
    part.as_it_should_be = part.outward == (around % 2 == 0);
  }
  const auto right = [](const Part& part) { return part.as_it_should_be; };
  if (std::ranges::none_of(closed, right)) return;
  for (const Part& part : closed) {
    if (!right(part))
      for (const auto t : *part.triangles) turn(joined.triangles[t]);
  }
}

}  // namespace

Surface welded(const Surface& surface) {
  const auto lowest = lowest_in_place(surface.positions);
  Surface result = surface;
  for (auto& v : result.corners) v = lowest[v];
  for (Triangle& t : result.triangles) {
    for (auto& v : t) v = lowest[v];
  }
  return result;
}

std::vector<std::uint8_t> repeated_polygons(const Surface& surface, bool reversed) {
  const Surface joined = welded(surface);
  std::set<std::vector<std::uint32_t>> seen;  // corners from the lowest index
  std::vector<std::uint8_t> repeated;
  for (std::size_t p = 0; p < joined.polygon_count(); ++p) {
    const auto corners = joined.polygon(p);
    std::vector<std::uint32_t> own(corners.begin(), corners.end());
    std::ranges::rotate(own, std::ranges::min_element(own));
    std::vector<std::uint32_t> other = own;
    if (reversed) std::reverse(other.begin() + 1, other.end());
    repeated.push_back(seen.contains(other));
    seen.insert(std::move(own));
  }
  return repeated;
}

Surface consistently_oriented(const Surface& surface) {
  const auto turned = Orienter(surface).turned();
  std::vector<Triangle> triangles = surface.triangles;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (turned[t]) turn(triangles[t]);
  }
  return from_triangles(surface.positions, triangles);
}

OneSided one_sided(const Surface& surface) {
  Surface joined = welded(surface);
  const auto is_back = repeated_polygons(joined, true);
  std::vector<std::uint32_t> kept;
  for (std::uint32_t t = 0; t < surface.triangles.size(); ++t) {
    const bool of_polygon = t < surface.triangle_polygon.size();
    if (!of_polygon || !is_back[surface.triangle_polygon[t]]) kept.push_back(t);
  }
  Surface front = part_of(joined, kept);
  Orienter orienter(front);
  const auto turned = orienter.turned();
  for (std::size_t t = 0; t < kept.size(); ++t) {
    if (turned[t]) turn(front.triangles[t]);
  }
  if (!orienter.agree() || !balanced(front, false)) return {};
  turn_parts(front, orienter.parts());
  OneSided result{{}, {}, balanced(front, true)};
  for (std::size_t t = 0; t < kept.size(); ++t) {
    Triangle own = surface.triangles[kept[t]];
    if (front.triangles[t] != joined.triangles[kept[t]]) turn(own);
    result.triangles.push_back(own);
  }
  result.of = std::move(kept);
  return result;
}

}  // namespace viete::mesh
