#include "mesh/normals.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "mesh/point_index.h"
#include "mesh/point_tree.h"
#include "mesh/triangle_tree.h"

namespace viete::mesh {

namespace {

// Returns the unit vector, or (0, 0, 1) for a zero vector. Avoids squares outside the range of double.
Point unit(Point sum) {
  double squared = squared_norm(sum);
  if (!(squared > 1e-280 && squared < 1e280)) {
    const double largest = largest_abs(sum);
    if (!(largest > 0 && std::isfinite(largest))) return {0, 0, 1};
    for (double& x : sum) x /= largest;
    squared = squared_norm(sum);
  }
  const double length = std::sqrt(squared);
  return {sum[0] / length, sum[1] / length, sum[2] / length};
}

// Two edges of a triangle, the unit normal, and the dual basis of the edges in the triangle's plane.
struct TriangleAxes {
  Point edge[2], normal, dual[2];
  double area = 0;  // twice the area of the triangle

  TriangleAxes(std::span<const Point> p, const Triangle& t) : edge{p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]} {
    const Point n = cross(edge[0], edge[1]);
    area = stable_norm(n);
    if (!(area > 0)) return;
    normal = (1 / area) * n;
    dual[0] = (1 / area) * cross(edge[1], normal);
    dual[1] = (1 / area) * cross(normal, edge[0]);
  }
};

// The affine map of a triangle from rest to pose. Scales along the normal by sqrt(posed area / rest area).
struct TriangleMap {
  TriangleAxes from, to;
  double thickness = 1;

  TriangleMap(const Triangle& t, std::span<const Point> rest, std::span<const Point> posed)
      : from(rest, t), to(posed, t) {
    if (usable()) thickness = std::sqrt(to.area / from.area);
  }

  bool usable() const { return from.area > 0 && to.area > 0 && std::isfinite(to.area); }

  // Returns from.area * C * n, where C is the cofactor matrix of the map.
  Point of_normal(const Point& n) const {
    const Point in_plane = dot(n, from.edge[0]) * to.dual[0] + dot(n, from.edge[1]) * to.dual[1];
    return to.area * (dot(n, from.normal) * to.normal + thickness * in_plane);
  }

  Point of_tangent(const Point& t) const {
    const Point in_plane = dot(t, from.dual[0]) * to.edge[0] + dot(t, from.dual[1]) * to.edge[1];
    return to.area * (in_plane + thickness * dot(t, from.normal) * to.normal);
  }
};

bool has_moved(const Triangle& t, std::span<const Point> rest, std::span<const Point> posed) {
  return rest[t[0]] != posed[t[0]] || rest[t[1]] != posed[t[1]] || rest[t[2]] != posed[t[2]];
}

// Rotates n by the smallest rotation that maps `from` to `to`. For opposite directions, returns n.
Vec3 turned_along(const Vec3& n, const Vec3& from, const Vec3& to) {
  const Vec3 a = unit(from), b = unit(to), axis = cross(a, b);
  const double cosine = dot(a, b);
  if (!(cosine > -1)) return n;
  return cosine * n + cross(axis, n) + (dot(axis, n) / (1 + cosine)) * axis;
}

// Rotates the normals of vertices whose triangles have no area. They rotate with the nearest triangle that
// has area. If no triangle has area, they rotate with triangles between the nearest vertices.
class NearbyTurns {
public:
  NearbyTurns(const Surface& rest, std::span<const Point> posed) : rest_(rest.positions), posed_(posed) {
    for (const Triangle& t : rest.triangles) {
      if (TriangleMap(t, rest_, posed_).usable()) usable_.push_back(t);
    }
    if (!usable_.empty()) {
      triangles_.emplace(rest.positions, usable_);
      return;
    }
    points_.emplace(rest_, first_numbers(rest_.size()));
    diagonal_ = bounds(rest_).diagonal();
  }

