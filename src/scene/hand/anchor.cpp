#include "scene/hand/anchor.h"

#include <algorithm>
#include <cmath>

#include "cages/subject.h"
#include "mesh/union_find.h"
#include "scene/document/elements.h"
#include "scene/document/selection_sets.h"
#include "scene/document/space.h"
#include "scene/hand/cursor_projection.h"

namespace viete::scene {

namespace {

using Vertices = std::vector<std::uint32_t>;

mesh::Point mean_of(std::span<const mesh::Point> positions, std::span<const std::uint32_t> vertices) {
  mesh::Point sum{0, 0, 0};
  for (const auto v : vertices) sum = sum + 1 / static_cast<double>(vertices.size()) * positions[v];
  return sum;
}

bool selects_probes(const Document& document) {
  return document.selection.kind() == ElementKind::probe;
}

// The connected component of each leading vertex, named by one of its vertices.
std::vector<std::uint32_t> islands_of(const Document& document, const Vertices& vertices) {
  const deform::Cage& cage = *document.cage;
  mesh::UnionFind together(cage.surface.positions.size());
  const ElementKind kind = document.selection.kind();
  if (kind == ElementKind::vertex) {
    std::vector<char> is_in(cage.surface.positions.size(), 0);
    for (const auto v : vertices) is_in[v] = 1;
    for (const auto& [a, b] : cage.edges) {
      if (is_in[a] && is_in[b]) together.join(a, b);
    }
  } else {
    for (const auto i : document.selection.indices()) {
      const auto own = element_vertices(cage, kind, i);
      for (const auto v : own) together.join(own.front(), v);
    }
  }
  std::vector<std::uint32_t> islands;
  for (const auto v : vertices) islands.push_back(together.find(v));
  return islands;
}

void put_pivots_of_islands(const Document& document, const Vertices& vertices, Anchor& anchor) {
  const auto islands = islands_of(document, vertices);
  Vertices roots(islands);
  std::ranges::sort(roots);
  roots.erase(std::ranges::unique(roots).begin(), roots.end());
  std::vector<Vertices> members(roots.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const auto at = std::ranges::lower_bound(roots, islands[i]) - roots.begin();
    anchor.pivot_of.push_back(static_cast<std::uint32_t>(at));
    members[static_cast<std::size_t>(at)].push_back(vertices[i]);
  }
  anchor.pivots.clear();
  for (const Vertices& island : members)
    anchor.pivots.push_back(vector_of(mean_of(document.pose.positions, island)));
}

// The vertices connected by edges with the largest fixed part; empty if there is none.
Vertices border_of(const deform::Cage& cage, const Vertices& vertices) {
  const std::size_t count = cage.surface.positions.size();
  std::vector<char> moves(count, 0);
  for (const auto v : vertices) moves[v] = 1;
  mesh::UnionFind together(count);
  for (const auto& [a, b] : cage.edges) {
    if (!moves[a] && !moves[b]) together.join(a, b);
  }
  std::vector<std::size_t> size(count, 0);
  for (std::uint32_t v = 0; v < count; ++v) ++size[together.find(v)];
  std::vector<std::uint32_t> joined_to(count, 0);  // the largest part adjacent to a vertex
  std::size_t largest = 0;
  const auto meet = [&](std::uint32_t moving, std::uint32_t staying) {
    if (!moves[moving] || moves[staying]) return;
    largest = std::max(largest, size[together.find(staying)]);
    joined_to[moving] = std::max(joined_to[moving], static_cast<std::uint32_t>(size[together.find(staying)]));
  };
  for (const auto& [a, b] : cage.edges) meet(a, b), meet(b, a);
  Vertices border;
  for (const auto v : vertices) {
    if (largest > 0 && joined_to[v] == largest) border.push_back(v);
  }
  return border;
}

std::optional<glm::dvec3> center_of_active(const Document& document) {
  const auto active = document.selection.active();
  if (!active) return std::nullopt;
  if (selects_probes(document)) return std::nullopt;
  const auto own = element_vertices(*document.cage, document.selection.kind(), *active);
  return vector_of(mean_of(document.pose.positions, own));
}

// X is kept as far as possible, Z is perpendicular to both.
glm::dmat3 axes_from(const glm::dvec3& z, const glm::dvec3& near_x) {
  const glm::dvec3 across = near_x - glm::dot(near_x, z) * z;
  const double length = glm::length(across);
  const glm::dvec3 x = length > 1e-9 ? across / length : plane_axes(z).u;
  return {x, glm::cross(z, x), z};
}

// Makes its largest component positive, so that signs are stable while vertices move.
glm::dvec3 forward(const mesh::Vec3& axis) {
  const glm::dvec3 a = glm::normalize(vector_of(axis));
  int largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(a[i]) > std::abs(a[largest]) + 1e-9) largest = i;
  }
  return a[largest] < 0 ? -a : a;
}

// The sum of area vectors (twice the area) of the faces whose vertices all are listed.
glm::dvec3 normal_at(const Document& document, std::span<const std::uint32_t> vertices) {
  const mesh::Surface& cage = document.cage->surface;
  glm::dvec3 sum(0);
  for (std::uint32_t p = 0; p < cage.polygon_count(); ++p) {
    const auto begin = cage.corners.begin() + cage.polygon_starts[p],
               end = cage.corners.begin() + cage.polygon_starts[p + 1];
    const bool has_all =
        std::ranges::all_of(vertices, [&](auto v) { return std::find(begin, end, v) != end; });
    if (!has_all) continue;
    const mesh::Point& from = document.pose.positions[*begin];
    for (auto c = begin + 1; c + 1 < end; ++c) {
      sum += vector_of(
          mesh::cross(document.pose.positions[*c] - from, document.pose.positions[*(c + 1)] - from));
    }
  }
  return sum;
}

