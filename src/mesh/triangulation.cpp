#include "mesh/triangulation.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <functional>
#include <queue>

#include "base/worker_pool.h"
#include "mesh/adjacency.h"
#include "mesh/triangle.h"

namespace viete::mesh {

namespace {

// Smaller areas can be rounding errors and count as 0. Areas are doubled and divided by length^2. The length
// is the extent of the polygon or, for a triangle of the fan, its longer side at the fan's corner.
constexpr double flat_fan = 1e-12;
// A triangle is thin if its height is less than this multiple of its longest edge.
constexpr double thin = 2e-3;

// The triangles around the first corner of a polygon. Lengths are relative to the extent of the polygon.
class Fan {
public:
  explicit Fan(std::span<const Point> corners) : corners_(corners) {
    double extent = 0;
    for (const Point& p : corners) extent = std::max(extent, largest_abs(p - corners[0]));
    scale_ = 1 / extent;
    for (std::size_t i = 2; i < corners.size(); ++i) normal_ = normal_ + cross(spoke(i - 1), spoke(i));
  }

  // Returns the polygon's normal. The normal's length is 2 * area / extent^2.
  const Vec3& normal() const { return normal_; }

  // Returns the least (doubled area) / length^2 of the triangles, negative if one is reversed. Returns 1 for
  // a polygon without area.
  double least_area() const {
    const double size = norm(normal_);
    double least = 1;
    for (std::size_t i = 2; size > flat_fan && i < corners_.size(); ++i) {
      const Vec3 a = spoke(i - 1), b = spoke(i);
      const double square = std::max(squared_norm(a), squared_norm(b));
      least = std::min(least, square > 0 ? dot(cross(a, b), normal_) / (size * square) : 0);
    }
    return least;
  }

private:
  Vec3 spoke(std::size_t i) const { return scale_ * (corners_[i] - corners_[0]); }

  std::span<const Point> corners_;
  double scale_;
  Vec3 normal_{0, 0, 0};
};

// Scales the points by a power of two, without rounding, so that products of three coordinates are in range.
std::vector<Point> in_range(std::span<const Point> corners) {
  double largest = 0;
  for (const Point& p : corners) largest = std::max(largest, largest_abs(p));
  const double unit = std::exp2(-std::max(std::ilogb(largest), -1000));
  std::vector<Point> points;
  for (const Point& p : corners) points.push_back(unit * p);
  return points;
}

// Projects the points onto a plane perpendicular to the normal, with rounding errors.
std::vector<Point2> places_across(const Vec3& normal, std::span<const Point> points) {
  Vec3 axis{0, 0, 0};
  std::size_t least = 0;
  for (std::size_t k = 1; k < 3; ++k) least = std::abs(normal[k]) < std::abs(normal[least]) ? k : least;
  axis[least] = 1;
  const Vec3 across = cross(axis, normal), u = (1 / norm(across)) * across, v = cross(normal, u);
  std::vector<Point2> places;
  for (const Point& p : points) places.push_back({dot(u, p - points[0]), dot(v, p - points[0])});
  return places;
}

double squared_distance(const Point2& a, const Point2& b) {
  return (a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]);
}

struct Box2 {
  Point2 low, high;

  bool holds(const Point2& p) const {
    return p[0] >= low[0] && p[0] <= high[0] && p[1] >= low[1] && p[1] <= high[1];
  }
};

Box2 box_of(std::span<const Point2> places) {
  Box2 box{places[0], places[0]};
  for (const Point2& p : places)
    for (std::size_t k = 0; k < 2; ++k) {
      box.low[k] = std::min(box.low[k], p[k]);
      box.high[k] = std::max(box.high[k], p[k]);
    }
  return box;
}

// A uniform grid of points.
class Cells {
public:
  explicit Cells(std::span<const Point2> places)
      : box_(box_of(places)), side_(std::ceil(std::sqrt(static_cast<double>(places.size())))) {
    const auto side = static_cast<std::size_t>(side_);
    lists_ = make_adjacency(side * side, [&](const auto& add) {
      for (std::uint32_t i = 0; i < places.size(); ++i)
        add(static_cast<std::uint32_t>(cell(places[i], 0) + side * cell(places[i], 1)), i);
    });
  }

  // True if is_one(i) is true for a point i in one of the cells that overlap the box.
  template <class IsOne>
  bool any(const Box2& box, const IsOne& is_one) const {
    for (std::size_t y = cell(box.low, 1); y <= cell(box.high, 1); ++y)
      for (std::size_t x = cell(box.low, 0); x <= cell(box.high, 0); ++x) {
        const auto list = lists_.of(x + static_cast<std::size_t>(side_) * y);
        if (std::ranges::any_of(list, is_one)) return true;
      }
    return false;
  }

private:
  std::size_t cell(const Point2& p, std::size_t axis) const {
    const double extent = box_.high[axis] - box_.low[axis];
    const double at = extent > 0 ? side_ * (p[axis] - box_.low[axis]) / extent : 0;
    return static_cast<std::size_t>(std::clamp(at, 0.0, side_ - 1));
  }

