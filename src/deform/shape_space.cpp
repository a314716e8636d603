#include "deform/shape_space.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "deform/branches.h"
#include "deform/dual_graph.h"
#include "deform/face_maps.h"
#include "deform/linear_map.h"
#include "deform/log_maps.h"
#include "mesh/triangle.h"
#include "sym3/eigenvalues.h"
#include "sym3/polar.h"

namespace viete::deform {

namespace {

using Mat = sym3::Mat3<double>;

constexpr std::size_t triangles_at_once = 256;
// Of the mean map's largest singular value: where the two smallest sum to less, no rotation is the nearest.
constexpr double tells_turn = 1e-3;
constexpr int passes_of_folded = 8;
// Radians from a neighbour's log: from where on a rotation is doubted, and where nothing is left of it.
constexpr double doubted = 0.3, given_up = 1;

Mat transposed(const Mat& m) {
  return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
}

void refuse_positions(std::span<const mesh::Point> positions, std::size_t expected) {
  if (positions.size() != expected)
    throw base::Error(
        "",
        "a shape of " + std::to_string(positions.size()) + " vertices is none of " + std::to_string(expected),
        "choose a shape of the same model");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!std::isfinite(squared_norm(positions[v])))
      throw base::Error("",
                        "vertex " + std::to_string(v) +
                            " (from 0) of the shape is nowhere: its position is not a finite number",
                        "repair the file");
  }
}

}  // namespace

// Where triangles turn against all that are around them, or collapsed, the neighbours tell.
class ShapeSpace::Folds {
public:
  Folds(const WeightedPairs& neighbours, std::span<const MapSplit> splits, std::vector<std::uint8_t> bad)
      : neighbours_(neighbours), bad_(std::move(bad)) {
    for (std::uint32_t t = 0; t < bad_.size(); ++t) {
      const auto around = neighbours.around.of(t);
      const auto against = [&](std::uint32_t n) {
        const auto& [a, b] = neighbours.pairs[n];
        return alignment(splits[a].rotation, splits[b].rotation) < 0;
      };
      if (around.size() > 1 && std::ranges::all_of(around, against)) bad_[t] = 1;
    }
  }

  std::size_t count() const { return static_cast<std::size_t>(std::ranges::count(bad_, 1)); }

  void spread(std::vector<std::array<double, 9>>& logs) {
    for (int pass = 0; pass < passes_of_folded; ++pass) {
      std::vector<std::uint32_t> mended;
      for (std::uint32_t t = 0; t < bad_.size(); ++t)
        if (bad_[t] && take_mean(t, logs)) mended.push_back(t);
      for (const auto t : mended) bad_[t] = 0;
      if (mended.empty()) return;
    }
  }

private:
  bool take_mean(std::uint32_t t, std::vector<std::array<double, 9>>& logs) const {
    std::array<double, 9> sum{};
    double weight = 0;
    for (const auto n : neighbours_.around.of(t)) {
      const auto& [a, b] = neighbours_.pairs[n];
      const auto s = a == t ? b : a;
      if (bad_[s]) continue;
      for (std::size_t k = 0; k < 9; ++k) sum[k] += neighbours_.weights[n] * logs[s][k];
      weight += neighbours_.weights[n];
    }
    if (!(weight > 0)) return false;
    for (std::size_t k = 0; k < 9; ++k) logs[t][k] = sum[k] / weight;
    return true;
  }

  const WeightedPairs& neighbours_;
  std::vector<std::uint8_t> bad_;
};

ShapeSpace::ShapeSpace(const mesh::Surface& rest, base::WorkerPool& pool, base::Progress* progress)
    : triangles_(triangles_of(rest)), logs_(logs_of(rest, triangles_, pool, progress)) {}

ShapeSpace::Triangles ShapeSpace::triangles_of(const mesh::Surface& rest) {
  Triangles all{rest.triangles, {}, {}, {}, {}};
  const auto& p = rest.positions;
  const double unit = mesh::used_bounds(rest).diagonal();
  for (const auto& t : rest.triangles) {
    const auto& [a, b, c] = t;
    all.flat.push_back(!mesh::has_area(p[a], p[b], p[c]));
    all.bases.push_back(all.flat.back() ? RestBasis{} : rest_basis(p, t));
    const double scale = unit > 0 ? 1 / unit : 0;
    all.areas.push_back(norm(cross(scale * (p[b] - p[a]), scale * (p[c] - p[a]))) / 2);
  }
  if (std::ranges::find(all.flat, 0) == all.flat.end())
    throw base::Error("", "the model has no triangle with area", "choose a model that is a surface");
  all.neighbours = weighted_pairs(dual_graph(rest, all.flat).edges, all.areas);
  return all;
}

LogSpace ShapeSpace::logs_of(const mesh::Surface& rest, const Triangles& triangles, base::WorkerPool& pool,
                             base::Progress* progress) {
  const std::vector<std::uint32_t> one_part(rest.triangles.size(), 0);
  return LogSpace({rest.positions, rest.triangles, triangles.flat, one_part, 1}, pool, progress);
}

