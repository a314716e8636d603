#include "deform/pose_space.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "deform/branches.h"
#include "deform/cage_state.h"
#include "deform/face_maps.h"
#include "deform/linear_map.h"
#include "mesh/point_index.h"
#include "sym3/exp.h"
#include "deform/all_element_maps.h"
#include "deform/laplacian.h"

namespace viete::deform {

namespace {

constexpr std::uint32_t no_part = 0xFFFFFFFF;
// Of the farthest motion, squared: added to all. What stands still counts 1e14 times as much as what moves
// farthest.
constexpr double stillness = 1e-7;
// A map that turns, or stretches, by less has its fixed point so far away that ways to there are straight.
constexpr double least_motion = 1e-4;
// Relative: directions in which those that count are less spread tell nothing.
constexpr double told_spread = 1e-9;
// Radians that the mean of a part's logs is from its turns, at most, where these are what the logs tell.
constexpr double tells_turns = 0.5;

std::array<double, 9> numbers(const MapLog& log) {
  const auto& [x, y, center] = log;
  return {x.xx, x.xy, x.xz, x.yy, x.yz, x.zz, y[0], y[1], y[2]};
}

sym3::Mat3<double> linear_of(const std::array<double, 9>& log) {
  const sym3::Sym3<double> stretch{log[0], log[1], log[2], log[3], log[4], log[5]};
  return times(sym3::exp_rotation<double>({log[6], log[7], log[8]}), full(sym3::exp(stretch)));
}

// Of each vertex the first one that is at the same place.
std::vector<std::uint32_t> first_at_place(const std::vector<mesh::Point>& positions) {
  mesh::PointIndex index;
  std::vector<mesh::Point> places;
  std::vector<std::uint32_t> first_of, place_of(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const std::uint32_t place = index.find_or_add(positions[v], places);
    if (place == places.size()) places.push_back(positions[v]), first_of.push_back(v);
    place_of[v] = first_of[place];
  }
  return place_of;
}

std::vector<std::uint32_t> triangles_with_area(const Cage& cage) {
  std::vector<std::uint32_t> triangles;
  for (std::uint32_t e = 0; e < cage.element_count(); ++e)
    if (!cage.degenerate[e]) triangles.push_back(e);
  return triangles;
}

void add(std::vector<Vec3>& sum, const std::vector<Vec3>& term, double factor) {
  for (std::size_t i = 0; i < sum.size() && i < term.size(); ++i) sum[i] = sum[i] + factor * term[i];
}

Eigen::Vector3d eigen(const Vec3& v) {
  return {v[0], v[1], v[2]};
}

// The affine map that fits the ways of some vertices, by their weights: way = mean + slope (x - center).
struct AffineFit {
  Vec3 center{0, 0, 0};
  Eigen::Matrix3d inverse_spread = Eigen::Matrix3d::Zero();  // of the places, where they are spread
  Eigen::Vector3d to_fixed_point{0, 0, 0};  // from the centre; less, the less of the ways it explains
};

double smooth_step(double from, double to, double x) {
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// Inverse of a symmetric matrix in the directions in which it is not small.
Eigen::Matrix3d inverse_where_large(const Eigen::Matrix3d& m) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(m);
  Eigen::Vector3d inverse{0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    const double value = solver.eigenvalues()[k];
    if (value > told_spread * solver.eigenvalues()[2]) inverse[k] = 1 / value;
  }
  return solver.eigenvectors() * inverse.asDiagonal() * solver.eigenvectors().transpose();
}

AffineFit fit_of(std::span<const std::uint32_t> vertices, std::span<const double> weights,
                 std::span<const Vec3> places, std::span<const Vec3> ways) {
  AffineFit fit;
  Vec3 mean{0, 0, 0};
  for (const auto v : vertices) {
    fit.center = fit.center + weights[v] * places[v];
    mean = mean + weights[v] * ways[v];
  }
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero(), across = Eigen::Matrix3d::Zero();
  double all = 0;
  for (const auto v : vertices) {
    const Eigen::Vector3d x = eigen(places[v] - fit.center), d = eigen(ways[v] - mean);
    spread += weights[v] * x * x.transpose();
    across += weights[v] * d * x.transpose();
    all += weights[v] * d.squaredNorm();
  }
  fit.inverse_spread = inverse_where_large(spread);
  const Eigen::Matrix3d slope = across * fit.inverse_spread;
  const double explained = (slope * across.transpose()).trace();
  if (!(all > 0)) return fit;
  Eigen::JacobiSVD<Eigen::Matrix3d> svd(slope, Eigen::ComputeFullU | Eigen::ComputeFullV);
  for (int k = 0; k < 3; ++k) {
    const double s = svd.singularValues()[k];
    if (s > least_motion)
      fit.to_fixed_point -= svd.matrixU().col(k).dot(eigen(mean)) / s * svd.matrixV().col(k);
  }
  fit.to_fixed_point *= smooth_step(0.9, 0.99, explained / all);
  return fit;
}

}  // namespace

PoseVector sum(const Cage& cage, std::span<const PoseTerm> terms) {
  PoseVector s{std::vector<std::array<double, 9>>(cage.element_count()),
               std::vector<Vec3>(cage.surface.positions.size()),
               std::vector<Vec3>(cage.surface.positions.size()), std::vector<Vec3>(cage.roots.size()),
               std::vector<Vec3>(cage.roots.size())};
  for (const auto& [vector, factor] : terms) {
    for (std::size_t e = 0; e < s.logs.size(); ++e)
      for (std::size_t k = 0; k < 9; ++k) s.logs[e][k] += factor * vector->logs[e][k];
    add(s.leftovers, vector->leftovers, factor);
    add(s.ways, vector->ways, factor);
    add(s.turns, vector->turns, factor);
    add(s.wholes, vector->wholes, factor);
  }
  return s;
}

PoseSpace::PoseSpace(std::shared_ptr<const Cage> cage)
    : cage_(std::move(cage)), elements_(element_maps(*cage_, Elements::face)), system_(system_of(*cage_)) {}

PoseSpace::System PoseSpace::system_of(const Cage& cage) {
  const auto& positions = cage.surface.positions;
  std::vector<std::uint32_t> triangles = triangles_with_area(cage), places = first_at_place(positions);
  std::vector<mesh::Triangle> placed;
  std::vector<Vec3> cotangents;
  std::vector<bool> used(positions.size());
  for (const auto e : triangles) {
    const auto& [a, b, c] = cage.surface.triangles[e];
    placed.push_back({places[a], places[b], places[c]});
    cotangents.push_back(half_cotangents(positions[a], positions[b], positions[c]));
    for (const auto v : placed.back()) used[v] = true;
  }
  const SparseMatrix stiffness = stiffness_matrix(positions, placed);
  mesh::UnionFind sets = connected(stiffness);
  std::vector<std::uint32_t> part_of_set(positions.size(), no_part), part_of(positions.size(), no_part);
  std::uint32_t part_count = 0;
  std::vector<bool> free(positions.size()), loose(positions.size());
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    loose[v] = !used[places[v]];
    if (loose[v]) continue;
    std::uint32_t& part = part_of_set[sets.find(places[v])];
    if (part == no_part) {
      part = part_count++;
    } else {
      free[v] = places[v] == v;
    }
    part_of[v] = part;
  }
  mesh::Adjacency parts = mesh::make_adjacency(part_count, [&](const auto& add) {
    for (std::uint32_t v = 0; v < positions.size(); ++v)
      if (!loose[v]) add(part_of[v], v);
  });
  base::WorkerPool one(1);
  SparseCholesky factors(grounded(stiffness, free), one);
  return {std::move(triangles), std::move(cotangents), std::move(places), std::move(parts),
          std::move(loose),     std::move(free),       std::move(factors)};
}