  Box2 box_;
  double side_;  // the number of cells along each axis
  Adjacency lists_;
};

// The kinds of ears, in order of preference. `clear`: no other corner is in the ear or on its boundary.
// `touched`: other corners are only on the boundary. `thin`: the ear is thin. `flat`: the ear has no area.
enum class Ears { clear, touched, thin, flat };

// Clips ears from a ring of corners until two corners are left. A ring that does not cross itself always has
// an ear, because the tests are exact.
class EarClipper {
public:
  EarClipper(std::span<const Point> corners, const Vec3& normal)
      : normal_((1 / norm(normal)) * normal),
        points_(in_range(corners)),
        places_(places_across(normal_, points_)),
        cells_(places_),
        previous_(corners.size()),
        next_(corners.size()),
        turns_(corners.size()),
        left_(corners.size()) {
    const Box2 box = box_of(places_);
    slack_ = 1e-9 * std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
    for (std::uint32_t i = 0; i < left_; ++i) {
      next_[i] = i + 1 < left_ ? i + 1 : 0;
      previous_[next_[i]] = i;
      size_ += squared_distance(places_[i], places_[next_[i]]);
    }
    for (std::uint32_t i = 0; i < left_; ++i) turns_[i] = turn(previous_[i], i, next_[i]);
  }

  std::vector<Triangle> cut() {
    for (Ears kind = Ears::clear; left_ > 2;) {
      if (looked_at_ > patience_ * points_.size() + 1000) {
        clip(next_[first_]);
      } else if (clip_all(kind)) {
        kind = Ears::clear;
      } else if (kind == Ears::flat) {
        clip(thinnest());
        kind = Ears::clear;
      } else {
        kind = static_cast<Ears>(static_cast<int>(kind) + 1);
      }
    }
    std::ranges::sort(triangles_);
    return std::move(triangles_);
  }

private:
  // A corner and its neighbours in the ring. Ears are clipped in the order of `length`, then `rank`.
  struct Ear {
    long length;                                 // see length_of_cut()
    std::uint32_t rank, corner, previous, next;  // rank: the number of corners to the polygon's first corner
    auto operator<=>(const Ear&) const = default;
  };
  // After this number of tests per corner, the rest of a self-crossing ring becomes a fan.
  static constexpr std::size_t patience_ = 16;

  int turn(std::uint32_t a, std::uint32_t b, std::uint32_t c) const {
    return orientation_along(normal_, points_[a], points_[b], points_[c]);
  }

  // Returns the rounded logarithm of a cut's length, so that nearly equal lengths become equal.
  long length_of_cut(std::uint32_t a, std::uint32_t b) const {
    return std::lround(64 * std::log2(std::max(squared_distance(places_[a], places_[b]) / size_, 0x1p-200)));
  }

  bool clip_all(Ears kind) {
    for (auto i = next_[first_], n = static_cast<std::uint32_t>(left_); n > 0; i = next_[i], --n)
      look_at(i, kind);
    bool any = false;
    while (!ears_.empty() && left_ > 2) {
      const Ear ear = ears_.top();
      ears_.pop();
      if (previous_[ear.corner] != ear.previous || next_[ear.corner] != ear.next) continue;
      clip(ear.corner);
      look_at(ear.previous, kind);
      look_at(ear.next, kind);
      any = true;
    }
    return any;
  }

  void look_at(std::uint32_t i, Ears kind) {
    ++looked_at_;
    const auto n = static_cast<std::uint32_t>(points_.size());
    if (is_ear(i, kind))
      ears_.push({length_of_cut(previous_[i], next_[i]), std::min(i, n - i), i, previous_[i], next_[i]});
  }

  bool is_ear(std::uint32_t i, Ears kind) const {
    const Triangle ear{previous_[i], i, next_[i]};
    if (points_[i] == points_[ear[0]] || points_[i] == points_[ear[2]]) return true;
    if (turns_[i] <= 0) return turns_[i] == 0 && kind == Ears::flat;
    if (kind < Ears::thin && is_thin(ear)) return false;
    Box2 box = box_of(std::array{places_[ear[0]], places_[ear[1]], places_[ear[2]]});
    for (std::size_t k = 0; k < 2; ++k) {
      box.low[k] -= slack_;
      box.high[k] += slack_;
    }
    return !cells_.any(box, [&](std::uint32_t other) {
      return turns_[other] <= 0 && box.holds(places_[other]) && spoils(other, ear, kind);
    });
  }

