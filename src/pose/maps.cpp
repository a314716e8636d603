#include "pose/maps.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

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

}  // namespace viete::pose
