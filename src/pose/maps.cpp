#include "pose/maps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "mesh/normals.h"
#include "pose/branches.h"
#include "sym3/eigenvalues.h"
#include "sym3/log.h"
#include "sym3/polar.h"

namespace viete::pose {

namespace {

double longest_side(const mesh::Bounds& box) {
  return largest_abs(box.high - box.low);
}

}  // namespace

Vec3 middle(std::span<const mesh::Point> positions) {
  return mesh::bounds(positions).center();
}

Vec3 pose_origin(const Cage& cage, std::span<const mesh::Point> posed) {
  const mesh::Bounds rest = mesh::bounds(cage.surface.positions), pose = mesh::bounds(posed);
  const double size = std::min(longest_side(rest), longest_side(pose));
  const double step = size > 0 ? std::exp2(std::floor(std::log2(size))) : 0;
  Vec3 origin = rest.center();
  const Vec3 way = pose.center() - origin;
  for (int i = 0; i < 3; ++i) origin[i] += step * std::round(way[i] / step);
  return std::isfinite(squared_norm(origin)) ? origin : pose.center();
}

sym3::Mat3<double> linear_map(const RestBasis& rest, const Vec3& u, const Vec3& v, const Vec3& n) {
  const Vec3 change_u = u - rest.u, change_v = v - rest.v, change_n = n - rest.n;
  const bool near =
      squared_norm(change_u) + squared_norm(change_v) < 0.25 * (squared_norm(rest.u) + squared_norm(rest.v));
  const Vec3 &a = near ? change_u : u, &b = near ? change_v : v, &c = near ? change_n : n;
  sym3::Mat3<double> m{};
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      m[3 * i + j] = (near && i == j ? 1.0 : 0.0) +
                     (a[i] * rest.dual_u[j] + b[i] * rest.dual_v[j] + c[i] * rest.dual_n[j]);
    }
  return m;
}

void face_maps(const Cage& cage, std::span<const mesh::Point> posed, const Vec3& origin,
               std::span<const std::uint32_t> elements, std::span<AffineMap> maps) {
  const std::vector<mesh::Point> at = with_centers(cage, posed);
  for (const auto e : elements) {
    const auto& [a, b, c] = cage.elements.triangles[e];
    maps[e] = {{1, 0, 0, 0, 1, 0, 0, 0, 1},
               (1.0 / 3) * ((at[a] - origin) + (at[b] - origin) + (at[c] - origin))};
    if (cage.degenerate[e]) continue;
    const auto [u, v, n] = triangle_basis(at, cage.elements.triangles[e], cage.bases[e].corner);
    maps[e].linear = linear_map(cage.bases[e], u, v, n);
  }
}

namespace {

constexpr std::size_t portion = 64;  // elements split at once; their data fit into the first-level cache

/// N numbers for each element of a portion. at[i][n] is number i of element n.
template <int N>
struct Planes {
  alignas(64) double at[N][portion + 8];

  sym3::View<double, N> view() { return {at[0], portion + 8}; }
  sym3::View<const double, N> view() const { return {at[0], portion + 8}; }
};

// Computes the symmetric part of R^T * M.
void stretches(const Planes<9>& r, const Planes<9>& m, std::size_t count, Planes<6>& out) {
  const auto entry = [&](int i, int j, std::size_t n) {
    return r.at[i][n] * m.at[j][n] + r.at[3 + i][n] * m.at[3 + j][n] + r.at[6 + i][n] * m.at[6 + j][n];
  };
  for (std::size_t n = 0; n < count; ++n) {
    out.at[0][n] = entry(0, 0, n);
    out.at[1][n] = 0.5 * entry(0, 1, n) + 0.5 * entry(1, 0, n);
    out.at[2][n] = 0.5 * entry(0, 2, n) + 0.5 * entry(2, 0, n);
    out.at[3][n] = entry(1, 1, n);
    out.at[4][n] = 0.5 * entry(1, 2, n) + 0.5 * entry(2, 1, n);
    out.at[5][n] = entry(2, 2, n);
  }
}

void split_portion(std::span<const AffineMap> maps, std::span<const std::uint32_t> elements,
                   std::span<MapSplit> splits) {
  const std::size_t count = elements.size();
  Planes<9> m, r;
  Planes<6> s, x;
  Planes<3> turns, values;
  for (std::size_t n = 0; n < count; ++n) {
    for (int k = 0; k < 9; ++k) m.at[k][n] = maps[elements[n]].linear[k];
  }
  sym3::polar(std::as_const(m).view(), r.view(), count);
  sym3::log_rotation(std::as_const(r).view(), turns.view(), count);
  stretches(r, m, count, s);
  sym3::log(std::as_const(s).view(), x.view(), count);
  sym3::eigenvalues(std::as_const(s).view(), values.view(), count);
  for (std::size_t n = 0; n < count; ++n) {
    MapSplit& out = splits[elements[n]];
    for (int k = 0; k < 9; ++k) out.rotation[k] = r.at[k][n];
    out.stretch = {x.at[0][n], x.at[1][n], x.at[2][n], x.at[3][n], x.at[4][n], x.at[5][n]};
    out.turn = {turns.at[0][n], turns.at[1][n], turns.at[2][n]};
    out.least = values.at[0][n];
    out.largest = values.at[2][n];
  }
}

}  // namespace

