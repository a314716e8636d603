#include "deform/patch_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "deform/face_maps.h"
#include "deform/linear_map.h"
#include "mesh/normals.h"
#include "sym3/eigenvalues.h"

namespace viete::deform {

namespace {

using Symmetric = sym3::Sym3<double>;

constexpr double width_of_fit = 0.03;  // e, of the cage's size
constexpr double least_spread = 0.1;   // of the largest singular value
constexpr double flat_spread = 1e-3;   // below it a patch lies in a plane
constexpr std::size_t most_vertices = 256;
constexpr double least_area = 1e-9;  // of a sum of areas: what is less has cancelled

// Sums of w x x^T, lengths in sizes of the cage.
struct Spread {
  Symmetric k{0, 0, 0, 0, 0, 0};

  void add(double w, const Vec3& x) {
    k.xx += w * x[0] * x[0], k.xy += w * x[0] * x[1], k.xz += w * x[0] * x[2];
    k.yy += w * x[1] * x[1], k.yz += w * x[1] * x[2], k.zz += w * x[2] * x[2];
  }
  // Of the largest singular value of the points the least is this part.
  double ratio() const {
    const auto squares = sorted();
    return squares[2] > 0 ? std::sqrt(std::max(squares[0], 0.0) / squares[2]) : 0;
  }
  double largest() const { return sorted()[2]; }

private:
  std::array<double, 3> sorted() const {
    auto values = sym3::eigenvalues(k);
    std::sort(values.begin(), values.end());
    return values;
  }
};

// By cofactors: the condition is that of the spread, squared.
Symmetric inverse(const Symmetric& m) {
  const Symmetric c{m.yy * m.zz - m.yz * m.yz, m.xz * m.yz - m.xy * m.zz, m.xy * m.yz - m.xz * m.yy,
                    m.xx * m.zz - m.xz * m.xz, m.xy * m.xz - m.xx * m.yz, m.xx * m.yy - m.xy * m.xy};
  const double scale = 1 / (m.xx * c.xx + m.xy * c.xy + m.xz * c.xz);
  return {scale * c.xx, scale * c.xy, scale * c.xz, scale * c.yy, scale * c.yz, scale * c.zz};
}

// A cage vertex, and how far its movement goes into the map of a patch.
struct PatchVertex {
  std::uint32_t vertex;
  Vec3 dual;
};

// What patches are of: their centres, what each begins with, and where it grows. As many maps as centres.
struct Seeds {
  std::vector<Vec3> centers;        // at rest
  std::vector<Vec3> normals;        // at rest, as long as the size of what they stand on
  mesh::Adjacency corners, around;  // the vertices of each, and its neighbours
  std::vector<std::uint8_t> skipped;
};

struct Patches {
  std::vector<std::size_t> starts;    // in vertices; one more than patches
  std::vector<PatchVertex> vertices;  // patch by patch; none where it is skipped
  std::vector<Vec3> normal_duals;     // of each patch's normal; 0 where its vertices do

  std::span<const PatchVertex> of(std::size_t patch) const {
    return std::span(vertices).subspan(starts[patch], starts[patch + 1] - starts[patch]);
  }
};

// Makes the patches one after the other; what it knows of vertices and seeds is marked by the patch that saw
// them last.
class PatchMaker {
public:
  PatchMaker(const Cage& cage, double size, const Seeds& seeds)
      : cage_(cage),
        scale_(1 / size),
        seeds_(seeds),
        seen_seed_(seeds.centers.size(), none),
        seen_vertex_(cage.surface.positions.size(), none) {}

  Patches make() {
    patches_.starts.push_back(0);
    patches_.normal_duals.assign(seeds_.centers.size(), {0, 0, 0});
    for (std::uint32_t s = 0; s < seeds_.centers.size(); ++s) {
      if (!seeds_.skipped[s]) add_patch(s);
      patches_.starts.push_back(patches_.vertices.size());
    }
    return std::move(patches_);
  }

private:
  static constexpr std::uint32_t none = ~0u;

  void add_patch(std::uint32_t seed) {
    patch_ = seed;
    vertices_.clear();
    spread_ = {};
    std::vector<std::uint32_t> ring = {seed};
    seen_seed_[seed] = patch_;
    add_corners(seed);
    do {
      ring = next_ring(ring);
      for (const auto s : ring) add_corners(s);
    } while (!ring.empty() && spread_.ratio() < least_spread && vertices_.size() < most_vertices);
    finish();
  }

