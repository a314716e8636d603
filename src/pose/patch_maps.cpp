#include "pose/patch_maps.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "mesh/normals.h"
#include "pose/maps.h"
#include "sym3/eigenvalues.h"

namespace viete::pose {

namespace {

using Symmetric = sym3::Sym3<double>;

constexpr double width_of_fit = 0.03;  // e of VertexPatches, relative to the cage's size
constexpr double least_spread = 0.1;   // limit of (least singular value) / (largest singular value)
constexpr double flat_spread = 1e-3;   // a patch with a smaller ratio counts as flat
constexpr std::size_t most_vertices = 256;
constexpr double least_area = 1e-9;  // limit of |sum of area vectors| / (sum of areas); below: they cancel
constexpr std::size_t most_corners = 16;  // in larger polygons, only the two ends of an edge are neighbours
struct Spread {
  Symmetric k{0, 0, 0, 0, 0, 0};

  void add(double w, const Vec3& x) {
    k.xx += w * x[0] * x[0];
    k.xy += w * x[0] * x[1];
    k.xz += w * x[0] * x[2];
    k.yy += w * x[1] * x[1];
    k.yz += w * x[1] * x[2];
    k.zz += w * x[2] * x[2];
  }
  // Returns (least singular value) / (largest singular value) of the points.
  double ratio() const {
    const auto squares = sym3::eigenvalues(k);
    return squares[2] > 0 ? std::sqrt(std::max(squares[0], 0.0) / squares[2]) : 0;
  }
  double largest() const { return sym3::eigenvalues(k)[2]; }
};

Symmetric inverse(const Symmetric& m) {
  const Symmetric c{m.yy * m.zz - m.yz * m.yz, m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
                    m.xx * m.zz - m.xz * m.xz, m.xy * m.xz - m.xx * m.yz, m.xx * m.yy - m.xy * m.xy};
  const double scale = 1 / (m.xx * c.xx + m.xy * c.xy + m.xz * c.xz);
  return {scale * c.xx, scale * c.xy, scale * c.xz, scale * c.yy, scale * c.yz, scale * c.zz};
}

void add_pair(std::vector<mesh::Edge>& pairs, std::uint32_t a, std::uint32_t b) {
  if (a != b) pairs.push_back({std::min(a, b), std::max(a, b)});
}

// Two cage vertices are neighbours if they belong to one polygon (see most_corners) or have equal positions.
mesh::Adjacency neighbours_of_vertices(const Cage& cage) {
  const mesh::Surface& surface = cage.surface;
  const mesh::Surface welded = mesh::welded(surface);
  std::vector<mesh::Edge> pairs;
  for (std::size_t p = 0; p < surface.polygon_count(); ++p) {
    const std::size_t first = surface.polygon_starts[p], n = surface.polygon_starts[p + 1] - first;
    const std::size_t reach = n > most_corners ? 1 : n / 2;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t k = 1; k <= reach; ++k)
        add_pair(pairs, welded.corners[first + i], welded.corners[first + (i + k) % n]);
  }
  for (std::size_t c = 0; c < surface.corners.size(); ++c)
    add_pair(pairs, surface.corners[c], welded.corners[c]);
  return mesh::adjacency(surface.positions.size(), without_skipped(std::move(pairs), cage.unused));
}

std::vector<VertexPatches::Patch> make_patches(const Cage& cage, double size, std::span<const Vec3> normals) {
  const auto& positions = cage.surface.positions;
  const double scale = 1 / size;
  const auto weight = [](const Vec3& x) { return 1 / (width_of_fit * width_of_fit + squared_norm(x)); };
  const mesh::Adjacency around = neighbours_of_vertices(cage);
  std::vector<VertexPatches::Patch> patches(positions.size());
  std::vector<std::uint32_t> seen(positions.size(), ~0u);  // per vertex: the last patch that contains it
  for (std::uint32_t center = 0; center < positions.size(); ++center) {
    if (cage.unused[center]) continue;
    const auto from_center = [&](std::uint32_t v) { return scale * (positions[v] - positions[center]); };
    std::vector<std::uint32_t> vertices{center};
    seen[center] = center;
    Spread spread;
    std::size_t ring = 0, end = 0;  // the last ring: vertices [ring, end)
    do {
      ring = end;
      end = vertices.size();
      for (std::size_t i = ring; i < end; ++i)
        for (const auto n : around.of(vertices[i])) {
          if (std::exchange(seen[n], center) == center) continue;
          spread.add(weight(from_center(n)), from_center(n));
          vertices.push_back(n);
        }
    } while (vertices.size() > end && spread.ratio() < least_spread && vertices.size() < most_vertices);
    VertexPatches::Patch& patch = patches[center];
    if (spread.ratio() < flat_spread) {
      if (squared_norm(normals[center]) == 0) continue;
      const Vec3 n = scale * normals[center];
      const double w = spread.largest() / squared_norm(n);
      spread.add(w, n);
      patch.normal_dual = (scale * w) * times(inverse(spread.k), n);
    }
    const Symmetric k = inverse(spread.k);
    for (const auto v : vertices) {
      const Vec3 x = from_center(v);
      patch.members.push_back({v, (scale * weight(x)) * times(k, x)});
    }
  }
  return patches;
}

}  // namespace