glm::dvec3 longest_edge(const Document& document, std::span<const std::uint32_t> vertices) {
  glm::dvec3 longest(0);
  for (std::size_t i = 0; i < vertices.size() && vertices.size() > 1; ++i) {
    const auto a = document.pose.positions[vertices[i]],
               b = document.pose.positions[vertices[(i + 1) % vertices.size()]];
    const glm::dvec3 edge = vector_of(b - a);
    if (glm::length(edge) > glm::length(longest) * (1 + 1e-9)) longest = edge;
  }
  return longest;
}

std::optional<glm::dmat3> axes_of_active(const Document& document) {
  const auto active = document.selection.active();
  if (!active || selects_probes(document)) return std::nullopt;
  const auto own = element_vertices(*document.cage, document.selection.kind(), *active);
  const glm::dvec3 normal = normal_at(document, own);
  if (!(glm::length(normal) > 0)) return std::nullopt;
  const glm::dvec3 along = longest_edge(document, own);
  const glm::dvec3 z = glm::normalize(normal);
  return axes_from(z, glm::length(along) > 0 ? glm::normalize(along) : glm::dvec3(0));
}

glm::dmat3 axes_of(const Document& document, const Handling& handling, const Mirror* mirror,
                   const Vertices& vertices, const Camera& camera) {
  switch (handling.axes) {
    case Axes::world: break;
    case Axes::view:
      return {glm::dvec3(camera.right()), glm::dvec3(camera.up()), -glm::dvec3(camera.forward())};
    case Axes::active: return axes_of_active(document).value_or(glm::dmat3(1));
    case Axes::mirror: {
      if (!mirror) break;
      const glm::dvec3 x = vector_of(mirror->plane.normal);
      const glm::dvec3 up = camera.pose().up == UpAxis::z ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
      const glm::dmat3 turned = axes_from(x, up);  // x is its third column
      return {x, turned[0], turned[1]};
    }
    case Axes::selection: {
      std::vector<mesh::Point> points;
      for (const auto v : vertices) points.push_back(document.pose.positions[v]);
      return axes_of_points(std::move(points)).value_or(glm::dmat3(1));
    }
  }
  return glm::dmat3(1);
}

glm::dvec3 middle_of(const Document& document, const Vertices& vertices) {
  if (!selects_probes(document)) return vector_of(mean_of(document.pose.positions, vertices));
  glm::dvec3 sum(0);
  const auto count = static_cast<double>(document.selection.size());
  for (const auto i : document.selection.indices()) sum += vector_of(probe_center(document, i)) / count;
  return sum;
}

void put_pivots(const Document& document, const Handling& handling, const Vertices& vertices,
                Anchor& anchor) {
  switch (handling.pivot) {
    case Pivot::median: break;
    case Pivot::active: anchor.center = center_of_active(document).value_or(anchor.center); break;
    case Pivot::point:
      if (handling.point) anchor.center = vector_of(*handling.point);
      break;
    case Pivot::joint: {
      if (!selects_probes(document)) anchor.center = joint_of(document, vertices).value_or(anchor.center);
      break;
    }
    case Pivot::individual:
      if (!selects_probes(document)) return put_pivots_of_islands(document, vertices, anchor);
      break;
  }
  anchor.pivots = {anchor.center};
}

}  // namespace

std::optional<glm::dmat3> axes_of_points(std::vector<mesh::Point> points) {
  mesh::Surface cloud;
  cloud.positions = std::move(points);
  if (cloud.positions.size() < 2 || !(mesh::bounds(cloud.positions).diagonal() > 0)) return std::nullopt;
  const cages::Frame frame = cages::own_frame(cloud);
  std::array<std::pair<double, glm::dvec3>, 3> extents;
  for (std::size_t i = 0; i < 3; ++i) {
    double low = 1e300, high = -1e300;
    for (const auto& p : cloud.positions) {
      const double at = mesh::dot(frame.axes[i], p - frame.center) * frame.scale;
      low = std::min(low, at), high = std::max(high, at);
    }
    extents[i] = {high - low, forward(frame.axes[i])};
  }
  std::ranges::stable_sort(extents, std::greater<>(), [](const auto& e) { return e.first; });
  return axes_from(extents[2].second, extents[0].second);
}

std::optional<glm::dvec3> joint_of(const Document& document, const std::vector<std::uint32_t>& vertices) {
  const Vertices border = border_of(*document.cage, vertices);
  if (border.empty()) return std::nullopt;
  return vector_of(mean_of(document.pose.positions, border));
}

std::vector<std::uint32_t> leading_vertices(const Document& document, const Mirror* mirror) {
  std::vector<std::uint32_t> selected = moving_vertices(document);
  if (!mirror || selected.empty()) return selected;
  const auto& rest = document.cage->surface.positions;
  const auto side = [&](std::uint32_t v) {
    return mesh::dot(mirror->plane.normal, rest[v]) - mirror->plane.offset;
  };
  double balance = 0;
  for (const auto v : selected) balance += mirror->is_paired(v) ? (side(v) >= 0 ? 1 : -1) : 0;
  if (const auto active = document.selection.active()) {
    double of_active = 0;
    for (const auto v : element_vertices(*document.cage, document.selection.kind(), *active))
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

Anchor anchor_of(const Document& document, const Handling& handling, const Mirror* mirror,
                 const Camera& camera) {
  const Vertices vertices = leading_vertices(document, mirror);
  Anchor anchor;
  anchor.center = middle_of(document, vertices);
  anchor.axes = axes_of(document, handling, mirror, vertices, camera);
  put_pivots(document, handling, vertices, anchor);
  return anchor;
}

}  // namespace viete::scene