  // True if `corner` prevents clipping the ear: a corner inside, a corner on the boundary of a clear ear, or
  // a corner from which a side of the ring enters the ear.
  bool spoils(std::uint32_t corner, const Triangle& ear, Ears kind) const {
    std::array<int, 3> sides;
    for (std::size_t k = 0; k < 3; ++k) {
      sides[k] = turn(ear[k], ear[(k + 1) % 3], corner);
      if (sides[k] < 0) return false;
    }
    if (kind == Ears::clear && std::ranges::count(sides, 0) < 2) return true;
    // A reflex corner at the ear's tip is the tip of a notch in the polygon. This notch can fill the ear.
    if (kind != Ears::flat && sides[0] == 0 && sides[1] == 0 && turns_[corner] < 0) return true;
    return leads_into(ear, sides, previous_[corner]) || leads_into(ear, sides, next_[corner]);
  }

  // Returns twice the area of a triangle.
  double area(const Triangle& t) const {
    const Point2 &a = places_[t[0]], &b = places_[t[1]], &c = places_[t[2]];
    return std::abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]));
  }

  bool is_thin(const Triangle& t) const {
    const Point2 &a = places_[t[0]], &b = places_[t[1]], &c = places_[t[2]];
    return area(t) <
           thin * std::max({squared_distance(a, b), squared_distance(b, c), squared_distance(c, a)});
  }

  bool leads_into(const Triangle& ear, const std::array<int, 3>& sides, std::uint32_t to) const {
    for (std::size_t k = 0; k < 3; ++k)
      if (sides[k] == 0 && turn(ear[k], ear[(k + 1) % 3], to) <= 0) return false;
    return true;
  }

  void clip(std::uint32_t i) {
    const std::uint32_t a = previous_[i], b = next_[i];
    Triangle t{a, i, b};
    std::ranges::rotate(t, std::ranges::min_element(t));
    triangles_.push_back(t);
    next_[a] = b;
    previous_[b] = a;
    previous_[i] = next_[i] = i;
    turns_[i] = 1;
    turns_[a] = turn(previous_[a], a, b);
    turns_[b] = turn(a, b, next_[b]);
    first_ = a;
    --left_;
  }

  std::uint32_t thinnest() const {
    const auto ear = [&](std::uint32_t i) { return Triangle{previous_[i], i, next_[i]}; };
    std::uint32_t best = first_;
    for (auto i = next_[first_]; i != first_; i = next_[i])
      if (area(ear(i)) < area(ear(best))) best = i;
    return best;
  }

  Vec3 normal_;
  std::vector<Point> points_;
  std::vector<Point2> places_;
  Cells cells_;
  std::vector<std::uint32_t> previous_, next_;  // neighbours in the ring; i itself for a clipped corner i
  std::vector<int> turns_;                      // the turn direction at each corner; 1 for a clipped corner
  std::size_t left_, looked_at_ = 0;
  std::uint32_t first_ = 0;
  double size_ = 0, slack_ = 0;
  std::priority_queue<Ear, std::vector<Ear>, std::greater<>> ears_;
  std::vector<Triangle> triangles_;
};

std::vector<Triangle> fan_of(std::size_t corners) {
  std::vector<Triangle> triangles;
  for (std::uint32_t i = 2; i < corners; ++i) triangles.push_back({0, i - 1, i});
  return triangles;
}

}  // namespace

bool is_fan(std::span<const Point> corners) {
  if (corners.size() <= 3) return true;
  const double least = Fan(corners).least_area();
  if (least >= thin || least < -flat_fan) return least >= thin;
  if (corners.size() > 4) return false;
  const std::array others{corners[1], corners[2], corners[3], corners[0]};
  return Fan(others).least_area() <= least;
}

std::vector<Triangle> triangulation(std::span<const Point> corners) {
  if (is_fan(corners)) return fan_of(corners.size());
  if (corners.size() == 4) return {{0, 1, 3}, {1, 2, 3}};
  return EarClipper(corners, Fan(corners).normal()).cut();
}

