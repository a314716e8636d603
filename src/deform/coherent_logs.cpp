#include "deform/coherent_logs.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "deform/branches.h"
#include "mesh/union_find.h"

namespace viete::deform {

namespace {

using mesh::Vec3;

constexpr int most_sweeps = 30;
constexpr double better_by = 1e-9;  // radians, that rounding may not decide

double distance(const Vec3& a, const Vec3& b) {
  return mesh::norm(a - b);
}

std::uint32_t other(const mesh::Edge& pair, std::uint32_t t) {
  return pair[0] == t ? pair[1] : pair[0];
}

// The logs along the tree of least relative rotations.
class TreeLogs {
public:
  TreeLogs(const WeightedPairs& neighbours, std::span<const sym3::Mat3<double>> rotations,
           std::span<const Vec3> start)
      : start_(start), logs_(start.begin(), start.end()), seen_(start.size()) {
    const auto forest = spanning_forest(neighbours.pairs, rotations);
    tree_ = mesh::adjacency(start.size(), forest);
  }

  std::vector<Vec3> make() {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t t = 0; t < start_.size(); ++t) order.push_back({mesh::squared_norm(start_[t]), t});
    std::sort(order.begin(), order.end());
    for (const auto& [turn, root] : order)
      if (!seen_[root]) walk(root);
    return std::move(logs_);
  }

private:
  void walk(std::uint32_t root) {
    std::vector<std::uint32_t> queue{root};
    seen_[root] = 1;
    for (std::size_t n = 0; n < queue.size(); ++n) {
      for (const auto t : tree_.of(queue[n])) {
        if (seen_[t]) continue;
        seen_[t] = 1;
        logs_[t] = nearest_branch(start_[t], logs_[queue[n]]);
        queue.push_back(t);
      }
    }
  }

  std::span<const Vec3> start_;
  std::vector<Vec3> logs_;
  std::vector<std::uint8_t> seen_;
  mesh::Adjacency tree_;
};

// Takes other logs where they differ, of each connected set of triangles all or none.
void take_better(const WeightedPairs& neighbours, const std::vector<Vec3>& others, std::vector<Vec3>& logs) {
  const auto differs = [&](std::uint32_t t) { return logs[t] != others[t]; };
  mesh::UnionFind sets(logs.size());
  for (const auto& [a, b] : neighbours.pairs)
    if (differs(a) && differs(b)) sets.join(a, b);
  std::vector<double> gains(logs.size());
  for (std::size_t n = 0; n < neighbours.pairs.size(); ++n) {
    const auto& [a, b] = neighbours.pairs[n];
    if (!differs(a) && !differs(b)) continue;
    const double gain = distance(logs[a], logs[b]) - distance(others[a], others[b]);
    gains[sets.find(differs(a) ? a : b)] += neighbours.weights[n] * gain;
  }
  std::vector<std::uint8_t> takes(logs.size());
  for (std::uint32_t t = 0; t < logs.size(); ++t) takes[t] = differs(t) && gains[sets.find(t)] > 0;
  for (std::uint32_t t = 0; t < logs.size(); ++t)
    if (takes[t]) logs[t] = others[t];
}

double cost(const WeightedPairs& neighbours, std::uint32_t t, const Vec3& log, std::span<const Vec3> logs) {
  double sum = 0;
  for (const auto n : neighbours.around.of(t))
    sum += neighbours.weights[n] * distance(log, logs[other(neighbours.pairs[n], t)]);
  return sum;
}

// The branch of a triangle that its neighbours like best.
bool follow_neighbours(const WeightedPairs& neighbours, std::uint32_t t, std::vector<Vec3>& logs) {
  Vec3 best = logs[t];
  double least = cost(neighbours, t, best, logs);
  double weight = 0;
  for (const auto n : neighbours.around.of(t)) weight += neighbours.weights[n];
  for (const auto n : neighbours.around.of(t)) {
    const Vec3 log = nearest_branch(logs[t], logs[other(neighbours.pairs[n], t)]);
    const double c = cost(neighbours, t, log, logs);
    if (c < least - better_by * weight) least = c, best = log;
  }
  const bool changed = best != logs[t];
  logs[t] = best;
  return changed;
}

bool is_torn(const mesh::Edge& pair, std::span<const Vec3> logs) {
  return distance(logs[pair[0]], logs[pair[1]]) > std::numbers::pi;
}

// Until no triangle beside a tear changes.
void smooth(const WeightedPairs& neighbours, std::vector<Vec3>& logs) {
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool changed = false;
    for (const auto& pair : neighbours.pairs) {
      if (!is_torn(pair, logs)) continue;
      for (const auto t : pair) changed |= follow_neighbours(neighbours, t, logs);
    }
    if (!changed) return;
  }
}

}  // namespace

WeightedPairs weighted_pairs(std::vector<mesh::Edge> pairs, std::span<const double> areas) {
  WeightedPairs n{std::move(pairs), {}, {}};
  for (const auto& [a, b] : n.pairs) n.weights.push_back(std::sqrt(std::min(areas[a], areas[b])));
  n.around = mesh::make_adjacency(areas.size(), [&](const auto& add) {
    for (std::uint32_t i = 0; i < n.pairs.size(); ++i) add(n.pairs[i][0], i), add(n.pairs[i][1], i);
  });
  return n;
}

std::size_t torn_pairs(const WeightedPairs& neighbours, std::span<const Vec3> logs) {
  return static_cast<std::size_t>(
      std::ranges::count_if(neighbours.pairs, [&](const auto& pair) { return is_torn(pair, logs); }));
}

void make_coherent(const WeightedPairs& neighbours, std::span<const sym3::Mat3<double>> rotations,
                   std::vector<Vec3>& logs) {
  if (torn_pairs(neighbours, logs) == 0) return;
  take_better(neighbours, TreeLogs(neighbours, rotations, logs).make(), logs);
  smooth(neighbours, logs);
}

}  // namespace viete::deform
