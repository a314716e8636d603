#include "deform/branches.h"

#include <algorithm>
#include <numbers>
#include <numeric>
#include <utility>

#include "deform/dual_graph.h"
#include "deform/vec3.h"

namespace viete::deform {

namespace {

using Pair = std::array<std::uint32_t, 2>;
using Rotations = std::span<const sym3::Mat3<double>>;

constexpr double turn = 2 * std::numbers::pi;
constexpr double along_reference = 1e-13;
constexpr double half_turn_tie = 1e-2;

std::uint32_t find(std::vector<std::uint32_t>& parent, std::uint32_t i) {
  while (parent[i] != i) i = parent[i] = parent[parent[i]];
  return i;
}

// Kruskal: the pairs of a spanning forest with the smallest relative angles.
std::vector<Pair> spanning_forest(std::span<const Pair> edges, Rotations rotations) {
  std::vector<std::pair<double, std::uint32_t>> order(edges.size());
  for (std::uint32_t n = 0; n < edges.size(); ++n) {
    order[n] = {-alignment(rotations[edges[n][0]], rotations[edges[n][1]]), n};
  }
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> parent(rotations.size());
  std::iota(parent.begin(), parent.end(), 0u);
  std::vector<Pair> forest;
  for (const auto& [key, n] : order) {
    const std::uint32_t i = find(parent, edges[n][0]), j = find(parent, edges[n][1]);
    if (i == j) continue;
    parent[i] = j;
    forest.push_back(edges[n]);
  }
  return forest;
}

// The elements of one part with their logs, for one branch of the root's log.
struct Branching {
  std::vector<std::uint32_t> elements;  // parents first
  std::vector<Vec3> logs;
  double roughness = 0;  // root mean square difference from the parents

  Vec3 mean() const {
    Vec3 sum{0, 0, 0};
    for (const auto& log : logs) sum = sum + log;
    return (1 / static_cast<double>(logs.size())) * sum;
  }

