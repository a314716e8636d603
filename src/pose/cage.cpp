#include "pose/cage.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/error.h"
#include "mesh/adjacency.h"
#include "mesh/repair.h"
#include "mesh/triangle.h"
#include "mesh/triangulation.h"
#include "mesh/union_find.h"

namespace viete::pose {

namespace {

constexpr std::uint32_t unseen = std::numeric_limits<std::uint32_t>::max();
constexpr std::size_t exact_center_limit = 4096;

bool is_fin(std::span<const mesh::HalfEdge> sides, std::span<const std::uint8_t> skip) {
  if (sides.size() < 3 || sides.size() % 2 == 0) return false;
  return std::none_of(sides.begin(), sides.end(), [&](const mesh::HalfEdge& h) { return skip[h.triangle]; });
}

void sort_unique(std::vector<mesh::Edge>& pairs) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
}

// Breadth-first search through the part that is connected to `start`.
struct Sweep {
  std::vector<std::uint32_t> order, distance, parent;

  explicit Sweep(std::size_t nodes) : distance(nodes, unseen), parent(nodes, unseen) {}

  void run(const mesh::Adjacency& graph, std::uint32_t start) {
    for (const auto i : order) distance[i] = unseen;
    order.assign(1, start);
    distance[start] = 0;
    parent[start] = start;
    for (std::size_t n = 0; n < order.size(); ++n)
      for (const auto j : graph.of(order[n])) {
        if (distance[j] != unseen) continue;
        distance[j] = distance[order[n]] + 1;
        parent[j] = order[n];
        order.push_back(j);
      }
  }

  std::uint32_t eccentricity() const { return distance[order.back()]; }
};

std::uint32_t exact_center(const mesh::Adjacency& graph, std::vector<std::uint32_t> part, Sweep& sweep) {
  std::sort(part.begin(), part.end());
  std::uint32_t best = part.front(), least = unseen;
  for (const auto i : part) {
    sweep.run(graph, i);
    if (sweep.eccentricity() < least) {
      least = sweep.eccentricity();
      best = i;
    }
  }
  return best;
}

std::uint32_t middle_of_longest_path(const mesh::Adjacency& graph, Sweep& sweep) {
  sweep.run(graph, sweep.order.back());
  const std::uint32_t half = sweep.eccentricity() / 2;
  std::uint32_t i = sweep.order.back();
  while (sweep.distance[i] > half) i = sweep.parent[i];
  return i;
}

}  // namespace

std::vector<mesh::Edge> without_skipped(std::vector<mesh::Edge> pairs, std::span<const std::uint8_t> skip) {
  mesh::UnionFind clusters(skip.size());
  for (const auto& [i, j] : pairs) {
    if (skip[i] && skip[j]) clusters.join(i, j);
  }
  std::vector<mesh::Edge> kept, rim;  // rim: pairs (cluster of skipped elements, neighbour)
  for (const auto& [i, j] : pairs) {
    if (!skip[i] && !skip[j]) kept.push_back({i, j});
    if (skip[i] != skip[j]) rim.push_back({clusters.find(skip[i] ? i : j), skip[i] ? j : i});
  }
  sort_unique(rim);
  for (std::size_t n = 1; n < rim.size(); ++n) {
    if (rim[n][0] == rim[n - 1][0]) kept.push_back({rim[n - 1][1], rim[n][1]});
  }
  sort_unique(kept);
  return kept;
}

DualGraph dual_graph(const mesh::Surface& surface, std::span<const std::uint8_t> skip) {
  const auto table = mesh::half_edges(surface.positions.size(), mesh::welded(surface).triangles);
  DualGraph graph;
  std::vector<mesh::Edge> pairs;
  for (std::size_t e = 0; e < table.edges.size(); ++e) {
    const auto sides = table.of(e);
    for (std::size_t n = 1; n < sides.size(); ++n)
      pairs.push_back({sides[n - 1].triangle, sides[n].triangle});
    graph.open += sides.size() == 1;
    graph.nonmanifold += sides.size() > 2;
    graph.misoriented += sides.size() == 2 && sides[0].forward == sides[1].forward;
    if (is_fin(sides, skip)) graph.fins.push_back(table.edges[e]);
  }
  graph.edges = without_skipped(std::move(pairs), skip);
  return graph;
}

GraphParts graph_parts(std::size_t elements, std::span<const mesh::Edge> edges,
                       std::span<const std::uint8_t> skip) {
  const mesh::Adjacency graph = mesh::adjacency(elements, edges);
  GraphParts parts{{}, std::vector<std::uint32_t>(elements, unseen)};
  Sweep sweep(elements);
  for (std::uint32_t i = 0; i < elements; ++i) {
    if (skip[i] || parts.of[i] != unseen) continue;
    sweep.run(graph, i);
    for (const auto j : sweep.order) parts.of[j] = static_cast<std::uint32_t>(parts.centers.size());
    parts.centers.push_back(sweep.order.size() <= exact_center_limit ? exact_center(graph, sweep.order, sweep)
                                                                     : middle_of_longest_path(graph, sweep));
  }
  std::ranges::replace(parts.of, unseen, static_cast<std::uint32_t>(parts.centers.size()));
  return parts;
}