std::vector<AffineMap> ShapeSpace::maps_to(std::span<const mesh::Point> positions,
                                           base::WorkerPool& pool) const {
  std::vector<AffineMap> maps(triangles_.corners.size());
  pool.for_blocks(maps.size(), triangles_at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t t = begin; t < end; ++t) {
      maps[t] = {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
      if (triangles_.flat[t]) continue;
      const RestBasis& rest = triangles_.bases[t];
      const auto [u, v, n] = triangle_basis(positions, triangles_.corners[t], rest.corner);
      maps[t].linear = linear_map(rest, u, v, n);
    }
  });
  return maps;
}

// The rotation nearest to the mean of the maps, by area.
Vec3 ShapeSpace::mean_turn(std::span<const AffineMap> maps) const {
  Mat sum{};
  for (std::size_t t = 0; t < maps.size(); ++t)
    for (std::size_t k = 0; k < 9; ++k) sum[k] += triangles_.areas[t] * maps[t].linear[k];
  const auto [rotation, stretch] = sym3::polar(sum);
  const auto singular = sym3::eigenvalues(stretch);  // ascending, the sign of the determinant in the first
  if (!(singular[0] + singular[1] > tells_turn * singular[2])) return {0, 0, 0};
  return sym3::log_rotation(rotation);
}

void ShapeSpace::doubt(std::span<const Vec3> turns, std::vector<LogVector::Doubt>& doubts) const {
  std::vector<double> farthest(turns.size());
  for (const auto& [a, b] : triangles_.neighbours.pairs) {
    const double distance = norm(turns[a] - turns[b]);
    farthest[a] = std::max(farthest[a], distance), farthest[b] = std::max(farthest[b], distance);
  }
  for (std::uint32_t t = 0; t < turns.size(); ++t) {
    const double share = std::clamp((farthest[t] - doubted) / (given_up - doubted), 0.0, 1.0);
    if (share > 0 && !triangles_.flat[t]) doubts.push_back({t, share});
  }
}

// Logs of the rotations without that of the whole.
std::vector<Vec3> ShapeSpace::turns_of(const Vec3& whole, std::span<const MapSplit> splits,
                                       const LogVector* before) const {
  const Mat back = transposed(sym3::exp_rotation(whole));
  std::vector<Mat> rotations;
  std::vector<Vec3> logs(splits.size());
  for (const MapSplit& split : splits) rotations.push_back(times(back, split.rotation));
  sym3::log_rotation(sym3::MatView<const double>{sym3::Layout::packed, rotations[0].data()},
                     sym3::VecView<double>{sym3::Layout::packed, logs[0].data()}, splits.size());
  for (std::size_t t = 0; before && t < splits.size(); ++t) {
    const auto& log = before->logs[t];
    logs[t] = nearest_branch(logs[t], {log[6], log[7], log[8]});
  }
  make_coherent(triangles_.neighbours, rotations, logs);
  return logs;
}

std::vector<MapSplit> ShapeSpace::splits_of(std::span<const AffineMap> maps, base::WorkerPool& pool) const {
  std::vector<std::uint32_t> all(maps.size());
  std::iota(all.begin(), all.end(), 0u);
  std::vector<MapSplit> splits(maps.size());
  pool.for_blocks(maps.size(), triangles_at_once, [&](std::size_t begin, std::size_t end) {
    split_maps(maps, std::span(all).subspan(begin, end - begin), splits);
  });
  return splits;
}

LogVector ShapeSpace::vector(std::span<const mesh::Point> positions, base::WorkerPool& pool,
                             const LogVector* before, ShapeReport* report) const {
  refuse_positions(positions, logs_.rest().size());
  const std::vector<AffineMap> maps = maps_to(positions, pool);
  std::vector<MapSplit> splits = splits_of(maps, pool);
  const double mean = mean_stretch(triangles_.flat, splits);
  std::vector<std::uint8_t> collapsed(maps.size());
  for (std::size_t t = 0; t < maps.size(); ++t)
    collapsed[t] = triangles_.flat[t] ? 0 : raise_to_floor(maps[t], mean, splits[t]);
  Folds folds(triangles_.neighbours, splits, std::move(collapsed));

  LogVector vector;
  vector.wholes = {nearest_branch(mean_turn(maps), before ? before->wholes[0] : Vec3{0, 0, 0})};
  const std::vector<Vec3> turns = turns_of(vector.wholes[0], splits, before);
  for (std::size_t t = 0; t < maps.size(); ++t)
    vector.logs.push_back(numbers({splits[t].stretch, turns[t], {0, 0, 0}}));
  if (report)
    *report = {static_cast<std::size_t>(std::ranges::count(triangles_.flat, 1)), folds.count(),
               torn_pairs(triangles_.neighbours, turns)};
  folds.spread(vector.logs);
  doubt(turns, vector.doubts);
  logs_.complete(positions, pool, vector);
  return vector;
}

}  // namespace viete::deform