VertexPatches::VertexPatches(const Cage& cage, double size)
    : cage_(cage),
      triangles_(mesh::vertex_triangles(cage.elements.positions.size(), cage.elements.triangles)) {
  for (std::uint32_t v = 0; v < cage.surface.positions.size(); ++v)
    rest_normals_.push_back(normal(v, cage.elements.positions));
  patches_ = make_patches(cage, size, rest_normals_);
}

// Returns x / sqrt|x| for the sum x of the area vectors around a vertex. If the areas cancel, returns 0.
Vec3 VertexPatches::normal(std::uint32_t vertex, std::span<const mesh::Point> at) const {
  Vec3 sum{0, 0, 0};
  double total = 0;
  for (const auto e : triangles_.of(vertex)) {
    const auto& [a, b, c] = cage_.elements.triangles[e];
    const Vec3 area = cross(at[b] - at[a], at[c] - at[a]);
    sum = sum + area;
    total += norm(area);
  }
  return norm(sum) > least_area * total ? side_along(sum) : Vec3{0, 0, 0};
}

// Near rest, adds a sum over displacements to I, so that the map is exactly I if no vertex moved.
void VertexPatches::compute(std::span<const mesh::Point> posed, const Vec3& origin,
                            std::span<const std::uint32_t> which, std::span<AffineMap> maps) const {
  const auto& rest = cage_.surface.positions;
  const std::vector<mesh::Point> at = with_centers(cage_, posed);
  const Vec3 rest_origin = middle(rest);
  const auto to = [&](std::uint32_t v) { return posed[v] - origin; };
  const auto way = [&](std::uint32_t v) { return to(v) - (rest[v] - rest_origin); };
  for (const auto patch : which) {
    maps[patch] = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, to(patch)};
    if (cage_.unused[patch]) continue;
    double moved = 0, size = 0;
    for (const auto& [v, dual] : members(patch)) {
      moved += squared_norm(way(v) - way(patch));
      size += squared_norm(rest[v] - rest[patch]);
    }
    const bool near = moved <= 0.25 * size;
    auto& m = maps[patch].linear;
    if (!near) m = {};
    const auto add_product = [&m](const Vec3& a, const Vec3& b) {
      for (int r = 0; r < 3; ++r) {
        for (int c = 0; c < 3; ++c) m[3 * r + c] += a[r] * b[c];
      }
    };
    for (const auto& [v, dual] : members(patch))
      add_product(near ? way(v) - way(patch) : to(v) - to(patch), dual);
    const Vec3& normal_dual = patches_[patch].normal_dual;
    if (squared_norm(normal_dual) == 0) continue;
    const Vec3 posed_normal = normal(patch, at);
    add_product(near ? posed_normal - rest_normals_[patch] : posed_normal, normal_dual);
  }
}

}  // namespace viete::pose