namespace {

// Returns N / sqrt(|N|) for N = u x v, or 0 if N is 0. First scales u and v to avoid overflow and underflow.
Vec3 scaled_normal(const Vec3& u, const Vec3& v) {
  const double size = std::max(largest_abs(u), largest_abs(v));
  if (!(size > 0)) return {0, 0, 0};
  const Vec3 area = cross((1 / size) * u, (1 / size) * v);
  const double length = norm(area);
  return length > 0 ? (size / std::sqrt(length)) * area : Vec3{0, 0, 0};
}

// Returns the corner between the two shorter edges: their cross product has the smallest rounding error.
int best_corner(std::span<const mesh::Point> positions, const mesh::Triangle& t) {
  int best = 0;
  double longest = -1;
  for (int i = 0; i < 3; ++i) {
    const Vec3 opposite = positions[t[(i + 2) % 3]] - positions[t[(i + 1) % 3]];
    if (squared_norm(opposite) > longest) {
      longest = squared_norm(opposite);
      best = i;
    }
  }
  return best;
}

}  // namespace

TriangleBasis triangle_basis(std::span<const mesh::Point> positions, const mesh::Triangle& t, int corner) {
  const mesh::Point& a = positions[t[corner]];
  const Vec3 u = positions[t[(corner + 1) % 3]] - a, v = positions[t[(corner + 2) % 3]] - a;
  return {u, v, scaled_normal(u, v)};
}

RestBasis rest_basis(std::span<const mesh::Point> positions, const mesh::Triangle& t) {
  const int corner = best_corner(positions, t);
  const TriangleBasis f = triangle_basis(positions, t, corner);
  const double s = 1 / std::max(largest_abs(f.u), largest_abs(f.v));
  const Vec3 u = s * f.u, v = s * f.v, area = cross(u, v);
  const double a2 = squared_norm(area);
  return {corner,
          f.u,
          f.v,
          f.n,
          (s / a2) * cross(v, area),
          (s / a2) * cross(area, u),
          (s / (a2 / std::sqrt(std::sqrt(a2)))) * area};
}

Vec3 side_along(const Vec3& area) {
  const double size = largest_abs(area);
  if (!(size > 0)) return {0, 0, 0};
  const Vec3 unit = (1 / size) * area;
  return (std::sqrt(size) / std::sqrt(norm(unit))) * unit;
}