void split_maps(std::span<const AffineMap> maps, std::span<const std::uint32_t> elements,
                std::span<MapSplit> splits) {
  for (std::size_t n = 0; n < elements.size(); n += portion) {
    split_portion(maps, elements.subspan(n, std::min(portion, elements.size() - n)), splits);
  }
}

namespace {

using RowMajor = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

// Returns the result for a matrix that is not finite. Eigen cannot decompose such a matrix.
Polar not_a_number() {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  Polar result;
  result.rotation.fill(nan);
  result.axes.fill(nan);
  result.stretches.fill(nan);
  return result;
}

}  // namespace

Polar polar(const sym3::Mat3<double>& m) {
  const Eigen::Matrix3d matrix = Eigen::Map<const RowMajor>(m.data());
  const Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  if (svd.info() != Eigen::Success) return not_a_number();
  Eigen::Matrix3d u = svd.matrixU();
  if (u.determinant() * svd.matrixV().determinant() < 0) u.col(2) = -u.col(2);
  Polar result;
  Eigen::Map<RowMajor>(result.rotation.data()) = u * svd.matrixV().transpose();
  Eigen::Map<RowMajor>(result.axes.data()) = svd.matrixV();
  for (int i = 0; i < 3; ++i) result.stretches[i] = svd.singularValues()[i];
  return result;
}

sym3::Sym3<double> log_stretch(const Polar& polar) {
  const auto& v = polar.axes;
  const Vec3 l{std::log(polar.stretches[0]), std::log(polar.stretches[1]), std::log(polar.stretches[2])};
  const auto entry = [&](int r, int c) {
    return v[3 * r] * l[0] * v[3 * c] + v[3 * r + 1] * l[1] * v[3 * c + 1] +
           v[3 * r + 2] * l[2] * v[3 * c + 2];
  };
  return {entry(0, 0), entry(0, 1), entry(0, 2), entry(1, 1), entry(1, 2), entry(2, 2)};
}

namespace {

constexpr double flatness_floor = 1e-3;   // relative to the element's largest stretch
constexpr double size_floor = 1e-4;       // relative to the pose's mean stretch
constexpr double smallest_floor = 1e-12;  // for a pose collapsed to one point

double floor_of(double largest, double mean) {
  const double floor = std::max(flatness_floor * largest, size_floor * mean);
  return floor > 0 ? floor : smallest_floor;
}

bool finite(const sym3::Mat3<double>& m) {
  return std::all_of(m.begin(), m.end(), [](double x) { return std::isfinite(x); });
}

// Splits the map by SVD. Returns true if the minimum replaced a singular value or the map is not finite.
bool split_collapsed(const AffineMap& map, double mean, MapSplit& split) {
  const bool usable = finite(map.linear);
  Polar p =
      usable ? polar(map.linear) : Polar{{1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 0, 0, 0, 1, 0, 0, 0, 1}, {1, 1, 1}};
  const double floor = floor_of(p.stretches[0], mean);
  const bool raised = p.stretches[2] < floor;
  for (double& s : p.stretches) s = std::max(s, floor);
  split.rotation = p.rotation;
  split.stretch = log_stretch(p);
  split.turn = sym3::log_rotation(p.rotation);
  return raised || !usable;
}

bool torn(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b, const Vec3& log_a, const Vec3& log_b) {
  return alignment(a, b) < 0 || norm(log_a - log_b) > std::numbers::pi;
}

}  // namespace

double mean_stretch(std::span<const std::uint8_t> skipped, std::span<const MapSplit> splits) {
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t e = 0; e < splits.size(); ++e) {
    if (skipped[e] || !(splits[e].largest > 0)) continue;
    sum += std::log(splits[e].largest);
    ++count;
  }
  return count ? std::exp(sum / static_cast<double>(count)) : 0;
}

bool is_ordinary(double least, double largest, double mean) {
  return least >= floor_of(largest, mean);
}

bool raise_to_floor(const AffineMap& map, double mean, MapSplit& split) {
  return !is_ordinary(split.least, split.largest, mean) && split_collapsed(map, mean, split);
}

void log_maps(const Cage& cage, std::span<const AffineMap> maps, std::span<const MapSplit> splits,
              std::span<const Vec3> turns, std::span<MapLog> logs, LogReport& report) {
  report = {};
  const double mean = mean_stretch(cage.degenerate, splits);
  std::vector<sym3::Mat3<double>> rotations(maps.size());
  std::vector<Vec3> principal(maps.size());
  for (std::uint32_t e = 0; e < maps.size(); ++e) {
    MapSplit split = splits[e];
    if (!cage.degenerate[e] && raise_to_floor(maps[e], mean, split)) report.collapsed.push_back(e);
    rotations[e] = split.rotation;
    principal[e] = split.turn;
    logs[e] = {split.stretch, {0, 0, 0}, maps[e].center};
  }
  Branches branches = choose_branches(cage, rotations, principal, turns);
  for (std::size_t e = 0; e < logs.size(); ++e) logs[e].rotation = branches.logs[e];
  report.turns = std::move(branches.turns);
  for (const auto& pair : cage.dual_edges) {
    const auto [i, j] = pair;
    if (torn(rotations[i], rotations[j], logs[i].rotation, logs[j].rotation)) report.torn.push_back(pair);
  }
}

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
