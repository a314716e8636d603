#include "weights/laplacian.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "mesh/half_edges.h"
#include "mesh/triangle.h"
#include "mesh/triangulation.h"

namespace viete::weights {

namespace {

// Returns the sides opposite to the corners, scaled to a size near 1. If all corners coincide, returns 0.
std::array<Vec3, 3> scaled_sides(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c) {
  std::array<Vec3, 3> sides{c - b, a - c, b - a};
  const double largest = std::max({largest_abs(sides[0]), largest_abs(sides[1]), largest_abs(sides[2])});
  const double scale = 1 / largest;
  if (!(largest > 0 && std::isfinite(scale))) return {};
  for (Vec3& side : sides) side = scale * side;
  return sides;
}

double longest_squared(const std::array<Vec3, 3>& sides) {
  return std::max({squared_norm(sides[0]), squared_norm(sides[1]), squared_norm(sides[2])});
}

double doubled_area(const std::array<Vec3, 3>& sides) {
  return norm(cross(sides[0], sides[1]));
}

}  // namespace

bool is_thin(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c) {
  const auto sides = scaled_sides(a, b, c);
  return !(doubled_area(sides) > thin_triangle * longest_squared(sides));
}

// The cotangent at a corner is the dot product of the corner's two sides divided by twice the area.
Vec3 half_cotangents(const mesh::Point& a, const mesh::Point& b, const mesh::Point& c) {
  const auto s = scaled_sides(a, b, c);
  const double counted = std::max(doubled_area(s), thin_triangle * longest_squared(s));
  if (!(counted > 0)) return {0, 0, 0};
  const double scale = -0.5 / counted;
  return {scale * dot(s[1], s[2]), scale * dot(s[2], s[0]), scale * dot(s[0], s[1])};
}

sparse::SparseMatrix stiffness_matrix(std::span<const mesh::Point> positions,
                                      std::span<const mesh::Triangle> triangles) {
  const auto n = static_cast<std::uint32_t>(positions.size());
  return sparse::sparse_matrix_of(n, [&](const auto& add) {
    for (std::uint32_t v = 0; v < n; ++v) add(v, v, 0.0);
    for (const mesh::Triangle& t : triangles) {
      if (mesh::repeats_corner(t)) continue;
      const Vec3 half = half_cotangents(positions[t[0]], positions[t[1]], positions[t[2]]);
      for (int k = 0; k < 3; ++k) {
        const auto i = t[(k + 1) % 3], j = t[(k + 2) % 3];
        add(i, i, half[k]);
        add(j, j, half[k]);
        add(i, j, -half[k]);
        add(j, i, -half[k]);
      }
    }
  });
}

namespace {

constexpr double least_excess = 1e-5;    // least a + b - c for triangle sides a, b, c, in mean edge lengths
constexpr double least_weight = 1e-10;   // smaller weights are rounding errors
constexpr std::size_t most_flips = 100;  // per half-edge; prevents an endless loop
using mesh::none;

// Returns the area of a triangle. W. Kahan, Miscalculating Area and Angles of a Needle-like Triangle (2014).
double area_of(double a, double b, double c) {
  if (a < b) std::swap(a, b);
  if (b < c) std::swap(b, c);
  if (a < b) std::swap(a, b);
  const double square = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
  constexpr double least = 1e-12;  // smallest area divided by a^2, so that cotangents stay finite
  return std::max(0.25 * std::sqrt(std::max(square, 0.0)), least * a * a);
}

// Triangles given by edge lengths and adjacency. Half-edge h runs from tail_[h] to tail_[next_[h]].
class IntrinsicTriangles {
public:
  IntrinsicTriangles(const std::vector<mesh::Point>& positions,
                     const std::vector<mesh::Triangle>& triangles) {
    const mesh::HalfEdges table = mesh::half_edges(positions.size(), triangles);
    sides_ = closed_and_oriented(table) ? 1 : 2;
    add_triangles(triangles);
    for (std::size_t e = 0; e < table.edges.size(); ++e) sew(table, e, triangles);
    set_lengths(positions);
    lengthen();
    area_.resize(next_.size());
    for (std::uint32_t h = 0; h < next_.size(); h += 3) set_area(h);
  }

  void make_delaunay() {
    std::vector<std::uint32_t> open;
    std::vector<bool> listed(next_.size(), false);
    for (std::uint32_t h = 0; h < next_.size(); ++h) {
      listed[h] = h < twin_[h];
      if (listed[h]) open.push_back(h);
    }
    for (std::size_t left = most_flips * next_.size(); !open.empty() && left > 0; --left) {
      const std::uint32_t h = open.back();
      open.pop_back();
      listed[h] = false;
      if (!flips(h)) continue;
      flip(h);
      for (const auto around : {next_[h], previous(h), next_[twin_[h]], previous(twin_[h])}) {
        if (!listed[around]) open.push_back(around);
        listed[around] = true;
      }
    }
  }

