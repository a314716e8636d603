#include "interact/grip.h"

#include <limits>
#include <queue>
#include <tuple>

#include "document/elements.h"
#include "mesh/adjacency.h"
#include "mesh/point_tree.h"

namespace viete::interact {

namespace {

using Distances = std::vector<double>;  // one per vertex, from the selected vertices

// Computes distances along edges, up to the radius, by Dijkstra's algorithm.
Distances over_edges(const deform::Cage& cage, std::span<const mesh::Point> positions,
                     std::span<const std::uint32_t> selected, double radius) {
  Distances distances(positions.size(), std::numeric_limits<double>::infinity());
  using Entry = std::tuple<double, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue;
  for (const auto v : selected) queue.emplace(distances[v] = 0, v);
  const auto neighbours = mesh::adjacency(positions.size(), cage.edges);
  while (!queue.empty()) {
    const auto [distance, v] = queue.top();
    queue.pop();
    if (distance > distances[v]) continue;
    for (const auto other : neighbours.of(v)) {
      const double longer = distance + mesh::norm(positions[other] - positions[v]);
      if (longer < distances[other] && longer < radius) queue.emplace(distances[other] = longer, other);
    }
  }
  return distances;
}

Distances through_space(std::span<const mesh::Point> positions, std::span<const std::uint32_t> selected) {
  Distances distances;
  const mesh::PointTree tree(positions, {selected.begin(), selected.end()});
  for (const mesh::Point& p : positions) distances.push_back(mesh::norm(positions[tree.nearest(p)] - p));
  return distances;
}

}  // namespace

double soft_share(document::SoftCurve curve, double distance) {
  if (!(distance < 1)) return 0;
  const double near = 1 - distance;
  switch (curve) {
    case document::SoftCurve::smooth: return near * near * (3 - 2 * near);
    case document::SoftCurve::sharp: return near * near;
    case document::SoftCurve::linear: return near;
    case document::SoftCurve::constant: break;
  }
  return 1;
}

std::vector<Gripped> softened(const deform::Cage& cage, std::span<const mesh::Point> positions,
                              std::span<const std::uint32_t> selected, const document::SoftSelection& soft,
                              double radius) {
  if (selected.empty()) return {};
  const Distances distances = soft.distance == document::SoftDistance::edges
                                  ? over_edges(cage, positions, selected, radius)
                                  : through_space(positions, selected);
  std::vector<Gripped> all;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    const double share = distances[v] == 0 ? 1 : soft_share(soft.curve, distances[v] / radius);
    if (share > 0) all.push_back({v, share});
  }
  return all;
}

namespace {

using Side = Gripped::Side;

// Multiplies the angle, the displacement and the change of the scale factors by `share`.
Transform share_of(const Transform& t, double share) {
  if (share == 1) return t;
  Transform part = t;
  part.degrees *= share;
  part.factors = glm::dvec3(1) + share * (t.factors - glm::dvec3(1));
  part.shift *= share;
  return part;
}

// Adds mirror partners. If both sides would move a vertex, the side with the larger share moves it.
std::vector<Gripped> on_both_sides(std::vector<Gripped> own, const document::Mirror& mirror) {
  std::vector<Gripped> by_vertex(mirror.partners.size(), Gripped{0, 0});
  for (const Gripped& g : own) by_vertex[g.vertex] = g;
  for (const Gripped& g : own) {
    if (mirror.is_on_plane(g.vertex)) by_vertex[g.vertex].side = Side::plane;
    if (!mirror.is_paired(g.vertex)) continue;
    const std::uint32_t partner = mirror.partners[g.vertex];
    if (by_vertex[partner].share < g.share) by_vertex[partner] = {partner, g.share, Side::other};
  }
  std::vector<Gripped> all;
  for (const Gripped& g : by_vertex) {
    if (g.share > 0) all.push_back(g);
  }
  return all;
}

// Moves a point on a side. A point on the plane gets the mean of the motion and the mirrored motion.
template <class Motion>
mesh::Point moved(const Motion& motion, Side side, const cages::Plane& plane, const mesh::Point& p) {
  if (side == Side::own) return motion(p);
  const mesh::Point from = side == Side::other ? document::reflected(plane, p) : p;
  const mesh::Vec3 way = motion(from) - from;
  if (side == Side::other) return p + document::reflected_direction(plane, way);
  return p + 0.5 * (way + document::reflected_direction(plane, way));
}

}  // namespace

std::vector<Gripped> gripped(const document::Document& document, const document::SoftSelection& soft,
                             const document::Mirror* mirror) {
  if (document.selection.kind() == document::ElementKind::probe) return {};
  const auto leading = leading_vertices(document, mirror);
  std::vector<Gripped> own;
  if (soft.on) {
    own = softened(*document.cage, document.pose.positions, leading, soft,
                   soft.radius * document.space.diagonal());
  } else {
    for (const auto v : leading) own.push_back({v});
  }
  if (mirror) own = on_both_sides(std::move(own), *mirror);
  const auto hidden = hidden_elements(document, document::ElementKind::vertex);
  std::erase_if(own, [&](const Gripped& g) { return g.vertex < hidden.size() && hidden[g.vertex]; });
  return own;
}

Grip grip_of(const document::Document& document, const document::Handling& handling,
             const document::Mirror* mirror, const document::Camera& camera) {
  Grip grip{anchor_of(document, handling, mirror, camera), {}, {}};
  if (mirror) grip.plane = mirror->plane;
  grip.vertices = gripped(document, handling.soft, mirror);
  return grip;
}

std::vector<std::uint32_t> vertices_of(const Grip& grip) {
  std::vector<std::uint32_t> vertices;
  for (const Gripped& g : grip.vertices) vertices.push_back(g.vertex);
  return vertices;
}

namespace {

mesh::Point shaped_on_its_side(const Grip& grip, std::size_t i, double amount, const mesh::Point& p) {
  const Gripped& g = grip.vertices[i];
  if (!grip.shaping.ways.empty()) return p + g.share * amount * grip.shaping.ways[i];
  // The amount without effect is 1 for taper, which is a factor, and 0 for other shapes.
  const double own = grip.shaping.shape == Shape::taper ? 1 + g.share * (amount - 1) : g.share * amount;
  return moved([&](const mesh::Point& at) { return shaped(grip.shaping, own, at); }, g.side, grip.plane, p);
}

}  // namespace

void apply(const Transform& transform, const Grip& grip, std::span<const mesh::Point> from,
           std::span<mesh::Point> to) {
  if (grip.shaping.shape != Shape::none) {
    const double amount = is_angle(grip.shaping.shape) ? transform.degrees : transform.amount;
    const bool nothing = amount == (grip.shaping.shape == Shape::taper ? 1 : 0);
    for (std::size_t i = 0; i < grip.vertices.size(); ++i) {
      const auto v = grip.vertices[i].vertex;
      to[v] = nothing ? from[v] : shaped_on_its_side(grip, i, amount, from[v]);
    }
    return;
  }
  double share = 1;
  PointMotion motion(transform);
  for (const Gripped& g : grip.vertices) {
    if (g.share != share) motion = PointMotion(share_of(transform, share = g.share));
    const auto about_center = [&](const mesh::Point& at) { return motion(at, grip.anchor.center); };
    to[g.vertex] = moved(about_center, g.side, grip.plane, from[g.vertex]);
  }
}

}  // namespace viete::interact