  template <class Move>
  Vec3 of(std::uint32_t vertex, const Vec3& vector, const Move& move) const {
    if (triangles_) {
      const Triangle& t = usable_[triangles_->nearest(rest_[vertex]).triangle];
      return has_moved(t, rest_, posed_) ? unit(move(TriangleMap(t, rest_, posed_), vector)) : vector;
    }
    const std::vector<std::uint32_t> near = neighbours(vertex);
    const auto stays = [&](std::uint32_t v) { return rest_[v] == posed_[v]; };
    if (near.empty() || (stays(vertex) && std::ranges::all_of(near, stays))) return vector;
    Vec3 sum{0, 0, 0};
    for (std::size_t i = 0; i < near.size(); ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const TriangleMap map({vertex, near[i], near[j]}, rest_, posed_);
        if (map.usable()) sum = sum + move(map, vector);
      }
    if (squared_norm(sum) > 0) return unit(sum);
    const std::uint32_t far = near.back();
    return turned_along(vector, rest_[far] - rest_[vertex], posed_[far] - posed_[vertex]);
  }

private:
  // Returns the nearest vertices at other positions, at most six, sorted by distance.
  std::vector<std::uint32_t> neighbours(std::uint32_t vertex) const {
    constexpr std::size_t enough = 6;
    const Point& p = rest_[vertex];
    std::vector<std::uint32_t> near;
    for (double radius = diagonal_ / std::sqrt(static_cast<double>(rest_.size()));; radius *= 2) {
      near.clear();
      points_->for_within(p, radius, [&](std::uint32_t v) {
        if (rest_[v] != p) near.push_back(v);
      });
      if (near.size() >= enough || !(radius < diagonal_)) break;
    }
    std::ranges::sort(near, {}, [&](std::uint32_t v) { return std::pair(squared_norm(rest_[v] - p), v); });
    near.resize(std::min(near.size(), enough));
    return near;
  }

  std::span<const Point> rest_, posed_;
  std::vector<Triangle> usable_;
  std::optional<TriangleTree> triangles_;
  std::optional<PointTree> points_;
  double diagonal_ = 0;
};

// The sum of a vector over its triangles after the deformation.
struct Sum {
  Vec3 vector{0, 0, 0};
  double area = 0;  // twice the area of the deformed triangles
  bool moved = false;
};

// Adds up the sums of equal vectors whose vertices are at one place, at rest and deformed. Leaves vectors of
// several vertices as they are: those belong to flat polygons.
void join_equal(const Surface& rest, std::span<const Point> posed, std::span<const Vec3> vectors,
                std::span<const std::uint32_t> of_corner, std::span<const std::uint32_t> home,
                std::vector<Sum>& sums) {
  const std::vector<std::uint32_t> places = lowest_in_place(rest.positions);
  std::vector<char> is_single(vectors.size(), 1);
  for (std::size_t c = 0; c < of_corner.size(); ++c) {
    if (of_corner[c] != none && home[of_corner[c]] != rest.corners[c]) is_single[of_corner[c]] = 0;
  }
  const Adjacency at_places = make_adjacency(places.size(), [&](const auto& add) {
    for (std::uint32_t i = 0; i < vectors.size(); ++i) {
      if (home[i] != none && is_single[i] && squared_norm(vectors[i]) > 0) add(places[home[i]], i);
    }
  });
  const double size = bounds(posed).diagonal(), cell = size > 0 ? 1e-7 * size : 1;
  const auto key = [&](std::uint32_t i) {
    Point p = posed[home[i]];
    for (double& x : p) x = std::round(x / cell);
    return std::pair(vectors[i], p);
  };
  std::vector<std::uint32_t> equal;
  for (std::uint32_t place = 0; place < places.size(); ++place) {
    const auto here = at_places.of(place);
    if (here.size() < 2) continue;
    equal.assign(here.begin(), here.end());
    std::ranges::stable_sort(equal, {}, key);
    for (auto first = equal.begin(); first != equal.end();) {
      const auto end =
          std::find_if(first + 1, equal.end(), [&](std::uint32_t i) { return key(i) != key(*first); });
      Sum all;
      for (auto i = first; i != end; ++i) {
        all.vector = all.vector + sums[*i].vector;
        all.area += sums[*i].area;
        all.moved |= sums[*i].moved;
      }
      for (; first != end; ++first) sums[*first] = all;
    }
  }
}

// Computes deformed normals, tangents or, with `keeps_size`, offsets. move(map, vector) transforms a vector
// by the map of a triangle.
template <class Move>
std::vector<Vec3> carried(const Surface& rest, std::span<const Point> positions,
                          std::span<const Vec3> vectors, std::span<const std::uint32_t> of_corner,
                          std::span<const std::uint32_t> of_vertex, const Move& move,
                          bool keeps_size = false) {
  std::vector<Vec3> result(vectors.begin(), vectors.end());
  if (std::ranges::equal(rest.positions, positions)) return result;
  std::vector<Sum> sums(vectors.size());
  std::vector<std::uint32_t> home(of_vertex.begin(), of_vertex.end());
  home.resize(vectors.size(), none);
  for (std::size_t c = 0; c < of_corner.size(); ++c) {
    if (of_corner[c] != none) home[of_corner[c]] = rest.corners[c];
  }
  for_each_triangle(rest, [&](const Triangle& triangle, const Triangle& corners) {
    const TriangleMap map(triangle, rest.positions, positions);
    const bool moves = has_moved(triangle, rest.positions, positions);
    for (const std::uint32_t c : corners) {
      const std::uint32_t i = of_corner[c];
      if (i == none) continue;
      sums[i].moved |= moves;
      if (!map.usable()) continue;
      sums[i].vector = sums[i].vector + move(map, vectors[i]);
      sums[i].area += map.to.area;
    }
  });
  join_equal(rest, positions, vectors, of_corner, home, sums);
  std::optional<NearbyTurns> nearby;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Sum& sum = sums[i];
    if (squared_norm(sum.vector) > 0) {
      if (sum.moved) result[i] = keeps_size ? (1 / sum.area) * sum.vector : unit(sum.vector);
    } else if (home[i] != none && is_direction(vectors[i]) && squared_norm(vectors[i]) > 0) {
      if (!nearby) nearby.emplace(rest, positions);
      const Vec3 turned = nearby->of(home[i], vectors[i], move);
      result[i] = keeps_size ? stable_norm(vectors[i]) * unit(turned) : turned;
    }
  }
  return result;
}

}  // namespace