void triangulate(Surface& surface) {
  const std::size_t polygons = surface.polygon_count();
  const std::size_t triangles = surface.corners.size() - std::min(surface.corners.size(), 2 * polygons);
  surface.triangles.clear();
  surface.clipped.clear();
  surface.triangle_polygon.clear();
  if (triangles == polygons) {  // each polygon is a triangle
    surface.triangles.resize(polygons);
    surface.triangle_polygon.resize(polygons);
    return base::for_blocks(polygons, [&](std::size_t begin, std::size_t end) {
      for (std::size_t p = begin; p < end; ++p) {
        const std::uint32_t* corners = surface.corners.data() + 3 * p;
        surface.triangles[p] = {corners[0], corners[1], corners[2]};
        surface.triangle_polygon[p] = static_cast<std::uint32_t>(p);
      }
    });
  }
  surface.triangles.reserve(triangles);
  surface.triangle_polygon.reserve(triangles);
  std::vector<Point> places;
  for (std::uint32_t p = 0; p < polygons; ++p) {
    const std::uint32_t begin = surface.polygon_starts[p], end = surface.polygon_starts[p + 1];
    surface.triangle_polygon.insert(surface.triangle_polygon.end(), end - begin - 2, p);
    if (end - begin == 3) continue;
    places.clear();
    for (std::uint32_t c = begin; c < end; ++c) places.push_back(surface.positions[surface.corners[c]]);
    if (is_fan(places)) continue;
    for (const auto& [i, j, k] : triangulation(places))
      surface.clipped.push_back({begin + i, begin + j, begin + k});
  }
  surface.triangles.resize(surface.triangle_polygon.size());
  std::size_t t = 0;
  for_each_triangle(surface, [&](const Triangle&, const Triangle& corners) {
    const auto& [i, j, k] = corners;
    surface.triangles[t++] = {surface.corners[i], surface.corners[j], surface.corners[k]};
  });
}

namespace {

Point mean_of(std::span<const std::uint32_t> corners, std::span<const Point> positions) {
  const Point& first = positions[corners[0]];
  Vec3 sum{0, 0, 0};
  for (const auto v : corners) sum = sum + (positions[v] - first);
  return first + (1 / static_cast<double>(corners.size())) * sum;
}

// Adds triangles around the center or, if they do not cover the polygon, triangles of the polygon.
void split_polygon(std::uint32_t polygon, std::size_t most, bool at_diagonals, CenterSplit& split) {
  const auto corners = split.surface.polygon(polygon);
  const auto add = [&](std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    split.surface.triangles.push_back({a, b, c});
    split.surface.triangle_polygon.push_back(polygon);
  };
  if (corners.size() == 3) return add(corners[0], corners[1], corners[2]);
  std::vector<std::uint32_t> ring(corners.begin(), corners.end());
  std::ranges::rotate(ring, std::ranges::min_element(ring));
  const auto places = picked<Point>(split.surface.positions, ring);
  if (const auto i = at_diagonals ? settled_corner(places) : none; i != none) {
    add(ring[i], ring[i + 1], ring[i + 2]);
    return add(ring[i], ring[i + 2], ring[(i + 3) % 4]);
  }
  std::vector<Point> fan{mean_of(ring, split.surface.positions)};
  fan.insert(fan.end(), places.begin(), places.end());
  fan.push_back(places[0]);
  if (ring.size() > most || !is_fan(fan)) {
    for (const auto& [i, j, k] : triangulation(places)) add(ring[i], ring[j], ring[k]);
    return;
  }
  const auto center = static_cast<std::uint32_t>(split.surface.positions.size());
  for (std::size_t i = 0; i < ring.size(); ++i) add(center, ring[i], ring[(i + 1) % ring.size()]);
  split.surface.positions.push_back(fan[0]);
  split.polygons.push_back(polygon);
}

}  // namespace

CenterSplit split_at_centers(const Surface& surface, std::span<const std::uint8_t> skipped) {
  CenterSplit split{{surface.positions, surface.corners, surface.polygon_starts, {}, {}, {}}, {}};
  for (std::uint32_t p = 0; p < surface.polygon_count(); ++p)
    if (skipped.empty() || !skipped[p]) split_polygon(p, none, false, split);
  return split;
}

CenterSplit split_unsettled(const Surface& surface, std::size_t most) {
  CenterSplit split{{surface.positions, surface.corners, surface.polygon_starts, {}, {}, {}}, {}};
  for (std::uint32_t p = 0; p < surface.polygon_count(); ++p) split_polygon(p, most, true, split);
  return split;
}

std::uint32_t settled_corner(std::span<const Point> corners) {
  if (corners.size() != 4) return none;
  const std::array others{corners[1], corners[2], corners[3], corners[0]};
  const bool covers = is_fan(corners);
  if (covers != is_fan(others)) return covers ? 0 : 1;
  const double one = squared_norm(corners[2] - corners[0]), other = squared_norm(corners[3] - corners[1]);
  if (std::abs(one - other) <= 2e-6 * std::max(one, other)) return none;
  return one < other ? 0 : 1;
}

std::vector<Point> with_centers(const Surface& surface, std::span<const std::uint32_t> polygons,
                                std::span<const Point> positions) {
  std::vector<Point> all(positions.begin(), positions.end());
  for (const auto p : polygons) all.push_back(mean_of(surface.polygon(p), positions));
  return all;
}

}  // namespace viete::mesh