  std::vector<std::uint32_t> next_ring(const std::vector<std::uint32_t>& ring) {
    std::vector<std::uint32_t> next;
    for (const auto s : ring) {
      for (const auto n : seeds_.around.of(s)) {
        if (std::exchange(seen_seed_[n], patch_) != patch_) next.push_back(n);
      }
    }
    return next;
  }

  Vec3 from_center(std::uint32_t vertex) const {
    return scale_ * (cage_.surface.positions[vertex] - seeds_.centers[patch_]);
  }
  static double weight(const Vec3& x) { return 1 / (width_of_fit * width_of_fit + squared_norm(x)); }

  void add_corners(std::uint32_t seed) {
    for (const auto v : seeds_.corners.of(seed)) {
      if (std::exchange(seen_vertex_[v], patch_) == patch_) continue;
      const Vec3 x = from_center(v);
      spread_.add(weight(x), x);
      vertices_.push_back(v);
    }
  }

  void finish() {
    if (spread_.ratio() < flat_spread) {
      if (squared_norm(seeds_.normals[patch_]) == 0) return;
      const Vec3 n = scale_ * seeds_.normals[patch_];
      const double w = spread_.largest() / squared_norm(n);
      spread_.add(w, n);
      patches_.normal_duals[patch_] = (scale_ * w) * times(inverse(spread_.k), n);
    }
    const Symmetric k = inverse(spread_.k);
    for (const auto v : vertices_) {
      const Vec3 x = from_center(v);
      patches_.vertices.push_back({v, (scale_ * weight(x)) * times(k, x)});
    }
  }

  const Cage& cage_;
  double scale_;
  const Seeds& seeds_;
  std::vector<std::uint32_t> seen_seed_, seen_vertex_;
  Patches patches_;
  // Of the patch that is being made:
  std::uint32_t patch_ = 0;
  std::vector<std::uint32_t> vertices_;
  Spread spread_;
};

void add_product(sym3::Mat3<double>& m, const Vec3& a, const Vec3& b) {
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) m[3 * r + c] += a[r] * b[c];
  }
}

// The sum of the areas around a vertex, as long as its root; 0 where they cancel.
Vec3 vertex_normal(const Cage& cage, std::span<const std::uint32_t> triangles,
                   std::span<const mesh::Point> at) {
  Vec3 sum{0, 0, 0};
  double total = 0;
  for (const auto e : triangles) {
    const auto& [a, b, c] = cage.surface.triangles[e];
    const Vec3 area = cross(at[b] - at[a], at[c] - at[a]);
    sum = sum + area;
    total += norm(area);
  }
  return norm(sum) > least_area * total ? side_along(sum) : Vec3{0, 0, 0};
}

mesh::Adjacency movers(const Seeds& seeds, const Patches& patches) {
  return mesh::make_adjacency(seeds.centers.size(), [&](const auto& add) {
    for (std::uint32_t s = 0; s < seeds.centers.size(); ++s) {
      for (const auto v : seeds.corners.of(s)) add(s, v);
      for (const auto& p : patches.of(s)) add(s, p.vertex);
    }
  });
}

// posed normal(patch, positions) and center(patch, positions, origin).
template <class Normal, class Center>
class PatchMaps : public ElementMaps {
public:
  PatchMaps(const Cage& cage, MapGraph graph, const Seeds& seeds, Patches patches, Normal normal,
            Center center)
      : ElementMaps(std::move(graph), movers(seeds, patches)),
        cage_(cage),
        corners_(seeds.corners),
        rest_normals_(seeds.normals),
        patches_(std::move(patches)),
        normal_(std::move(normal)),
        center_(std::move(center)) {}