// From rest, the grounded vertex of each part staying where it is.
std::vector<Vec3> PoseSpace::following(const PoseVector& vector) const {
  const auto& rest = cage_->surface.positions;
  std::vector<Vec3> ways(rest.size());
  std::vector<sym3::Mat3<double>> turned;
  for (const Vec3& whole : vector.wholes) turned.push_back(sym3::exp_rotation(whole));
  for (std::size_t i = 0; i < system_.triangles.size(); ++i) {
    const auto e = system_.triangles[i];
    const auto& corners = cage_->surface.triangles[e];
    sym3::Mat3<double> motion = linear_of(vector.logs[e]);
    if (vector.wholes[cage_->parts[e]] != Vec3{0, 0, 0}) motion = times(turned[cage_->parts[e]], motion);
    for (int k = 0; k < 9; k += 4) motion[k] -= 1;
    for (int k = 0; k < 3; ++k) {
      const auto a = corners[(k + 1) % 3], b = corners[(k + 2) % 3];
      const Vec3 pull = system_.cotangents[i][k] * times(motion, rest[a] - rest[b]);
      Vec3 &at_a = ways[system_.places[a]], &at_b = ways[system_.places[b]];
      at_a = at_a + pull, at_b = at_b - pull;
    }
  }
  for (std::size_t v = 0; v < ways.size(); ++v)
    if (!system_.free[v]) ways[v] = {0, 0, 0};
  SparseCholesky::Workspace work;
  system_.factors.solve(ways, ways, work);
  for (std::size_t v = 0; v < ways.size(); ++v) ways[v] = ways[system_.places[v]];
  return ways;
}

