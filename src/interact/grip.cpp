#include "interact/grip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <tuple>

#include "cages/subject.h"
#include "document/elements.h"
#include "document/space.h"
#include "interact/cursor_projection.h"
#include "mesh/adjacency.h"
#include "mesh/point_tree.h"
#include "mesh/union_find.h"

namespace viete::interact {

namespace {

using Distances = std::vector<double>;  // one per vertex: the distance from the selected vertices

// Computes distances along edges, up to the radius, by Dijkstra's algorithm.
Distances over_edges(const pose::Cage& cage, std::span<const mesh::Point> positions,
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

using Vertices = std::vector<std::uint32_t>;

mesh::Point mean_of(std::span<const mesh::Point> positions, std::span<const std::uint32_t> vertices) {
  mesh::Point sum{0, 0, 0};
  for (const auto v : vertices) sum = sum + 1 / static_cast<double>(vertices.size()) * positions[v];
  return sum;
}

bool selects_probes(const document::Document& document) {
  return document.selection().kind() == document::ElementKind::probe;
}

// Returns the given vertices with an edge to the largest connected part of the other vertices.
Vertices border_of(const pose::Cage& cage, const Vertices& vertices) {
  const std::size_t count = cage.surface.positions.size();
  std::vector<char> moves(count, 0);
  for (const auto v : vertices) moves[v] = 1;
  mesh::UnionFind together(count);
  for (const auto& [a, b] : cage.edges) {
    if (!moves[a] && !moves[b]) together.join(a, b);
  }
  std::vector<std::size_t> size(count, 0);
  for (std::uint32_t v = 0; v < count; ++v) ++size[together.find(v)];
  // For each given vertex: the size of the largest part next to the vertex.
  std::vector<std::uint32_t> joined_to(count, 0);
  std::size_t largest = 0;
  const auto meet = [&](std::uint32_t moving, std::uint32_t staying) {
    if (!moves[moving] || moves[staying]) return;
    largest = std::max(largest, size[together.find(staying)]);
    joined_to[moving] = std::max(joined_to[moving], static_cast<std::uint32_t>(size[together.find(staying)]));
  };
  for (const auto& [a, b] : cage.edges) {
    meet(a, b);
    meet(b, a);
  }
  Vertices border;
  for (const auto v : vertices) {
    if (largest > 0 && joined_to[v] == largest) border.push_back(v);
  }
  return border;
}

// Returns axes with this Z axis, and with the X axis as close as possible to `near_x`.
glm::dmat3 axes_from(const glm::dvec3& z, const glm::dvec3& near_x) {
  const glm::dvec3 across = near_x - glm::dot(near_x, z) * z;
  const double length = glm::length(across);
  const glm::dvec3 x = length > 1e-9 ? across / length : plane_axes(z).u;
  return {x, glm::cross(z, x), z};
}

// Makes the largest component positive, so that the axis does not flip while vertices move.
glm::dvec3 forward(const mesh::Vec3& axis) {
  const glm::dvec3 a = glm::normalize(document::vector_of(axis));
  int largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(a[i]) > std::abs(a[largest]) + 1e-9) largest = i;
  }
  return a[largest] < 0 ? -a : a;
}

glm::dvec3 middle_of(const document::Document& document, const Vertices& vertices) {
  if (!selects_probes(document)) return document::vector_of(mean_of(document.pose().positions, vertices));
  glm::dvec3 sum(0);
  const auto count = static_cast<double>(document.selection().size());
  for (const auto i : document.selection().indices())
    sum += document::vector_of(probe_center(document, i)) / count;
  return sum;
}

std::optional<glm::dvec3> center_of_active(const document::Document& document) {
  const auto active = document.selection().active();
  if (!active || selects_probes(document)) return std::nullopt;
  return document::vector_of(element_middle(document, document.selection().kind(), *active));
}

// The center of the boundary between the vertices and the largest connected part of the other vertices.
std::optional<glm::dvec3> joint_of(const document::Document& document,
                                   const std::vector<std::uint32_t>& vertices) {
  const Vertices border = border_of(*document.cage(), vertices);
  if (border.empty()) return std::nullopt;
  return document::vector_of(mean_of(document.pose().positions, border));
}

glm::dvec3 pivot_of(const document::Document& document, const document::Handling& handling,
                    const Vertices& vertices) {
  const auto center = [&]() -> std::optional<glm::dvec3> {
    switch (handling.pivot) {
      case document::Pivot::median: break;
      case document::Pivot::active: return center_of_active(document);
      case document::Pivot::joint:
        return selects_probes(document) ? std::nullopt : joint_of(document, vertices);
      case document::Pivot::point:
        return handling.point ? std::optional(document::vector_of(*handling.point)) : std::nullopt;
    }
    return std::nullopt;
  }();
  return center.value_or(middle_of(document, vertices));
}

// The columns are the axes of inertia of the selection, from the longest extent to the shortest.
glm::dmat3 axes_of_selection(const document::Document& document, const Vertices& vertices) {
  mesh::Surface cloud;
  for (const auto v : vertices) cloud.positions.push_back(document.pose().positions[v]);
  if (cloud.positions.size() < 2 || !(mesh::bounds(cloud.positions).diagonal() > 0)) return glm::dmat3(1);
  const cages::Frame frame = cages::own_frame(cloud);
  std::array<std::pair<double, glm::dvec3>, 3> extents;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = 1e300, high = -1e300;
    for (const auto& p : cloud.positions) {
      const double at = mesh::dot(frame.axes[i], p - frame.center) * frame.scale;
      low = std::min(low, at);
      high = std::max(high, at);
    }
    extents[i] = {high - low, forward(frame.axes[i])};
  }
  std::ranges::stable_sort(extents, std::greater<>(), [](const auto& e) { return e.first; });
  return axes_from(extents[2].second, extents[0].second);
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

std::vector<Gripped> softened(const pose::Cage& cage, std::span<const mesh::Point> positions,
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

// Adds the mirror partners. If a partner is already in `own`, the larger share decides the partner's side.
std::vector<Gripped> on_both_sides(std::vector<Gripped> own, const document::Mirror& mirror) {
  std::vector<Gripped> by_vertex(mirror.partners.size(), Gripped{0, 0});
  for (const Gripped& g : own) by_vertex[g.vertex] = g;
  for (const Gripped& g : own) {
    if (mirror.is_on_plane(g.vertex)) by_vertex[g.vertex].side = Side::plane;
    if (!mirror.is_paired(g.vertex)) continue;
    const std::uint32_t partner = mirror.partners[g.vertex];
    if (by_vertex[partner].share < g.share) by_vertex[partner] = {partner, g.share, Side::other};
  }
  std::erase_if(by_vertex, [](const Gripped& g) { return !(g.share > 0); });
  return by_vertex;
}

// Moves p by the motion of its side. On Side::plane, this is the mean of the motions of the other two sides.
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
  if (document.selection().kind() == document::ElementKind::probe) return {};
  const auto leading = leading_vertices(document, mirror);
  std::vector<Gripped> own;
  if (soft.on) {
    own = softened(*document.cage(), document.pose().positions, leading, soft,
                   soft.radius * document.space().diagonal());
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
  if (!grip.shaping.displacements.empty()) return p + g.share * amount * grip.shaping.displacements[i];
  // The amount that changes nothing is 1 for taper (a factor), and 0 for other shapes.
  const double own = grip.shaping.shape == Shape::taper ? 1 + g.share * (amount - 1) : g.share * amount;
  return moved([&](const mesh::Point& at) { return shaped(grip.shaping, own, at); }, g.side, grip.plane, p);
}

}  // namespace

void move_gripped(const Transform& transform, const Grip& grip, std::span<const mesh::Point> from,
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

std::vector<std::uint32_t> leading_vertices(const document::Document& document,
                                            const document::Mirror* mirror) {
  std::vector<std::uint32_t> selected = moving_vertices(document);
  if (!mirror || selected.empty()) return selected;
  const auto& rest = document.cage()->surface.positions;
  const auto side = [&](std::uint32_t v) {
    return mesh::dot(mirror->plane.normal, rest[v]) - mirror->plane.offset;
  };
  double balance = 0;
  for (const auto v : selected) balance += mirror->is_paired(v) ? (side(v) >= 0 ? 1 : -1) : 0;
  if (const auto active = document.selection().active()) {
    double of_active = 0;
    for (const auto v : element_vertices(*document.cage(), document.selection().kind(), *active))
      of_active += mirror->is_paired(v) ? side(v) : 0;
    if (of_active != 0) balance = of_active;
  }
  std::vector<std::uint32_t> leading;
  for (const auto v : selected) {
    const bool both = mirror->is_paired(v) && std::ranges::binary_search(selected, mirror->partners[v]);
    if (!both || (side(v) >= 0) == (balance >= 0)) leading.push_back(v);
  }
  return leading;
}

Anchor anchor_of(const document::Document& document, const document::Handling& handling,
                 const document::Mirror* mirror, const document::Camera& camera) {
  const Vertices vertices = leading_vertices(document, mirror);
  Anchor anchor{pivot_of(document, handling, vertices)};
  if (handling.axes == document::Axes::view)
    anchor.axes = {glm::dvec3(camera.right()), glm::dvec3(camera.up()), -glm::dvec3(camera.forward())};
  if (handling.axes == document::Axes::selection) anchor.axes = axes_of_selection(document, vertices);
  return anchor;
}

namespace {

// Sorts the vertices with share 1 by distance from `from`. Returns the mean position of the farthest 20 %.
glm::dvec3 far_end(const document::Document& document, const Grip& grip, const glm::dvec3& from) {
  std::vector<std::pair<double, glm::dvec3>> places;
  for (const Gripped& g : grip.vertices) {
    const glm::dvec3 p = document::vector_of(document.pose().positions[g.vertex]);
    if (g.side != Gripped::Side::other && g.share == 1) places.emplace_back(-glm::distance(p, from), p);
  }
  std::ranges::sort(places, {}, [](const auto& place) { return place.first; });
  const std::size_t count = std::max<std::size_t>(1, places.size() / 5);
  glm::dvec3 sum(0);
  for (std::size_t i = 0; i < std::min(count, places.size()); ++i) sum += places[i].second;
  return places.empty() ? from : sum / static_cast<double>(count);
}

void put_ends(const document::Document& document, const Grip& grip, bool at_median,
              const document::Camera& camera, Shaping& shaping) {
  shaping.from = grip.anchor.center;
  if (at_median) {
    const auto vertices = leading_vertices(document, nullptr);
    shaping.from = joint_of(document, vertices).value_or(far_end(document, grip, grip.anchor.center));
  }
  const double size = document.space().diagonal();
  shaping.to = center_of_active(document).value_or(shaping.from);
  if (glm::distance(shaping.from, shaping.to) < 1e-6 * size)
    shaping.to = far_end(document, grip, shaping.from);
  const glm::dvec3 way = shaping.to - shaping.from;
  if (glm::length(way) < 1e-6 * size) {
    shaping.shape = Shape::none;
    return;
  }
  const auto hinge = hinge_near(shaping, -glm::dvec3(camera.forward()));
  shaping.hinge = hinge.value_or(plane_axes(glm::normalize(way)).u);
}

std::vector<mesh::Vec3> smoothing_displacements(const document::Document& document, const Grip& grip) {
  const auto& positions = document.pose().positions;
  std::vector<mesh::Point> sums(positions.size(), {0, 0, 0});
  std::vector<double> counts(positions.size(), 0);
  for (const auto& [a, b] : document.cage()->edges) {
    sums[a] = sums[a] + positions[b];
    sums[b] = sums[b] + positions[a];
    ++counts[a];
    ++counts[b];
  }
  std::vector<mesh::Vec3> displacements;
  for (const Gripped& g : grip.vertices) {
    const auto v = g.vertex;
    displacements.push_back(counts[v] > 0 ? 1 / counts[v] * sums[v] - positions[v] : mesh::Vec3{0, 0, 0});
  }
  return displacements;
}

std::vector<mesh::Vec3> relaxing_displacements(const document::Document& document, const Grip& grip) {
  std::vector<mesh::Vec3> displacements;
  for (const Gripped& g : grip.vertices)
    displacements.push_back(document.cage()->surface.positions[g.vertex] -
                            document.pose().positions[g.vertex]);
  return displacements;
}

}  // namespace

Shaping shaping_of(const document::Document& document, Shape shape, const Grip& grip, bool at_median,
                   const document::Camera& camera) {
  Shaping shaping;
  shaping.shape = shape;
  switch (shape) {
    case Shape::none: break;
    case Shape::bend:
    case Shape::twist:
    case Shape::taper: put_ends(document, grip, at_median, camera, shaping); break;
    case Shape::smooth: shaping.displacements = smoothing_displacements(document, grip); break;
    case Shape::relax: shaping.displacements = relaxing_displacements(document, grip); break;
  }
  return shaping;
}

std::optional<glm::dvec3> hinge_near(const Shaping& shaping, const glm::dvec3& direction) {
  const glm::dvec3 a = glm::normalize(shaping.to - shaping.from);
  const glm::dvec3 across = direction - glm::dot(direction, a) * a;
  if (!(glm::length(across) > 1e-3)) return std::nullopt;
  return glm::normalize(across);
}

}  // namespace viete::interact
