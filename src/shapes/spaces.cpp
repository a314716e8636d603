#include "shapes/spaces.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/error.h"
#include "mesh/triangle.h"
#include "pose/branches.h"
#include "pose/cage_state.h"
#include "pose/maps.h"
#include "sym3/eigenvalues.h"
#include "sym3/polar.h"

namespace viete::shapes {

namespace {

using Mat = sym3::Mat3<double>;

constexpr double coarse_part = 0.5;  // of the time
constexpr std::size_t triangles_at_once = 64, vertices_at_once = 256;
// Limit of (s0 + s1) / s2 for singular values s0 <= s1 <= s2 of a map. Below it, the rotation is not unique.
constexpr double tells_turn = 1e-3;
constexpr double share_of_model = 0.01;  // see motions()
constexpr int passes_of_folded = 8;
// Limits, in radians, of a log's difference from a neighbour's log. Above `doubted`, the rotation becomes
// doubtful; above `given_up`, the rotation is fully replaced.
constexpr double doubted = 0.3, given_up = 1;

Mat transposed(const Mat& m) {
  return {m[0], m[3], m[6], m[1], m[4], m[7], m[2], m[5], m[8]};
}

void refuse_positions(std::span<const mesh::Point> positions, std::size_t expected) {
  if (positions.size() != expected)
    throw base::Error("",
                      "the shape has " + std::to_string(positions.size()) + " vertices, the model has " +
                          std::to_string(expected),
                      "choose a shape of the same model");
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (!std::isfinite(squared_norm(positions[v])))
      throw base::Error(
          "", "vertex " + std::to_string(v) + " (from 0) of the shape has a position that is not finite",
          "repair the file");
  }
}

// Returns the rotation vector of `sum`, the area-weighted sum of maps, or 0 if its rotation is not unique.
Vec3 mean_turn(const Mat& sum) {
  const auto [rotation, stretch] = sym3::polar(sum);
  const auto singular = sym3::eigenvalues(stretch);  // ascending; the first has the sign of the determinant
  if (!(singular[0] + singular[1] > tells_turn * singular[2])) return {0, 0, 0};
  return sym3::log_rotation(rotation);
}

}  // namespace