// Whole turns that the logs of a part do not tell; its logs become those without them.
std::vector<Vec3> PoseSpace::take_wholes(std::span<const AffineMap> maps, std::span<const MapSplit> splits,
                                         const LogReport& report, std::vector<MapLog>& logs) const {
  std::vector<Vec3> wholes(report.turns.size()), sums(wholes.size() + 1);
  std::vector<double> counts(sums.size());
  for (std::size_t e = 0; e < logs.size(); ++e) {
    const auto part = cage_->parts[e];
    sums[part] = sums[part] + logs[e].rotation, counts[part] += 1;
  }
  const auto tell = [&](std::size_t part) {
    return norm(report.turns[part] - (1 / counts[part]) * sums[part]) < tells_turns;
  };
  std::vector<MapLog> least(logs.size());
  LogReport of_least;
  for (std::size_t part = 0; part < wholes.size(); ++part) {
    if (counts[part] == 0 || tell(part)) continue;
    if (of_least.turns.empty()) log_maps(elements_->graph(), maps, splits, {}, least, of_least);
    const Vec3& turn = report.turns[part];
    const double count = whole_turns(turn, of_least.turns[part]);
    if (count == 0) continue;
    wholes[part] = with_whole_turns((1 / norm(turn)) * turn, count, {0, 0, 0});
    for (std::size_t e = 0; e < logs.size(); ++e)
      if (cage_->parts[e] == part) logs[e] = least[e];
  }
  return wholes;
}

PoseVector PoseSpace::vector(const Pose& pose, std::span<const Vec3> turns_before) const {
  check_pose(*cage_, pose);
  const auto& rest = cage_->surface.positions;
  std::vector<std::uint32_t> all(elements_->count());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<AffineMap> maps(all.size());
  std::vector<MapSplit> splits(all.size());
  std::vector<MapLog> logs(all.size());
  elements_->compute(pose.positions, pose_origin(*cage_, pose.positions), all, maps);
  split_maps(maps, all, splits);
  LogReport report;
  log_maps(elements_->graph(), maps, splits, pose.turns.empty() ? turns_before : pose.turns, logs, report);

  PoseVector vector;
  vector.wholes = take_wholes(maps, splits, report, logs);
  for (const MapLog& log : logs) vector.logs.push_back(numbers(log));
  vector.turns = std::move(report.turns);
  vector.leftovers = following(vector);
  for (std::size_t v = 0; v < rest.size(); ++v) {
    vector.ways.push_back(pose.positions[v] - rest[v]);
    vector.leftovers[v] = vector.ways[v] - vector.leftovers[v];
  }
  center(vector.leftovers);
  return vector;
}

