#include "mesh/drawing.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "base/median.h"
#include "base/worker_pool.h"
#include "mesh/point_index.h"
#include "mesh/point_tree.h"
#include "mesh/triangle.h"

namespace viete::mesh {

namespace {

// Converts a difference of points to float, because shades of grey need no more precision.
Vec3f rounded(const Point& a) {
  return {static_cast<float>(a[0]), static_cast<float>(a[1]), static_cast<float>(a[2])};
}

template <class Get>
float mean_around(const Adjacency& around, std::size_t v, Get get) {
  float sum = 0;
  for (const std::uint32_t other : around.of(v)) sum += get(other);
  const auto count = static_cast<float>(around.of(v).size());
  return count > 0 ? sum / count : sum;
}

// Returns the mean sine of the angles between the tangent plane and the edges at v. Positive in a hollow.
float hollowness(const Adjacency& around, std::span<const Vec3f> points, std::size_t v, const Vec3f& normal) {
  return mean_around(around, v, [&](std::uint32_t other) {
    const Vec3f edge = points[other] - points[v];
    const float length = norm(edge);
    return length > 0 ? dot(edge, normal) / length : 0.0F;
  });
}

}  // namespace

std::vector<float> bake_cavity(std::span<const Point> positions, std::span<const Point> normals,
                               std::span<const Triangle> triangles, Adjacency around, bool inside_out) {
  constexpr int levels = 4;  // each level finds creases of twice the width
  base::WorkerPool pool(positions.size() > base::large_block ? 0 : 1);
  const auto for_vertices = [&](const auto& use) {
    pool.for_blocks(positions.size(), base::large_block, [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v) use(v);
    });
  };
  std::vector<Vec3f> points(positions.size());
  for_vertices([&](std::size_t v) {
    points[v] = rounded(positions[v] - positions[0]);
    for (std::size_t i = around.starts[v]; i < around.starts[v + 1]; ++i) {
      const Triangle& t = triangles[around.items[i]];
      around.items[i] = t[0] == v ? t[1] : t[1] == v ? t[2] : t[0];  // the corner that follows v
    }
  });
  std::vector<float> hollow(positions.size()), scratch(positions.size()), sum(positions.size(), 0.0F);
  for_vertices([&](std::size_t v) { hollow[v] = hollowness(around, points, v, rounded(normals[v])); });
  for (int level = 0; level < levels; ++level) {
    for (int step = 0; step < 1 << level; ++step) {
      std::swap(hollow, scratch);
      for_vertices([&](std::size_t v) {  // smooths the values
        const float mean = mean_around(around, v, [&](std::uint32_t other) { return scratch[other]; });
        hollow[v] = around.of(v).empty() ? scratch[v] : 0.5F * scratch[v] + 0.5F * mean;
      });
    }
    for_vertices([&](std::size_t v) { sum[v] += hollow[v]; });
  }
  const float scale = inside_out ? -2.0F : 2.0F;
  for (float& value : sum) value = 1 - std::clamp(scale * value, 0.0F, 1.0F);
  return sum;
}

namespace {

// Interleaves the bits of the coordinates, whole numbers from 0 to 2^21 - 1. Near cells get near codes.
std::uint64_t morton_code(const Point& cell) {
  std::uint64_t code = 0;
  for (int bit = 20; bit >= 0; --bit)
    for (const double x : cell) code = code << 1 | (static_cast<std::uint64_t>(x) >> bit & 1);
  return code;
}

}  // namespace

Draft draft_of(const Surface& surface, std::span<const Point> normals, const Bounds& box, double area,
               std::size_t wanted) {
  Draft draft;
  // On average, a plane of area A meets 1.5 * A / side^2 cells. There are about two triangles per cell.
  const double side = std::sqrt(3 * area / static_cast<double>(wanted));
  if (!(side > 0)) return draft;
  PointIndex index;
  std::vector<Point> cells;
  std::vector<std::uint32_t>& chosen = draft.vertices;
  std::vector<std::uint32_t> cell_of(surface.positions.size());
  std::vector<std::uint8_t> used(cell_of.size(), 0);
  for (const auto& [a, b, c] : surface.triangles) used[a] = used[b] = used[c] = 1;
  struct Nearest {  // to the middle of a cell
    Vec3 normal;
    double distance;  // squared
  };
  std::vector<Nearest> nearest;
  for (std::uint32_t v = 0; v < cell_of.size(); ++v) {
    if (!used[v]) continue;
    const Point at = (1 / side) * (surface.positions[v] - box.low);
    Point cell{std::floor(at[0]), std::floor(at[1]), std::floor(at[2])};
    const double distance = squared_norm(at - cell - Vec3{0.5, 0.5, 0.5});
    std::uint32_t c = index.find_or_add(cell, cells);
    if (c < cells.size() && dot(nearest[c].normal, normals[v]) < 0) {  // the other side of a thin part
      cell[0] += 0.5;
      c = index.find_or_add(cell, cells);
    }
    cell_of[v] = c;
    if (c == cells.size()) {
      cells.push_back(cell);
      chosen.push_back(v);
      nearest.push_back({normals[v], distance});
    } else if (distance < nearest[c].distance) {
      chosen[c] = v;
      nearest[c] = {normals[v], distance};
    }
  }
  struct Replaced {
    Triangle triangle;
    std::uint32_t source;
  };
  const auto block = [&](std::size_t begin, std::size_t end) {
    std::vector<Replaced> between;
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [a, b, c] = surface.triangles[i];
      const Triangle cells_of{cell_of[a], cell_of[b], cell_of[c]};
      if (!repeats_corner(cells_of)) between.push_back({cells_of, static_cast<std::uint32_t>(i)});
    }
    return between;
  };
  const auto append = [](std::vector<Replaced> all, std::vector<Replaced> more) {
    all.insert(all.end(), more.begin(), more.end());
    return all;
  };
  std::vector<Replaced> all = base::sum_of_blocks(surface.triangles.size(), block, append);
  // Near triangles follow each other, so that drawing computes their common vertices once.
  std::vector<std::uint64_t> codes;
  for (const Point& cell : cells) codes.push_back(morton_code(cell));
  std::ranges::sort(
      all, {}, [&](const Replaced& r) { return std::tuple(codes[r.triangle[0]], r.triangle, r.source); });
  std::vector<Triangle> triangles;
  for (const auto& [triangle, source] : all) {
    triangles.push_back(triangle);
    draft.sources.push_back(source);
  }
  draft.surface = from_triangles(picked(std::span(surface.positions), draft.vertices), triangles);
  return draft;
}

// In a Poisson process of density d, the mean distance from any place to the nearest point is 1 / (2
// sqrt(d)).
double point_spacing(std::span<const Point> points) {
  constexpr std::size_t most = 4096;
  const std::size_t step = std::max<std::size_t>(points.size() / most, 2);
  std::vector<std::uint32_t> some;
  for (std::size_t i = 0; i + step / 2 < points.size(); i += step)
    some.push_back(static_cast<std::uint32_t>(i));
  if (some.empty()) return 0;
  const PointTree tree(points, some);
  std::vector<double> distances;
  for (const std::uint32_t i : some)
    distances.push_back(norm(points[i + step / 2] - points[tree.nearest(points[i + step / 2])]));
  const double middle = base::median(std::move(distances));  // ignores lonely points
  return 2 * middle * std::sqrt(static_cast<double>(some.size()) / static_cast<double>(points.size()));
}

}  // namespace viete::mesh