// Finds triangles that collapse or flip. spread() replaces their logs by means of the neighbours' logs.
class ShapeSpace::Folds {
public:
  Folds(const pose::WeightedPairs& neighbours, std::span<const Mat> rotations, std::vector<std::uint8_t> bad)
      : neighbours_(neighbours), bad_(std::move(bad)) {
    for (std::uint32_t t = 0; t < bad_.size(); ++t) {
      const auto around = neighbours.around.of(t);
      const auto against = [&](std::uint32_t n) {
        const auto& [a, b] = neighbours.pairs[n];
        return pose::alignment(rotations[a], rotations[b]) < 0;
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

  const pose::WeightedPairs& neighbours_;
  std::vector<std::uint8_t> bad_;
};

// Returns nothing if all vertices can be solved, or if the model has so many small parts that more than one
// in a hundred vertices would have to adopt the rotation of another cluster.
std::optional<weights::CoarseModel> ShapeSpace::coarse_of(const mesh::Surface& rest, base::WorkerPool& pool,
                                                          base::Progress* progress) {
  if (!weights::needs_coarse_model(rest)) return {};
  const base::ProgressPart part(progress, 0, coarse_part);
  const std::size_t most = rest.positions.size() / 100;
  const weights::SurfaceProxy proxy(rest, pool, progress, most);
  if (proxy.gathered() > most) return {};
  weights::CoarseModel coarse(proxy, rest.positions.size(), pool);
  if (coarse.adopt_clusters() > most) return {};
  return coarse;
}

ShapeSpace::ShapeSpace(const mesh::Surface& rest, std::optional<weights::CoarseModel> coarse,
                       std::span<const weights::Coupling> couplings, base::WorkerPool& pool,
                       base::Progress* progress)
    : rest_(rest.positions),
      coarse_(std::move(coarse)),
      split_(mesh::split_unsettled(coarse_ ? coarse_->surface() : rest, weights::most_split_corners)),
      triangles_(triangles_of(split_.surface)),
      logs_([&] {
        const base::ProgressPart part(progress, weights::needs_coarse_model(rest) ? coarse_part : 0, 1);
        const auto& solved = split_.surface;
        const std::vector<std::uint32_t> parts(solved.triangles.size(), 0);
        return LogSpace({solved.positions, solved.triangles, triangles_.flat, parts, 1, couplings}, pool,
                        progress);
      }()) {}

std::optional<ShapeSpace> ShapeSpace::joined(base::WorkerPool& pool) const {
  if (logs_.parts().count() < 2) return {};
  mesh::Surface model{rest_, {}, {}, {}, {}, {}};
  if (!coarse_) {
    model.corners = split_.surface.corners;
    model.polygon_starts = split_.surface.polygon_starts;
    mesh::triangulate(model);
  }
  std::optional<weights::CoarseModel> coarse = coarse_;
  if (!coarse && weights::needs_coarse_model(model)) {
    coarse.emplace(model, pool);
    coarse->adopt_clusters();
  }
  const auto couplings = weights::vertex_couplings(coarse ? coarse->surface() : model, pool);
  if (couplings.empty() && coarse.has_value() == coarse_.has_value()) return {};
  return ShapeSpace(model, std::move(coarse), couplings, pool, nullptr);
}

ShapeSpace::Triangles ShapeSpace::triangles_of(const mesh::Surface& rest) {
  Triangles all{rest.triangles, {}, {}, {}, {}};
  all.bases.reserve(rest.triangles.size());
  all.areas.reserve(rest.triangles.size());
  const auto& p = rest.positions;
  const double unit = mesh::used_bounds(rest).diagonal();
  for (const auto& t : rest.triangles) {
    const auto& [a, b, c] = t;
    all.flat.push_back(!mesh::has_area(p[a], p[b], p[c]));
    all.bases.push_back(all.flat.back() ? pose::RestBasis{} : pose::rest_basis(p, t));
    const double scale = unit > 0 ? 1 / unit : 0;
    all.areas.push_back(norm(cross(scale * (p[b] - p[a]), scale * (p[c] - p[a]))) / 2);
  }
  if (std::ranges::find(all.flat, 0) == all.flat.end())
    throw base::Error("", "the model has no triangle with an area", "choose a model that is a surface");
  all.neighbours = pose::weighted_pairs(pose::dual_graph(rest, all.flat).edges, all.areas);
  return all;
}

pose::AffineMap ShapeSpace::map_to(std::span<const mesh::Point> positions, std::size_t t) const {
  if (triangles_.flat[t]) return {{1, 0, 0, 0, 1, 0, 0, 0, 1}, {0, 0, 0}};
  const pose::RestBasis& rest = triangles_.bases[t];
  const auto [u, v, n] = pose::triangle_basis(positions, triangles_.corners[t], rest.corner);
  return {linear_map(rest, u, v, n), {0, 0, 0}};
}

void ShapeSpace::doubt(std::span<const Vec3> turns, std::vector<LogVector::Doubt>& doubts) const {
  std::vector<double> farthest(turns.size());
  for (const auto& [a, b] : triangles_.neighbours.pairs) {
    const double distance = norm(turns[a] - turns[b]);
    farthest[a] = std::max(farthest[a], distance);
    farthest[b] = std::max(farthest[b], distance);
  }
  for (std::uint32_t t = 0; t < turns.size(); ++t) {
    const double share = std::clamp((farthest[t] - doubted) / (given_up - doubted), 0.0, 1.0);
    if (share > 0 && !triangles_.flat[t]) doubts.push_back({t, share});
  }
}

// Returns the logs of the rotations relative to the rotation `whole`.
std::vector<Vec3> ShapeSpace::turns_of(const Vec3& whole, std::span<const Mat> rotations,
                                       const LogVector* before, base::WorkerPool& pool) const {
  const Mat back = transposed(sym3::exp_rotation(whole));
  std::vector<Vec3> logs(rotations.size());
  pool.for_blocks(logs.size(), triangles_at_once, [&](std::size_t begin, std::size_t end) {
    Mat turned[triangles_at_once];
    for (std::size_t t = begin; t < end; ++t) turned[t - begin] = pose::times(back, rotations[t]);
    sym3::log_rotation(sym3::MatView<const double>{sym3::Layout::packed, turned[0].data()},
                       sym3::VecView<double>{sym3::Layout::packed, logs[begin].data()}, end - begin);
    for (std::size_t t = begin; before && t < end; ++t) {
      const auto& log = before->logs[t];
      logs[t] = pose::nearest_branch(logs[t], {log[6], log[7], log[8]});
    }
  });
  make_coherent(triangles_.neighbours, rotations, logs);
  return logs;
}

// Splits triangles' maps into rotations and stretches. Writes the area-weighted sum of the maps to `sum`.
std::vector<pose::MapSplit> ShapeSpace::split(std::span<const mesh::Point> positions, base::WorkerPool& pool,
                                              Mat& sum) const {
  const std::size_t count = triangles_.corners.size();
  std::vector<pose::MapSplit> splits(count);
  std::vector<Mat> sums(count / triangles_at_once + 1);
  std::array<std::uint32_t, triangles_at_once> places;
  std::iota(places.begin(), places.end(), 0u);
  pool.for_blocks(count, triangles_at_once, [&](std::size_t begin, std::size_t end) {
    pose::AffineMap maps[triangles_at_once];
    Mat& part = sums[begin / triangles_at_once];
    for (std::size_t t = begin; t < end; ++t) {
      maps[t - begin] = map_to(positions, t);
      part = sym3::plus(part, triangles_.areas[t], maps[t - begin].linear);
    }
    split_maps(maps, std::span(places).first(end - begin), std::span(splits).subspan(begin, end - begin));
  });
  sum = {};
  for (const Mat& part : sums) sum = sym3::plus(sum, 1.0, part);
  return splits;
}

// Gives collapsed triangles the minimum stretch (see log_maps()). Returns for each triangle if it collapsed.
std::vector<std::uint8_t> ShapeSpace::raise(std::span<const mesh::Point> positions,
                                            std::vector<pose::MapSplit>& splits) const {
  const double mean = mean_stretch(triangles_.flat, splits);
  std::vector<std::uint8_t> collapsed(splits.size());
  for (std::size_t t = 0; t < splits.size(); ++t) {
    if (triangles_.flat[t] || pose::is_ordinary(splits[t].least, splits[t].largest, mean)) continue;
    collapsed[t] = raise_to_floor(map_to(positions, t), mean, splits[t]);
  }
  return collapsed;
}

LogVector ShapeSpace::at_rest() const {
  LogVector vector = logs_.at_rest();
  if (coarse_) {
    vector.fine_displacements.resize(rest_.size());
    vector.details.resize(rest_.size());
  }
  return vector;
}

// Returns the clusters' motions: the rotation is nearest to the mean of the maps of the triangles around it.
// A little of the model's rotation is added, so that clusters that collapse rotate with the model.
std::vector<weights::RigidMotion> ShapeSpace::motions(std::span<const mesh::Point> posed,
                                                      base::WorkerPool& pool) const {
  std::vector<Mat> sums(posed.size(), Mat{});
  for (std::size_t t = 0; t < triangles_.corners.size(); ++t) {
    if (triangles_.flat[t]) continue;
    const Mat map = map_to(posed, t).linear;
    for (const auto c : triangles_.corners[t]) sums[c] = sym3::plus(sums[c], triangles_.areas[t], map);
  }
  Mat all{};
  for (const Mat& sum : sums) all = sym3::plus(all, 1.0, sum);
  const Mat of_model = sym3::polar(all).rotation;
  const double share = share_of_model * sym3::norm(all) / static_cast<double>(sums.size());
  std::vector<weights::RigidMotion> motions(posed.size());
  pool.for_blocks(posed.size(), vertices_at_once, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      motions[c].rotation = sym3::polar(sym3::plus(sums[c], share, of_model)).rotation;
      motions[c].shift = posed[c] - pose::times(motions[c].rotation, logs_.rest()[c]);
    }
  });
  return motions;
}

// Calls use(vertex, position, rotation) for vertices of the model: moved with the clusters.
template <class Use>
void ShapeSpace::move_with_clusters(std::span<const mesh::Point> posed,
                                    std::span<const std::uint32_t> vertices, base::WorkerPool& pool,
                                    const Use& use) const {
  const std::vector<weights::RigidMotion> of_clusters = motions(posed, pool);
  pool.for_blocks(vertices.size(), vertices_at_once, [&](std::size_t begin, std::size_t end) {
    weights::RigidMotion means[vertices_at_once];
    Mat rotations[vertices_at_once];
    for (std::size_t i = begin; i < end; ++i) {
      means[i - begin] = coarse_->blended(of_clusters, vertices[i]);
      rotations[i - begin] = means[i - begin].rotation;
    }
    const sym3::MatView<double> view(sym3::Layout::packed, rotations[0].data());
    sym3::polar(view, view, end - begin);
    for (std::size_t i = begin; i < end; ++i) {
      const auto& [mean, shift] = means[i - begin];
      use(vertices[i], pose::times(mean, rest_[vertices[i]]) + shift, rotations[i - begin]);
    }
  });
}

void ShapeSpace::follow(std::span<const LogTerm> terms, std::span<const mesh::Point> posed,
                        base::WorkerPool& pool, std::span<mesh::Point> positions,
                        std::span<const std::uint32_t> vertices) const {
  move_with_clusters(posed, vertices, pool, [&](std::size_t v, const Vec3& position, const Mat& rotation) {
    positions[v] = position + pose::times(rotation, summed(terms, &LogVector::details, v));
  });
}

void ShapeSpace::shape(std::span<const LogTerm> terms, const AnchorWeights& anchors, base::WorkerPool& pool,
                       LogSpace::Work& work, std::span<mesh::Point> positions) const {
  if (!coarse_ && split_.polygons.empty()) return logs_.shape(terms, anchors, pool, work, positions);
  std::vector<mesh::Point> posed(logs_.rest().size());
  logs_.shape(terms, anchors, pool, work, posed);
  if (coarse_) return follow(terms, posed, pool, positions, mesh::first_numbers(rest_.size()));
  std::copy_n(posed.begin(), positions.size(), positions.begin());
}

void ShapeSpace::linear(std::span<const LogTerm> terms, std::span<mesh::Point> positions) const {
  const auto displacements = coarse_ ? &LogVector::fine_displacements : &LogVector::displacements;
  for (std::size_t v = 0; v < rest_.size(); ++v) positions[v] = rest_[v] + summed(terms, displacements, v);
}

std::vector<mesh::Point> ShapeSpace::solved(std::span<const mesh::Point> positions,
                                            base::WorkerPool& pool) const {
  if (coarse_) return coarse_->means(positions, pool);
  return mesh::with_centers(split_.surface, split_.polygons, positions);
}

LogVector ShapeSpace::vector(std::span<const mesh::Point> positions, base::WorkerPool& pool,
                             const LogVector* before, ShapeReport* report) const {
  refuse_positions(positions, rest().size());
  const std::vector<Vec3> means = solved(positions, pool);
  LogVector vector = solved_vector(means, pool, before, report);
  if (!coarse_) return vector;
  vector.fine_displacements.resize(rest_.size());
  vector.details.resize(rest_.size());
  move_with_clusters(means, mesh::first_numbers(rest_.size()), pool,
                     [&](std::size_t v, const Vec3& position, const Mat& rotation) {
                       vector.fine_displacements[v] = positions[v] - rest_[v];
                       vector.details[v] = pose::times(transposed(rotation), positions[v] - position);
                     });
  return vector;
}

LogVector ShapeSpace::solved_vector(std::span<const mesh::Point> positions, base::WorkerPool& pool,
                                    const LogVector* before, ShapeReport* report) const {
  LogVector vector;
  Mat sum;
  std::vector<pose::MapSplit> splits = split(positions, pool, sum);
  std::vector<std::uint8_t> collapsed = raise(positions, splits);
  std::vector<Mat> rotations;
  rotations.reserve(splits.size());
  vector.logs.reserve(splits.size());
  for (const pose::MapSplit& s : splits) rotations.push_back(s.rotation);
  Folds folds(triangles_.neighbours, rotations, std::move(collapsed));
  vector.wholes = {pose::nearest_branch(mean_turn(sum), before ? before->wholes[0] : Vec3{0, 0, 0})};
  const std::vector<Vec3> turns = turns_of(vector.wholes[0], rotations, before, pool);
  for (std::size_t t = 0; t < turns.size(); ++t)
    vector.logs.push_back(pose::numbers({splits[t].stretch, turns[t], {0, 0, 0}}));
  if (report)
    *report = {static_cast<std::size_t>(std::ranges::count(triangles_.flat, 1)), folds.count(),
               torn_pairs(triangles_.neighbours, turns), coarse_.has_value()};
  folds.spread(vector.logs);
  doubt(turns, vector.doubts);
  logs_.complete(positions, pool, vector);
  return vector;
}

namespace {

// If a part's turn and the mean of its logs differ by more than this many radians, the logs lack whole turns.
constexpr double tells_turns = 0.5;

LogSpace logs_of(const pose::Cage& cage) {
  base::WorkerPool one(1);
  return LogSpace(
      {cage.elements.positions, cage.elements.triangles, cage.degenerate, cage.parts, cage.roots.size()},
      one);
}

}  // namespace

PoseSpace::PoseSpace(std::shared_ptr<const pose::Cage> cage)
    : cage_(std::move(cage)), logs_(logs_of(*cage_)) {}

// Returns the whole turns that the logs of a part cannot represent, and removes these turns from the logs.
std::vector<Vec3> PoseSpace::take_wholes(std::span<const pose::AffineMap> maps,
                                         std::span<const pose::MapSplit> splits,
                                         const pose::LogReport& report,
                                         std::vector<pose::MapLog>& logs) const {
  std::vector<Vec3> wholes(report.turns.size()), rotations;
  for (const pose::MapLog& log : logs) rotations.push_back(log.rotation);
  const std::vector<Vec3> means = means_of_parts(*cage_, rotations);
  std::vector<pose::MapLog> least(logs.size());
  pose::LogReport of_least;
  for (std::size_t part = 0; part < wholes.size(); ++part) {
    if (norm(report.turns[part] - means[part]) < tells_turns) continue;
    if (of_least.turns.empty()) log_maps(*cage_, maps, splits, {}, least, of_least);
    const Vec3& turn = report.turns[part];
    const double count = pose::whole_turns(turn, of_least.turns[part]);
    if (count == 0) continue;
    wholes[part] = pose::with_whole_turns((1 / norm(turn)) * turn, count, {0, 0, 0});
    for (std::size_t e = 0; e < logs.size(); ++e)
      if (cage_->parts[e] == part) logs[e] = least[e];
  }
  return wholes;
}

LogVector PoseSpace::vector(const pose::Pose& pose, std::span<const Vec3> turns_before) const {
  check_pose(*cage_, pose.positions.size());
  const auto all = mesh::first_numbers(cage_->element_count());
  std::vector<pose::AffineMap> maps(all.size());
  std::vector<pose::MapSplit> splits(all.size());
  std::vector<pose::MapLog> logs(all.size());
  face_maps(*cage_, pose.positions, pose_origin(*cage_, pose.positions), all, maps);
  split_maps(maps, all, splits);
  pose::LogReport report;
  log_maps(*cage_, maps, splits, pose.turns.empty() ? turns_before : pose.turns, logs, report);

  LogVector vector;
  vector.wholes = take_wholes(maps, splits, report, logs);
  for (const pose::MapLog& log : logs) vector.logs.push_back(numbers(log));
  vector.turns = std::move(report.turns);
  base::WorkerPool one(1);
  logs_.complete(with_centers(*cage_, pose.positions), one, vector);
  return vector;
}

std::vector<Vec3> PoseSpace::turns(std::span<const LogTerm> terms) const {
  std::vector<Vec3> turns(cage_->roots.size());
  for (const auto& [vector, factor] : terms)
    for (std::size_t part = 0; part < turns.size(); ++part)
      turns[part] = turns[part] + factor * vector->turns[part];
  return turns;
}

pose::Pose PoseSpace::pose(std::span<const LogTerm> terms, const AnchorWeights& anchors) const {
  pose::Pose pose{std::vector<mesh::Point>(logs_.rest().size()), turns(terms)};
  base::WorkerPool one(1);
  LogSpace::Work work;
  logs_.shape(terms, anchors, one, work, pose.positions);
  pose.positions.resize(cage_->surface.positions.size());
  return pose;
}

pose::Pose PoseSpace::linear(std::span<const LogTerm> terms) const {
  pose::Pose pose{std::vector<mesh::Point>(logs_.rest().size()), turns(terms)};
  logs_.linear(terms, pose.positions);
  pose.positions.resize(cage_->surface.positions.size());
  return pose;
}

}  // namespace viete::shapes