// Where a part is, is told by the point that is held: only its shape is left over.
void PoseSpace::center(std::vector<Vec3>& leftovers) const {
  for (std::size_t part = 0; part + 1 < system_.parts.starts.size(); ++part) {
    const auto vertices = system_.parts.of(part);
    Vec3 mean{0, 0, 0};
    for (const auto v : vertices) mean = mean + leftovers[v];
    mean = (1 / static_cast<double>(vertices.size())) * mean;
    for (const auto v : vertices) leftovers[v] = leftovers[v] - mean;
  }
}

Pose PoseSpace::straight(const PoseVector& vector) const {
  Pose pose{cage_->surface.positions, vector.turns};
  add(pose.positions, vector.ways, 1);
  return pose;
}

Pose PoseSpace::pose(const PoseVector& vector, const Held& held) const {
  Pose pose{following(vector), vector.turns};
  for (std::size_t v = 0; v < pose.positions.size(); ++v)
    pose.positions[v] = system_.loose[v] ? vector.ways[v] : pose.positions[v] + vector.leftovers[v];
  hold(pose.positions, vector, held);
  add(pose.positions, cage_->surface.positions, 1);
  return pose;
}

Held PoseSpace::held_from(const PoseVector& from, std::span<const PoseTerm> terms) const {
  const Pose start = straight(from);
  std::vector<Vec3> ways(start.positions.size());
  std::vector<double> squares(start.positions.size());
  for (const auto& [vector, factor] : terms) {
    add(ways, vector->ways, factor);
    for (std::size_t v = 0; v < ways.size(); ++v)
      squares[v] += std::abs(factor) * squared_norm(vector->ways[v]);
  }
  return held(start.positions, ways, squares);
}

Held PoseSpace::held_between(const PoseVector& from, const PoseVector& to) const {
  const Pose start = straight(from);
  std::vector<Vec3> ways = to.ways;
  add(ways, from.ways, -1);
  std::vector<double> squares;
  for (const Vec3& way : ways) squares.push_back(squared_norm(way));
  return held(start.positions, ways, squares);
}

// Weights are those of the vertices, completed by a linear function of their places so that their mean is the
// fixed point of the affine map that fits the ways.
Held PoseSpace::held(std::span<const Vec3> from, std::span<const Vec3> ways,
                     std::span<const double> squares) const {
  const double farthest = squares.empty() ? 0 : *std::max_element(squares.begin(), squares.end());
  Held held(from.size());
  for (std::size_t part = 0; part + 1 < system_.parts.starts.size(); ++part) {
    const auto vertices = system_.parts.of(part);
    double total = 0;
    for (const auto v : vertices) {
      const double moved = farthest > 0 ? squares[v] / farthest + stillness : 1;
      total += held[v] = 1 / (moved * moved);
    }
    for (const auto v : vertices) held[v] /= total;
    const AffineFit fit = fit_of(vertices, held, from, ways);
    const Eigen::Vector3d slope = fit.inverse_spread * fit.to_fixed_point;
    for (const auto v : vertices) held[v] *= 1 + slope.dot(eigen(from[v] - fit.center));
  }
  return held;
}

void PoseSpace::hold(std::vector<Vec3>& ways, const PoseVector& vector, const Held& held) const {
  for (std::size_t part = 0; part + 1 < system_.parts.starts.size(); ++part) {
    Vec3 missing{0, 0, 0};
    for (const auto v : system_.parts.of(part)) missing = missing + held[v] * (vector.ways[v] - ways[v]);
    for (const auto v : system_.parts.of(part)) ways[v] = ways[v] + missing;
  }
}

}  // namespace viete::deform