  sparse::SparseMatrix stiffness(std::size_t vertices) const {
    std::vector<sparse::MatrixEntry> entries;
    for (std::uint32_t v = 0; v < vertices; ++v) entries.push_back({v, v, 0.0});
    for (std::uint32_t h = 0; h < next_.size(); ++h) {
      const std::uint32_t a = tail_[h], b = tail_[twin_[h]];
      if (h > twin_[h] || a == b) continue;
      const double w = weight(h) / sides_;
      if (w < least_weight) continue;
      entries.push_back({a, a, w});
      entries.push_back({b, b, w});
      entries.push_back({a, b, -w});
      entries.push_back({b, a, -w});
    }
    return sparse_matrix(vertices, entries);
  }

  std::vector<double> masses(std::size_t vertices) const {
    std::vector<double> result(vertices, 0);
    double sum = 0;
    for (std::uint32_t h = 0; h < next_.size(); ++h) {
      const double whole = area_[h];
      result[tail_[h]] += whole;
      sum += whole;
    }
    for (double& mass : result) mass /= sum;
    return result;
  }

private:
  static bool closed_and_oriented(const mesh::HalfEdges& table) {
    for (std::size_t e = 0; e < table.edges.size(); ++e) {
      const auto sides = table.of(e);
      if (sides.size() != 2 || sides[0].forward == sides[1].forward) return false;
    }
    return true;
  }

  // Half-edge i of triangle t gets the index 3 * t + i. If the surface is doubled, the half-edges of the back
  // sides follow, with opposite directions.
  void add_triangles(const std::vector<mesh::Triangle>& triangles) {
    const auto front = static_cast<std::uint32_t>(3 * triangles.size());
    next_.resize(sides_ * front);
    tail_.resize(next_.size());
    twin_.assign(next_.size(), none);
    for (std::uint32_t h = 0; h < front; ++h) {
      const std::uint32_t first = h / 3 * 3, i = h % 3;
      next_[h] = first + (i + 1) % 3;
      tail_[h] = triangles[h / 3][i];
      if (sides_ == 1) continue;
      next_[front + h] = front + first + (i + 2) % 3;
      tail_[front + h] = triangles[h / 3][(i + 1) % 3];
    }
  }

  // Pairs the half-edges at edge e. On a doubled surface, each triangle has a forward half-edge on one side
  // and a backward half-edge on the other. A forward half-edge is paired with the backward half-edge of the
  // next triangle around e.
  void sew(const mesh::HalfEdges& table, std::size_t e, const std::vector<mesh::Triangle>& triangles) {
    const auto around = table.of(e);
    const auto half_edge = [&](const mesh::HalfEdge& side, bool forward) {
      const mesh::Triangle& t = triangles[side.triangle];
      const std::uint32_t from = table.edges[e][side.forward ? 0 : 1];
      const auto i = static_cast<std::uint32_t>(std::find(t.begin(), t.end(), from) - t.begin());
      const std::uint32_t front = 3 * side.triangle + i;
      return side.forward == forward ? front : front + static_cast<std::uint32_t>(3 * triangles.size());
    };
    for (std::size_t s = 0; s < around.size(); ++s) {
      const std::size_t n = (s + 1) % around.size();
      if (sides_ == 1 && !around[s].forward) continue;
      const std::uint32_t h = half_edge(around[s], true), g = half_edge(around[n], false);
      twin_[h] = g;
      twin_[g] = h;
    }
  }

  // Computes lengths in units of the mean edge length.
  void set_lengths(const std::vector<mesh::Point>& positions) {
    double sum = 0;
    for (std::uint32_t h = 0; h < next_.size(); ++h) {
      length_.push_back(norm(positions[tail_[next_[h]]] - positions[tail_[h]]));
      sum += length_.back();
    }
    const double mean = sum / static_cast<double>(length_.size());
    for (double& l : length_) l = mean > 0 ? l / mean : 1;
  }

  // Adds the same length to all edges, so that every triangle has an area.
  void lengthen() {
    double missing = 0;
    for (std::uint32_t h = 0; h < next_.size(); ++h)
      missing = std::max(missing, least_excess - (length_[next_[h]] + length_[previous(h)] - length_[h]));
    for (double& l : length_) l += missing;
  }

  std::uint32_t previous(std::uint32_t h) const { return next_[next_[h]]; }
  void set_area(std::uint32_t h) {
    area_[h] = area_[next_[h]] = area_[previous(h)] =
        area_of(length_[h], length_[next_[h]], length_[previous(h)]);
  }
  // Returns the cotangent of the angle opposite to h.
  double cotangent(std::uint32_t h) const {
    const double a = length_[h], b = length_[next_[h]], c = length_[previous(h)];
    return ((b - a) * (b + a) + c * c) / (4 * area_[h]);
  }
  double weight(std::uint32_t h) const { return 0.5 * (cotangent(h) + cotangent(twin_[h])); }

