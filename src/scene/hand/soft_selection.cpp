#include "scene/hand/soft_selection.h"

#include <limits>
#include <queue>
#include <tuple>

#include "mesh/point_tree.h"

namespace viete::scene {

namespace {

constexpr double nowhere = std::numeric_limits<double>::infinity();

struct Reach {
  std::vector<double> distance;        // of each vertex
  std::vector<std::uint32_t> nearest;  // of the selected ones
};

// The neighbours of each vertex over edges, one list after the other.
struct Neighbours {
  explicit Neighbours(const deform::Cage& cage) : starts(cage.surface.positions.size() + 1) {
    for (const auto& [a, b] : cage.edges) ++starts[a + 1], ++starts[b + 1];
    for (std::size_t v = 1; v < starts.size(); ++v) starts[v] += starts[v - 1];
    all.resize(2 * cage.edges.size());
    std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
    for (const auto& [a, b] : cage.edges) all[next[a]++] = b, all[next[b]++] = a;
  }
  std::span<const std::uint32_t> of(std::uint32_t v) const {
    return {all.data() + starts[v], all.data() + starts[v + 1]};
  }
  std::vector<std::uint32_t> starts, all;
};

// E. W. Dijkstra's shortest paths from all of the selected ones at once, as far as the radius.
Reach over_edges(const deform::Cage& cage, std::span<const mesh::Point> positions,
                 std::span<const std::uint32_t> selected, double radius) {
  Reach reach{std::vector(positions.size(), nowhere), std::vector<std::uint32_t>(positions.size(), 0)};
  using Entry = std::tuple<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (std::uint32_t i = 0; i < selected.size(); ++i) {
    reach.distance[selected[i]] = 0;
    reach.nearest[selected[i]] = i;
    queue.emplace(0, selected[i]);
  }
  const Neighbours neighbours(cage);
  while (!queue.empty()) {
    const auto [distance, v] = queue.top();
    queue.pop();
    if (distance > reach.distance[v]) continue;
    for (const auto other : neighbours.of(v)) {
      const double longer = distance + mesh::norm(positions[other] - positions[v]);
      if (!(longer < reach.distance[other]) || longer >= radius) continue;
      reach.distance[other] = longer;
      reach.nearest[other] = reach.nearest[v];
      queue.emplace(longer, other);
    }
  }
  return reach;
}

Reach through_space(std::span<const mesh::Point> positions, std::span<const std::uint32_t> selected) {
  Reach reach{std::vector(positions.size(), nowhere), std::vector<std::uint32_t>(positions.size(), 0)};
  std::vector<std::uint32_t> place(positions.size(), 0);
  for (std::uint32_t i = 0; i < selected.size(); ++i) place[selected[i]] = i;
  const mesh::PointTree tree(positions, {selected.begin(), selected.end()});
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const std::uint32_t found = tree.nearest(positions[v]);
    reach.distance[v] = mesh::norm(positions[found] - positions[v]);
    reach.nearest[v] = place[found];
  }
  for (const auto v : selected) reach.distance[v] = 0, reach.nearest[v] = place[v];
  return reach;
}

}  // namespace

double soft_share(SoftCurve curve, double distance) {
  if (!(distance < 1)) return 0;
  const double near = 1 - distance;
  switch (curve) {
    case SoftCurve::smooth: return near * near * (3 - 2 * near);
    case SoftCurve::sharp: return near * near;
    case SoftCurve::linear: return near;
    case SoftCurve::constant: break;
  }
  return 1;
}

std::vector<Softened> softened(const deform::Cage& cage, std::span<const mesh::Point> positions,
                               std::span<const std::uint32_t> selected, const SoftSelection& soft,
                               double radius) {
  if (selected.empty()) return {};
  const Reach reach = soft.distance == SoftDistance::edges ? over_edges(cage, positions, selected, radius)
                                                           : through_space(positions, selected);
  std::vector<Softened> all;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const double share = reach.distance[v] == 0 ? 1 : soft_share(soft.curve, reach.distance[v] / radius);
    if (share > 0) all.push_back({v, share, reach.nearest[v]});
  }
  return all;
}

}  // namespace viete::scene
