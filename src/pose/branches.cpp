#include "pose/branches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

#include "mesh/adjacency.h"
#include "mesh/union_find.h"

namespace viete::pose {

namespace {

using Rotations = std::span<const sym3::Mat3<double>>;

// A rotation by the angle theta about the unit vector n has the logs (theta + 2 * pi * k) * n for all
// integers k. These logs are called branches. Blending is linear, so neighbours need logs near each other.

constexpr double turn = 2 * std::numbers::pi;
// Distances count as equal if they differ by less than this number of radians. If a log is half a turn from
// the reference, two branches are equally near to the reference, and rounding errors must not decide.
constexpr double half_turn_tie = 1e-2;
// A branch of the root's log replaces the previous branch only if its roughness (see Branching) is at most
// rougher * (previous roughness) + rougher_at_rest radians. The second term is for equal rotations: their
// roughness consists of rounding errors.
constexpr double rougher = 1.1, rougher_at_rest = 1e-3;
// A log is off an axis if its distance from the axis exceeds this number of radians.
constexpr double off_axis = 1e-6;
// Limit of the ratio of two distances between neighbours' logs: with and without whole turns. Above this
// limit, the logs with whole turns are rejected.
constexpr double incoherent = 3;
// A margin in radians: with it, rounding errors cannot make a comparison true.
constexpr double to_spare = 1e-6;

// Indices of the maps connected to a root. Each parent comes before its children.
struct Tree {
  std::vector<std::uint32_t> maps, parents;  // parents are indices into maps
};

Tree tree_of(const mesh::Adjacency& forest, std::uint32_t root) {
  Tree tree{{root}, {0}};
  for (std::uint32_t n = 0; n < tree.maps.size(); ++n) {
    const std::uint32_t parent = tree.maps[tree.parents[n]];
    for (const auto child : forest.of(tree.maps[n])) {
      if (child == parent) continue;
      tree.maps.push_back(child);
      tree.parents.push_back(n);
    }
  }
  return tree;
}

// Logs with which a part's logs are compared. `reference` is the part's entry of `turns`. `leader` is the
// mean log of the first part, or for the first part itself the same log as `reference`.
struct Anchors {
  Vec3 reference, leader;
};

// The logs of a tree for one branch of the root's log. All distances are root mean squares.
struct Branching {
  std::vector<Vec3> logs;
  double roughness = 0;  // distance between the logs and their parents' logs
  double to_reference = 0, to_leader = 0;

