#include "deform/patch_maps.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "deform/face_maps.h"
#include "sym3/eigenvalues.h"

namespace viete::deform {

namespace {

using Symmetric = sym3::Sym3<double>;

constexpr double width_of_fit = 0.03;  // e, of the cage's diagonal
constexpr double least_spread = 0.1;   // of the largest singular value
constexpr double flat_spread = 1e-3;   // below it a patch lies in a plane
constexpr std::size_t most_vertices = 256;

// Sums of w x x^T, lengths in diagonals of the cage.
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

Vec3 times(const Symmetric& m, const Vec3& x) {
  return {m.xx * x[0] + m.xy * x[1] + m.xz * x[2], m.xy * x[0] + m.yy * x[1] + m.yz * x[2],
          m.xz * x[0] + m.yz * x[1] + m.zz * x[2]};
}

// Makes the patches one after the other; what it knows of vertices and elements is marked by the patch that
// saw them last.
class PatchMaker {
public:
  explicit PatchMaker(const Cage& cage)
      : cage_(cage),
        around_(cage.element_count()),
        seen_element_(cage.element_count(), none),
        seen_vertex_(cage.surface.positions.size(), none) {
    for (const auto& [a, b] : cage.dual_edges) {
      around_[a].push_back(b);
      around_[b].push_back(a);
    }
  }

  Patches make() {
    patches_.starts.push_back(0);
    patches_.normal_duals.assign(cage_.element_count(), {0, 0, 0});
    for (std::uint32_t e = 0; e < cage_.element_count(); ++e) {
      if (!cage_.degenerate[e]) add_patch(e);
      patches_.starts.push_back(patches_.vertices.size());
    }
    return std::move(patches_);
  }

private:
  static constexpr std::uint32_t none = ~0u;

  void add_patch(std::uint32_t element) {
    patch_ = element;
    vertices_.clear();
    spread_ = {};
    std::vector<std::uint32_t> ring = {element};
    seen_element_[element] = patch_;
    add_corners(element);
    do {
      ring = next_ring(ring);
      for (const auto e : ring) add_corners(e);
    } while (!ring.empty() && spread_.ratio() < least_spread && vertices_.size() < most_vertices);
    finish();
  }

  std::vector<std::uint32_t> next_ring(const std::vector<std::uint32_t>& ring) {
    std::vector<std::uint32_t> next;
    for (const auto e : ring) {
      for (const auto n : around_[e]) {
        if (std::exchange(seen_element_[n], patch_) != patch_) next.push_back(n);
      }
    }
    return next;
  }

  Vec3 from_center(std::uint32_t vertex) const {
    return (1 / cage_.diagonal) * (cage_.surface.positions[vertex] - cage_.centers[patch_]);
  }
  static double weight(const Vec3& x) { return 1 / (width_of_fit * width_of_fit + squared_norm(x)); }

  void add_corners(std::uint32_t element) {
    for (const auto v : cage_.surface.triangles[element]) {
      if (std::exchange(seen_vertex_[v], patch_) == patch_) continue;
      const Vec3 x = from_center(v);
      spread_.add(weight(x), x);
      vertices_.push_back(v);
    }
  }

  void finish() {
    const double scale = 1 / cage_.diagonal;
    if (spread_.ratio() < flat_spread) {
      const Vec3 n = scale * cage_.bases[patch_].n;
      const double w = spread_.largest() / squared_norm(n);
      spread_.add(w, n);
      patches_.normal_duals[patch_] = (scale * w) * times(inverse(spread_.k), n);
    }
    const Symmetric k = inverse(spread_.k);
    for (const auto v : vertices_) {
      const Vec3 x = from_center(v);
      patches_.vertices.push_back({v, (scale * weight(x)) * times(k, x)});
    }
  }

  const Cage& cage_;
  std::vector<std::vector<std::uint32_t>> around_;
  std::vector<std::uint32_t> seen_element_, seen_vertex_;
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

}  // namespace

Patches make_patches(const Cage& cage) {
  return PatchMaker(cage).make();
}

// By how far vertices moved, the whole pose aside: exactly I where none did.
void patch_maps(const Cage& cage, const Patches& patches, std::span<const mesh::Point> posed,
                const Vec3& origin, std::span<const std::uint32_t> elements, std::span<AffineMap> maps) {
  const auto& rest = cage.surface.positions;
  const Vec3 rest_origin = middle(rest);
  const auto way = [&](std::uint32_t v) { return (posed[v] - origin) - (rest[v] - rest_origin); };
  for (const auto e : elements) {
    maps[e] = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, element_center(cage, e, posed, origin)};
    auto& m = maps[e].linear;
    const auto [a, b, c] = cage.surface.triangles[e];
    const Vec3 way_of_center = (1.0 / 3) * (way(a) + way(b) + way(c));
    for (const auto& [v, dual] : patches.of(e)) add_product(m, way(v) - way_of_center, dual);
    const Vec3& normal_dual = patches.normal_duals[e];
    if (squared_norm(normal_dual) == 0) continue;
    add_product(m, posed_normal(cage, e, posed) - cage.bases[e].n, normal_dual);
  }
}

}  // namespace viete::deform