Adjacency vertex_triangles(std::size_t vertices, std::span<const Triangle> triangles) {
  const auto add_corners = [&](std::uint32_t t, const auto& add) {
    for (const std::uint32_t v : triangles[t]) add(v, t);
  };
  if (triangles.size() >= 1'000'000) return sorted_adjacency(vertices, triangles.size(), add_corners);
  return make_adjacency(vertices, [&](const auto& add) {  // one thread is faster for fewer triangles
    for (std::uint32_t t = 0; t < triangles.size(); ++t) add_corners(t, add);
  });
}

void vertex_normals(std::span<const Point> positions, std::span<const Triangle> triangles,
                    const Adjacency& around, std::size_t begin, std::size_t end, std::span<Point> normals) {
  for (std::size_t v = begin; v < end; ++v) {
    Point sum{0, 0, 0};
    for (const std::uint32_t i : around.of(v)) {
      const Triangle& t = triangles[i];
      const Point &a = positions[t[0]], &b = positions[t[1]], &c = positions[t[2]];
      sum = sum + cross(b - a, c - a);  // weights by area: the length is twice the area
    }
    normals[v] = unit(sum);
  }
}

std::vector<Vec3> deformed_normals(const Surface& rest, std::span<const Point> positions,
                                   std::span<const Vec3> normals,
                                   std::span<const std::uint32_t> corner_normal,
                                   std::span<const std::uint32_t> vertex_of_normal) {
  return carried(rest, positions, normals, corner_normal, vertex_of_normal,
                 [](const TriangleMap& map, const Vec3& n) {
                   return is_direction(n) ? map.of_normal(n) : map.to.area * map.to.normal;
                 });
}

std::vector<Vec3> deformed_tangents(const Surface& rest, std::span<const Point> positions,
                                    std::span<const Vec3> tangents,
                                    std::span<const std::uint32_t> corner_tangent,
                                    std::span<const std::uint32_t> vertex_of_tangent) {
  return carried(rest, positions, tangents, corner_tangent, vertex_of_tangent,
                 [](const TriangleMap& map, const Vec3& t) { return map.of_tangent(t); });
}

std::vector<Vec3> deformed_offsets(const Surface& rest, std::span<const Point> positions,
                                   std::span<const Vec3> offsets, OffsetKind kind,
                                   std::span<const std::uint32_t> corner_offset,
                                   std::span<const std::uint32_t> vertex_of_offset) {
  const auto move = [kind](const TriangleMap& map, const Vec3& offset) {
    return kind == OffsetKind::positions ? map.of_tangent(offset) : map.of_normal(offset);
  };
  return carried(rest, positions, offsets, corner_offset, vertex_of_offset, move, true);
}

void keep_lengths(std::span<const Vec3> before, std::span<Vec3> now) {
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (now[i] == before[i]) continue;
    const double length = stable_norm(before[i]);
    if (std::abs(length - 1) > 0.01 && is_direction(before[i])) now[i] = length * now[i];
  }
}

}  // namespace viete::mesh