  Vec3 mean() const {
    Vec3 sum{0, 0, 0};
    for (const auto& log : logs) sum = sum + log;
    return (1 / static_cast<double>(logs.size())) * sum;
  }
};

Branching follow(const Tree& tree, const Vec3& root_log, std::span<const Vec3> principal,
                 const Anchors& anchors) {
  Branching b;
  b.logs.reserve(tree.maps.size());
  double roughness = 0, to_reference = 0, to_leader = 0;
  for (std::size_t n = 0; n < tree.maps.size(); ++n) {
    const Vec3 log = n == 0 ? root_log : nearest_branch(principal[tree.maps[n]], b.logs[tree.parents[n]]);
    b.logs.push_back(log);
    roughness += squared_norm(log - b.logs[tree.parents[n]]);
    to_reference += squared_norm(log - anchors.reference);
    to_leader += squared_norm(log - anchors.leader);
  }
  const auto count = static_cast<double>(b.logs.size());
  b.roughness = std::sqrt(roughness / count);
  b.to_reference = std::sqrt(to_reference / count);
  b.to_leader = std::sqrt(to_leader / count);
  return b;
}

// Returns true if `a` is not much rougher than `b` and is nearer to the reference. If `a` and `b` are equally
// near to the reference, compares the distances to the leader (see Anchors).
bool better(const Branching& a, const Branching& b) {
  if (a.roughness > rougher * b.roughness + rougher_at_rest) return false;
  const double gain = b.to_reference - a.to_reference;
  if (std::abs(gain) >= half_turn_tie) return gain > 0;
  return a.to_leader < b.to_leader - half_turn_tie;
}

// Tries three branches of the root's log: the nearest to the reference, one turn more, and one turn less.
Branching choose(const Tree& tree, std::span<const Vec3> principal, const Anchors& anchors) {
  const Vec3 log = nearest_branch(principal[tree.maps[0]], anchors.reference);
  Branching best = follow(tree, log, principal, anchors);
  const double length = norm(log);
  for (const double k : {-turn, turn}) {
    if (length == 0) break;
    Branching other = follow(tree, ((length + k) / length) * log, principal, anchors);
    if (better(other, best)) best = std::move(other);
  }
  return best;
}

// Returns true if nearest_branch(v, reference) is v by a margin. |v| and |reference| must be at most pi.
bool stays(const Vec3& v, const Vec3& reference) {
  const double angle = norm(v);
  return angle == 0 || std::abs(dot(reference, v) / angle - angle) < turn / 2 - to_spare;
}

// Returns true if it is certain that choose() keeps every principal log v. This needs two conditions:
// - Between neighbours, the nearest branch is the principal log.
// - |v| + |r| < pi for all references r, including the leader. The distance from r to v is then below pi. All
//   other branches are farther from r, because they have at least the length 2 * pi - |v|.
bool all_stay_principal(const Cage& cage, std::span<const Vec3> principal, std::span<const Vec3> turns,
                        std::span<const Vec3> means) {
  double longest = means.empty() ? 0 : norm(means[0]);
  for (const auto& reference : turns) longest = std::max(longest, norm(reference));
  const auto within = [&](const Vec3& log) { return norm(log) + longest < turn / 2 - to_spare; };
  return std::all_of(principal.begin(), principal.end(), within) &&
         std::all_of(cage.dual_edges.begin(), cage.dual_edges.end(), [&](const mesh::Edge& pair) {
           const Vec3 &a = principal[pair[0]], &b = principal[pair[1]];
           return stays(a, b) && stays(b, a);
         });
}

}  // namespace

std::vector<Vec3> means_of_parts(const Cage& cage, std::span<const Vec3> logs) {
  std::vector<Vec3> sums(cage.roots.size() + 1, {0, 0, 0});
  std::vector<std::size_t> counts(cage.roots.size() + 1);
  for (std::size_t e = 0; e < logs.size(); ++e) {
    sums[cage.parts[e]] = sums[cage.parts[e]] + logs[e];
    ++counts[cage.parts[e]];
  }
  sums.pop_back();  // removes the sum of the elements without area
  for (std::size_t p = 0; p < sums.size(); ++p) sums[p] = (1 / static_cast<double>(counts[p])) * sums[p];
  return sums;
}

double alignment(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

std::vector<mesh::Edge> spanning_forest(std::span<const mesh::Edge> edges, Rotations rotations) {
  std::vector<std::pair<double, std::uint32_t>> order(edges.size());
  for (std::uint32_t n = 0; n < edges.size(); ++n) {
    order[n] = {-alignment(rotations[edges[n][0]], rotations[edges[n][1]]), n};
  }
  std::sort(order.begin(), order.end());
  mesh::UnionFind trees(rotations.size());
  std::vector<mesh::Edge> forest;
  for (const auto& [key, n] : order) {
    if (trees.join(edges[n][0], edges[n][1])) forest.push_back(edges[n]);
  }
  return forest;
}

namespace {

Branches nearest_branches(const Cage& cage, Rotations rotations, std::span<const Vec3> principal,
                          std::span<const Vec3> turns) {
  Branches result{{principal.begin(), principal.end()}, means_of_parts(cage, principal)};
  if (all_stay_principal(cage, principal, turns, result.turns)) return result;
  const mesh::Adjacency forest =
      mesh::adjacency(rotations.size(), spanning_forest(cage.dual_edges, rotations));
  for (std::size_t p = 0; p < cage.roots.size(); ++p) {
    const Tree tree = tree_of(forest, cage.roots[p]);
    const Vec3 followed = p < turns.size() ? turns[p] : Vec3{0, 0, 0};
    const Branching chosen = choose(tree, principal, {followed, p > 0 ? result.turns[0] : followed});
    for (std::size_t n = 0; n < chosen.logs.size(); ++n) result.logs[tree.maps[n]] = chosen.logs[n];
    result.turns[p] = chosen.mean();
  }
  return result;
}

// Returns false if `turn_of_part` is at most half a turn. Otherwise returns true if `mean` has another axis
// than `turn_of_part`, or fewer whole turns about this axis.
bool may_lack_turns(const Vec3& mean, const Vec3& turn_of_part) {
  const double length = norm(turn_of_part);
  if (length <= turn / 2) return false;
  const Vec3 axis = (1 / length) * turn_of_part;
  return norm(mean - dot(mean, axis) * axis) > off_axis || whole_turns(turn_of_part, mean) > 0;
}

std::vector<double> roughness(const Cage& cage, std::span<const Vec3> logs) {
  std::vector<double> rough(cage.roots.size());
  for (const auto& [a, b] : cage.dual_edges) rough[cage.parts[a]] += squared_norm(logs[a] - logs[b]);
  return rough;
}

void take_logs(const Cage& cage, std::size_t part, const Branches& from, Branches& to) {
  for (std::size_t e = 0; e < to.logs.size(); ++e)
    if (cage.parts[e] == part) to.logs[e] = from.logs[e];
}

}  // namespace

double whole_turns(const Vec3& of, const Vec3& least) {
  const double length = norm(of);
  if (length <= turn / 2) return 0;
  return std::max(0.0, std::round((length - dot(least, of) / length) / turn));
}

Vec3 with_whole_turns(const Vec3& axis, double count, const Vec3& least) {
  return (turn * count + dot(least, axis)) * axis;
}

Branches choose_branches(const Cage& cage, Rotations rotations, std::span<const Vec3> principal,
                         std::span<const Vec3> turns) {
  Branches result = nearest_branches(cage, rotations, principal, turns);
  const auto lacks = [&](std::size_t part) { return may_lack_turns(result.turns[part], turns[part]); };
  std::vector<std::size_t> lacking;
  for (std::size_t part = 0; part < std::min(turns.size(), result.turns.size()); ++part)
    if (lacks(part)) lacking.push_back(part);
  if (lacking.empty()) return result;
  const Branches least = nearest_branches(cage, rotations, principal, {});
  const auto rough = roughness(cage, result.logs), rough_least = roughness(cage, least.logs);
  for (const std::size_t part : lacking) {
    const double count = whole_turns(turns[part], least.turns[part]);
    if (count == 0) continue;
    result.turns[part] = with_whole_turns((1 / norm(turns[part])) * turns[part], count, least.turns[part]);
    if (rough[part] > incoherent * incoherent * rough_least[part] + rougher_at_rest)
      take_logs(cage, part, least, result);
  }
  return result;
}

namespace {

constexpr int most_sweeps = 30;
constexpr double better_by = 1e-9;  // least improvement in radians per weight; larger than rounding errors

std::uint32_t other(const mesh::Edge& pair, std::uint32_t t) {
  return pair[0] == t ? pair[1] : pair[0];
}

// Returns logs along a spanning forest. In each part, the triangle with the smallest rotation keeps its log.
// Every other triangle gets the branch nearest to its parent's log.
std::vector<Vec3> tree_logs(const WeightedPairs& neighbours, Rotations rotations,
                            std::span<const Vec3> start) {
  const auto forest = mesh::adjacency(start.size(), spanning_forest(neighbours.pairs, rotations));
  std::vector<std::pair<double, std::uint32_t>> order;
  for (std::uint32_t t = 0; t < start.size(); ++t) order.push_back({squared_norm(start[t]), t});
  std::sort(order.begin(), order.end());
  std::vector<Vec3> logs(start.begin(), start.end());
  std::vector<std::uint8_t> seen(start.size());
  for (const auto& [turn, root] : order) {
    if (seen[root]) continue;
    const Tree tree = tree_of(forest, root);
    for (std::size_t n = 0; n < tree.maps.size(); ++n) {
      const auto t = tree.maps[n];
      seen[t] = 1;
      if (n > 0) logs[t] = nearest_branch(start[t], logs[tree.maps[tree.parents[n]]]);
    }
  }
  return logs;
}

// Compares two choices of branches. For each connected set of triangles where `others` and `logs` differ,
// copies `others` to `logs` if this reduces the sum of weight * (distance of the two logs) over all pairs.
void take_better(const WeightedPairs& neighbours, const std::vector<Vec3>& others, std::vector<Vec3>& logs) {
  const auto differs = [&](std::uint32_t t) { return logs[t] != others[t]; };
  mesh::UnionFind sets(logs.size());
  for (const auto& [a, b] : neighbours.pairs)
    if (differs(a) && differs(b)) sets.join(a, b);
  std::vector<double> gains(logs.size());
  for (std::size_t n = 0; n < neighbours.pairs.size(); ++n) {
    const auto& [a, b] = neighbours.pairs[n];
    if (!differs(a) && !differs(b)) continue;
    const double gain = norm(logs[a] - logs[b]) - norm(others[a] - others[b]);
    gains[sets.find(differs(a) ? a : b)] += neighbours.weights[n] * gain;
  }
  for (std::uint32_t t = 0; t < logs.size(); ++t)
    if (gains[sets.find(t)] > 0) logs[t] = others[t];
}

double cost(const WeightedPairs& neighbours, std::uint32_t t, const Vec3& log, std::span<const Vec3> logs) {
  double sum = 0;
  for (const auto n : neighbours.around.of(t))
    sum += neighbours.weights[n] * norm(log - logs[other(neighbours.pairs[n], t)]);
  return sum;
}

// Gives a triangle the branch with the lowest cost. Returns true if the log changes.
bool follow_neighbours(const WeightedPairs& neighbours, std::uint32_t t, std::vector<Vec3>& logs) {
  Vec3 best = logs[t];
  double least = cost(neighbours, t, best, logs);
  double weight = 0;
  for (const auto n : neighbours.around.of(t)) weight += neighbours.weights[n];
  for (const auto n : neighbours.around.of(t)) {
    const Vec3 log = nearest_branch(logs[t], logs[other(neighbours.pairs[n], t)]);
    const double c = cost(neighbours, t, log, logs);
    if (c < least - better_by * weight) {
      least = c;
      best = log;
    }
  }
  const bool changed = best != logs[t];
  logs[t] = best;
  return changed;
}

bool is_torn(const mesh::Edge& pair, std::span<const Vec3> logs) {
  return norm(logs[pair[0]] - logs[pair[1]]) > std::numbers::pi;
}

// Calls follow_neighbours() for the triangles of torn pairs until no log changes, up to most_sweeps times.
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
    for (std::uint32_t i = 0; i < n.pairs.size(); ++i) {
      add(n.pairs[i][0], i);
      add(n.pairs[i][1], i);
    }
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
  take_better(neighbours, tree_logs(neighbours, rotations, logs), logs);
  smooth(neighbours, logs);
}

}  // namespace viete::pose