  // Root mean square: unlike the distance of the mean it cannot be small by cancelling.
  double distance(const Vec3& reference) const {
    double sum = 0;
    for (const auto& log : logs) sum += squared_norm(log - reference);
    return std::sqrt(sum / static_cast<double>(logs.size()));
  }
};

Branching follow(const Adjacency& forest, std::uint32_t root, const Vec3& log,
                 std::span<const Vec3> principal) {
  Branching b{{root}, {log}, 0};
  std::vector<std::uint32_t> parents{root};
  for (std::size_t n = 0; n < b.elements.size(); ++n) {
    for (const auto child : forest.of(b.elements[n])) {
      if (child == parents[n]) continue;
      b.elements.push_back(child);
      b.logs.push_back(nearest_branch(principal[child], b.logs[n]));
      b.roughness += squared_norm(b.logs.back() - b.logs[n]);
      parents.push_back(b.elements[n]);
    }
  }
  b.roughness = std::sqrt(b.roughness / static_cast<double>(b.logs.size()));
  return b;
}

// Half a turn from the reference two branches are equally near: then the one nearer to `leader` is better.
bool better(const Branching& a, const Branching& b, const Vec3& reference, const Vec3& leader) {
  if (a.roughness > 1.1 * b.roughness + 1e-3) return false;
  const double gain = b.distance(reference) - a.distance(reference);
  if (std::abs(gain) >= half_turn_tie) return gain > 0;
  return a.distance(leader) < b.distance(leader) - half_turn_tie;
}

// Tries the branches of the root's log around the reference.
Branching choose(const Adjacency& forest, std::uint32_t root, std::span<const Vec3> principal,
                 const Vec3& reference, const Vec3& leader) {
  const Vec3 log = nearest_branch(principal[root], reference);
  Branching best = follow(forest, root, log, principal);
  const double length = norm(log);
  for (const double k : {-turn, turn}) {
    if (length == 0) break;
    Branching other = follow(forest, root, ((length + k) / length) * log, principal);
    if (better(other, best, reference, leader)) best = std::move(other);
  }
  return best;
}

// Of the elements that hang together with each root.
std::vector<Vec3> part_means(const Cage& cage, std::span<const Vec3> logs) {
  std::vector<std::uint32_t> parent(logs.size());
  std::iota(parent.begin(), parent.end(), 0u);
  for (const auto& [i, j] : cage.dual_edges) parent[find(parent, i)] = find(parent, j);
  std::vector<Vec3> sums(logs.size(), {0, 0, 0});
  std::vector<std::size_t> counts(logs.size());
  for (std::uint32_t e = 0; e < logs.size(); ++e) {
    const std::uint32_t part = find(parent, e);
    sums[part] = sums[part] + logs[e];
    ++counts[part];
  }
  std::vector<Vec3> means;
  for (const auto root : cage.roots) {
    const std::uint32_t part = find(parent, root);
    means.push_back((1 / static_cast<double>(counts[part])) * sums[part]);
  }
  return means;
}

// True if nearest_branch(v, reference) is v, for |v| and |reference| up to half a turn, with room to spare.
bool stays(const Vec3& v, const Vec3& reference) {
  const double angle = norm(v);
  return angle == 0 || std::abs(dot(reference, v) / angle - angle) < turn / 2 - 1e-6;
}

// True if all logs are principal whatever the forest: every one is what its neighbours choose, and any other
// branch of it is farther than the principal one from all that roots are compared with: the references and
// the leader.
bool all_stay_principal(const Cage& cage, std::span<const Vec3> principal, std::span<const Vec3> turns,
                        std::span<const Vec3> means) {
  double reach = means.empty() ? 0 : norm(means[0]);
  for (const auto& reference : turns) reach = std::max(reach, norm(reference));
  const auto within = [&](const Vec3& log) { return norm(log) + reach < turn / 2 - 1e-6; };
  return std::all_of(principal.begin(), principal.end(), within) &&
         std::all_of(cage.dual_edges.begin(), cage.dual_edges.end(), [&](const Pair& pair) {
           const Vec3 &a = principal[pair[0]], &b = principal[pair[1]];
           return stays(a, b) && stays(b, a);
         });
}

}  // namespace

Vec3 nearest_branch(const Vec3& v, const Vec3& reference) {
  const double length = norm(reference), angle = norm(v);
  if (length > turn / 2) {
    const Vec3 axis = (1 / length) * reference;
    const double along = dot(v, axis);
    if (norm(v - along * axis) <= along_reference) {
      return (along + turn * std::round((length - along) / turn)) * axis;
    }
  }
  if (angle == 0) return v;
  const double k = std::round((dot(reference, v) / angle - angle) / turn);
  return k == 0 ? v : ((angle + turn * k) / angle) * v;
}

double alignment(const sym3::Mat3<double>& a, const sym3::Mat3<double>& b) {
  return std::inner_product(a.begin(), a.end(), b.begin(), 0.0);
}

Branches choose_branches(const Cage& cage, Rotations rotations, std::span<const Vec3> turns) {
  std::vector<Vec3> principal(rotations.size());
  std::transform(rotations.begin(), rotations.end(), principal.begin(), sym3::log_rotation<double>);
  return choose_branches(cage, rotations, principal, turns);
}

Branches choose_branches(const Cage& cage, Rotations rotations, std::span<const Vec3> principal,
                         std::span<const Vec3> turns) {
  Branches result{{principal.begin(), principal.end()}, {}};
  std::vector<Vec3> means = part_means(cage, principal);
  if (all_stay_principal(cage, principal, turns, means)) {
    result.turns = std::move(means);
    return result;
  }
  const Adjacency forest = adjacency(rotations.size(), spanning_forest(cage.dual_edges, rotations));
  for (std::size_t part = 0; part < cage.roots.size(); ++part) {
    const Vec3 reference = part < turns.size() ? turns[part] : Vec3{0, 0, 0};
    const Vec3 leader = part > 0 ? result.turns[0] : reference;
    const Branching chosen = choose(forest, cage.roots[part], principal, reference, leader);
    for (std::size_t n = 0; n < chosen.logs.size(); ++n) result.logs[chosen.elements[n]] = chosen.logs[n];
    result.turns.push_back(chosen.mean());
  }
  return result;
}

}  // namespace viete::deform