namespace {

constexpr double flat_shape = 1e-12;  // a cage with a smaller ratio of thickness to diagonal is flat

double largest_coordinate(const mesh::Surface& surface) {
  double largest = 0;
  for (const auto& p : surface.positions) largest = std::max(largest, largest_abs(p));
  return largest;
}

std::string listed(const std::vector<std::size_t>& elements) {
  std::string text;
  for (std::size_t n = 0; n < std::min<std::size_t>(elements.size(), 5); ++n) {
    text += (n ? ", " : "") + std::to_string(elements[n]);
  }
  return elements.size() > 5 ? text + ", ..." : text;
}

void split_polygons(Cage& cage) {
  const auto repeated = mesh::repeated_polygons(cage.surface);
  mesh::CenterSplit split = mesh::split_at_centers(cage.surface, repeated);
  cage.elements = std::move(split.surface);
  cage.split = std::move(split.polygons);
  std::vector<std::size_t> repeats;
  for (std::uint32_t p = 0; p < repeated.size(); ++p)
    if (repeated[p]) repeats.push_back(p);
  if (repeats.empty()) return;
  cage.warnings.push_back(std::to_string(repeats.size()) +
                          (repeats.size() == 1 ? " cage face repeats another face and is ignored: "
                                               : " cage faces repeat other faces and are ignored: ") +
                          listed(repeats));
}

void add_elements(Cage& cage) {
  const auto& p = cage.elements.positions;
  std::vector<std::uint8_t> has_area(cage.surface.polygon_count(), 0);
  for (std::size_t e = 0; e < cage.elements.triangles.size(); ++e) {
    const auto& [a, b, c] = cage.elements.triangles[e];
    cage.centers.push_back(p[a] + (1.0 / 3) * ((p[b] - p[a]) + (p[c] - p[a])));
    cage.bases.push_back(rest_basis(p, cage.elements.triangles[e]));
    cage.degenerate.push_back(!mesh::has_area(p[a], p[b], p[c]));
    if (!cage.degenerate.back()) has_area[cage.polygon_of(e)] = 1;
  }
  if (std::ranges::count(has_area, 1) == 0) {
    throw base::Error("", has_area.empty() ? "the cage has no faces" : "all faces of the cage have zero area",
                      "choose a surface that encloses the model");
  }
  std::vector<std::size_t> found;
  for (const auto polygon : cage.elements.triangle_polygon)
    if (!has_area[polygon] && (found.empty() || found.back() != polygon)) found.push_back(polygon);
  if (found.empty()) return;
  cage.warnings.push_back(std::to_string(found.size()) + " of " + std::to_string(has_area.size()) +
                          " cage faces have zero area and do not deform the model: " + listed(found));
}

// Returns the cage's extent along the normal of the first triangle with an area, in diagonals of the cage.
double thickness(const Cage& cage) {
  const auto e = std::find(cage.degenerate.begin(), cage.degenerate.end(), 0) - cage.degenerate.begin();
  const auto& p = cage.elements.positions;
  const auto& [a, b, c] = cage.elements.triangles[static_cast<std::size_t>(e)];
  const double scale = 1 / cage.diagonal;
  const Vec3 across = cross(scale * (p[b] - p[a]), scale * (p[c] - p[a]));
  const Vec3 normal = (1 / norm(across)) * across;
  double least = 0, most = 0;
  for (const auto v : cage.surface.corners) {
    const double height = dot(normal, scale * (p[v] - p[a]));
    least = std::min(least, height);
    most = std::max(most, height);
  }
  return most - least;
}

// Throws base::Error for a flat closed cage, which has no inside. A flat open cage is valid.
void refuse_squashed(const Cage& cage, const DualGraph& graph) {
  if (graph.open > 0 || thickness(cage) > flat_shape) return;
  throw base::Error("", "the cage is squashed flat: it encloses no volume",
                    "choose a surface that encloses the model");
}

void refuse_fins(const DualGraph& graph) {
  if (graph.fins.empty()) return;
  const auto& [a, b] = graph.fins.front();
  const auto others = graph.fins.size() - 1;
  throw FinError("",
                 "the cage has a fin: an odd number of faces share edge " + std::to_string(a) + "-" +
                     std::to_string(b) + (others ? " and " + std::to_string(others) + " more edges" : "") +
                     " (vertices numbered from 0), so inside and outside are undefined there",
                 "remove the faces that stick out");
}

void connect(Cage& cage) {
  DualGraph graph = dual_graph(cage.elements, cage.degenerate);
  refuse_squashed(cage, graph);
  refuse_fins(graph);
  cage.dual_edges = std::move(graph.edges);
  GraphParts parts = graph_parts(cage.element_count(), cage.dual_edges, cage.degenerate);
  cage.roots = std::move(parts.centers);
  cage.parts = std::move(parts.of);
  cage.closed = graph.open + graph.nonmanifold + graph.misoriented == 0;
  cage.sides = mesh::one_sided(cage.elements);
  const auto warn = [&cage](std::size_t count, const char* what) {
    if (count == 0) return;
    cage.warnings.push_back(std::to_string(count) + (count == 1 ? " cage edge has " : " cage edges have ") +
                            what);
  };
  warn(graph.open, "only one face: the cage is open");
  warn(graph.nonmanifold, "four or more faces: parts of the cage touch there");
  warn(graph.misoriented, "faces of opposite orientation");
}

}  // namespace

Cage make_cage(mesh::Surface surface) {
  Cage cage;
  cage.surface = std::move(surface);
  cage.unused.assign(cage.surface.positions.size(), 1);
  for (const auto v : cage.surface.corners) cage.unused[v] = 0;
  cage.edges = mesh::polygon_edges(cage.surface);
  split_polygons(cage);
  add_elements(cage);
  cage.diagonal = mesh::used_bounds(cage.surface).diagonal();
  cage.size = mesh::used_size(cage.elements);
  cage.contact =
      1e-14 * cage.diagonal + 4 * std::numeric_limits<double>::epsilon() * largest_coordinate(cage.surface);
  connect(cage);
  return cage;
}

std::vector<mesh::Point> with_centers(const Cage& cage, std::span<const mesh::Point> positions) {
  return mesh::with_centers(cage.surface, cage.split, positions);
}

Cage no_cage(const mesh::Bounds& box) {
  Cage cage;
  cage.surface.positions = {box.low, box.high};
  cage.unused = {1, 1};
  cage.diagonal = box.diagonal();
  if (!(cage.diagonal > 0)) cage.diagonal = 1;  // the box is a single point
  cage.size = cage.diagonal;
  return cage;
}

Pose rest_pose(const Cage& cage) {
  return {cage.surface.positions, {}};
}

void check_pose(const Cage& cage, std::size_t vertices, const std::string& place) {
  const std::size_t expected = cage.surface.positions.size();
  if (vertices == expected) return;
  throw base::Error(
      place,
      "the pose has " + std::to_string(vertices) + " vertices, the cage has " + std::to_string(expected),
      "choose a pose of this cage");
}

}  // namespace viete::pose