  bool flips(std::uint32_t h) const {
    const std::uint32_t g = twin_[h];
    return g != next_[h] && g != previous(h) && weight(h) < -least_weight;
  }

  // Returns the third corner of h's triangle in 2D coordinates: the tail of h is the origin, h is the x axis.
  std::array<double, 2> corner_beside(std::uint32_t h, double to_tail, double to_head) const {
    const double l = length_[h];
    return {0.5 * (l + (to_tail - to_head) * (to_tail + to_head) / l), 2 * area_[h] / l};
  }

  // Replaces h, the common edge (a, b) of the triangles (a, b, c) and (b, a, d), by the edge (c, d).
  void flip(std::uint32_t h) {
    const std::uint32_t g = twin_[h], bc = next_[h], ca = next_[bc], ad = next_[g], db = next_[ad];
    const auto c = corner_beside(h, length_[ca], length_[bc]), d = corner_beside(g, length_[db], length_[ad]);
    const double length = mesh::norm({c[0] - (length_[h] - d[0]), c[1] + d[1], 0});
    tail_[h] = tail_[ca];
    tail_[g] = tail_[db];
    next_[h] = db;
    next_[db] = bc;
    next_[bc] = h;
    next_[g] = ca;
    next_[ca] = ad;
    next_[ad] = g;
    length_[h] = length_[g] = length;
    set_area(h);
    set_area(g);
  }

  std::uint32_t sides_ = 1;
  std::vector<std::uint32_t> next_, tail_, twin_;
  std::vector<double> length_, area_;  // area_ is the area of the half-edge's triangle
};

IntrinsicLaplacian laplacian_of(const mesh::Surface& surface) {
  const std::size_t n = surface.positions.size();
  const auto triangles = mesh::proper_triangles(surface);
  if (triangles.empty()) return {sparse::sparse_matrix(n, {}), std::vector<double>(n, 0)};
  IntrinsicTriangles intrinsic(surface.positions, triangles);
  intrinsic.make_delaunay();
  return {intrinsic.stiffness(n), intrinsic.masses(n)};
}

// Makes triangulations that differ in the first corners of polygons, except for quads with a shorter
// diagonal.
class Turner {
public:
  explicit Turner(const mesh::Surface& surface) : surface_(surface) {
    for (std::size_t p = 0; p < surface_.polygon_count(); ++p) {
      const auto ring = corners(p);
      if (ring.size() == 3) continue;
      std::ranges::rotate(ring, std::ranges::min_element(ring));
      const auto settled = mesh::settled_corner(mesh::picked<mesh::Point>(surface_.positions, ring));
      if (settled == mesh::none) {
        unsettled_.push_back(p);
        count_ = count_ > most ? count_ : std::lcm(count_, ring.size() == 4 ? 2 : ring.size());
      } else {
        std::ranges::rotate(ring, ring.begin() + settled);
      }
    }
    if (count_ > most || count_ * surface.corners.size() > most_in_total) count_ = 2;
  }

  // Returns the number of triangulations in which each first corner occurs equally often; 2 for large models.
  std::size_t count() const { return count_; }

  // Returns the next triangulation.
  const mesh::Surface& next() {
    for (const auto p : unsettled_) std::ranges::rotate(corners(p), corners(p).begin() + 1);
    mesh::triangulate(surface_);
    return surface_;
  }

private:
  static constexpr std::size_t most = 60, most_in_total = 1'000'000;

  std::span<std::uint32_t> corners(std::size_t p) {
    return std::span(surface_.corners).subspan(surface_.polygon_starts[p], surface_.polygon(p).size());
  }

  mesh::Surface surface_;
  std::vector<std::size_t> unsettled_;  // polygons
  std::size_t count_ = 1;
};

}  // namespace

IntrinsicLaplacian intrinsic_laplacian(const mesh::Surface& surface) {
  if (surface.triangles.size() == surface.polygon_count()) return laplacian_of(surface);
  Turner turner(surface);
  if (turner.count() == 1) return laplacian_of(turner.next());
  IntrinsicLaplacian mean{{}, std::vector<double>(surface.positions.size(), 0)};
  std::vector<sparse::MatrixEntry> entries;
  const double share = 1 / static_cast<double>(turner.count());
  double area = 0;
  for (std::size_t i = 0; i < turner.count(); ++i) {
    const mesh::Surface& turned = turner.next();
    const sparse::SparseMatrix stiffness = laplacian_of(turned).stiffness;
    for (std::uint32_t v = 0; v < stiffness.size(); ++v)
      for_column(stiffness, v, [&](auto row, double value) { entries.push_back({row, v, share * value}); });
    for (const auto& t : turned.triangles) {
      const double own = mesh::area(turned.positions, t);
      area += 3 * own;
      for (const auto v : t) mean.masses[v] += own;
    }
  }
  for (double& mass : mean.masses) mass = area > 0 ? mass / area : 0;
  mean.stiffness = sparse_matrix(mean.masses.size(), entries);
  return mean;
}

}  // namespace viete::weights