  // Near rest by how far vertices moved, the whole pose aside: exactly I where none did.
  void compute(std::span<const mesh::Point> posed, const Vec3& origin, std::span<const std::uint32_t> which,
               std::span<AffineMap> maps) const override {
    const auto& rest = cage_.surface.positions;
    const Vec3 rest_origin = middle(rest);
    const auto to = [&](std::uint32_t v) { return posed[v] - origin; };
    const auto way = [&](std::uint32_t v) { return to(v) - (rest[v] - rest_origin); };
    for (const auto e : which) {
      maps[e].center = center_(e, posed, origin);
      maps[e].linear = {1, 0, 0, 0, 1, 0, 0, 0, 1};
      if (graph().skipped[e]) continue;
      const bool near = is_near(e, way, rest);
      if (!near) maps[e].linear = {};
      auto& m = maps[e].linear;
      const Vec3 of_center = near ? mean(e, way) : mean(e, to);
      for (const auto& [v, dual] : patches_.of(e)) add_product(m, (near ? way(v) : to(v)) - of_center, dual);
      const Vec3& normal_dual = patches_.normal_duals[e];
      if (squared_norm(normal_dual) == 0) continue;
      const Vec3 normal = normal_(e, posed);
      add_product(m, near ? normal - rest_normals_[e] : normal, normal_dual);
    }
  }

private:
  template <class Of>
  Vec3 mean(std::uint32_t patch, const Of& of) const {
    const auto corners = corners_.of(patch);
    Vec3 sum{0, 0, 0};
    for (const auto v : corners) sum = sum + of(v);
    return (1.0 / static_cast<double>(corners.size())) * sum;
  }

  // Of patches that are not empty.
  template <class Way>
  bool is_near(std::uint32_t patch, const Way& way, std::span<const mesh::Point> rest) const {
    const Vec3 way_of_center = mean(patch, way), center = mean(patch, [&](auto v) { return rest[v]; });
    double moved = 0, size = 0;
    for (const auto& [v, dual] : patches_.of(patch)) {
      moved += squared_norm(way(v) - way_of_center);
      size += squared_norm(rest[v] - center);
    }
    return moved <= 0.25 * size;
  }

  const Cage& cage_;
  mesh::Adjacency corners_;
  std::vector<Vec3> rest_normals_;
  Patches patches_;
  Normal normal_;
  Center center_;
};

template <class Normal, class Center>
std::unique_ptr<const ElementMaps> patch_maps(const Cage& cage, double size, MapGraph graph, Seeds seeds,
                                              Normal normal, Center center) {
  const auto& rest = cage.surface.positions;
  const Vec3 zero{0, 0, 0};
  for (std::uint32_t s = 0; s < graph.count(); ++s) {
    seeds.centers.push_back(center(s, rest, zero));
    seeds.normals.push_back(normal(s, rest));
  }
  seeds.skipped = graph.skipped;
  Patches patches = PatchMaker(cage, size, seeds).make();
  return std::make_unique<PatchMaps<Normal, Center>>(cage, std::move(graph), seeds, std::move(patches),
                                                     std::move(normal), std::move(center));
}

}  // namespace

std::unique_ptr<const ElementMaps> face_patch_maps(const Cage& cage, double size) {
  MapGraph graph = face_graph(cage);
  Seeds seeds;
  seeds.corners = mesh::make_adjacency(graph.count(), [&](const auto& add) {
    for (std::uint32_t e = 0; e < graph.count(); ++e) {
      for (const auto v : cage.surface.triangles[e]) add(e, v);
    }
  });
  seeds.around = mesh::adjacency(graph.count(), graph.edges);
  return patch_maps(
      cage, size, std::move(graph), std::move(seeds),
      [&cage](std::uint32_t e, std::span<const mesh::Point> at) { return posed_normal(cage, e, at); },
      [&cage](std::uint32_t e, std::span<const mesh::Point> at, const Vec3& origin) {
        return element_center(cage, e, at, origin);
      });
}

std::unique_ptr<const ElementMaps> vertex_patch_maps(const Cage& cage, double size) {
  MapGraph graph = vertex_graph(cage);
  Seeds seeds;
  seeds.corners = mesh::make_adjacency(graph.count(), [&](const auto& add) {
    for (std::uint32_t v = 0; v < graph.count(); ++v) add(v, v);
  });
  seeds.around = mesh::adjacency(graph.count(), graph.edges);
  return patch_maps(
      cage, size, std::move(graph), std::move(seeds),
      [&cage, around = mesh::vertex_triangles(cage.surface.positions.size(), cage.surface.triangles)](
          std::uint32_t v, std::span<const mesh::Point> at) { return vertex_normal(cage, around.of(v), at); },
      [](std::uint32_t v, std::span<const mesh::Point> at, const Vec3& origin) { return at[v] - origin; });
}

}  // namespace viete::deform
