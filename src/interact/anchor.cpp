#include "interact/anchor.h"

#include <algorithm>
#include <cmath>

#include "cages/subject.h"
#include "document/elements.h"
#include "document/space.h"
#include "interact/cursor_projection.h"
#include "mesh/union_find.h"

namespace viete::interact {

namespace {

using Vertices = std::vector<std::uint32_t>;

mesh::Point mean_of(std::span<const mesh::Point> positions, std::span<const std::uint32_t> vertices) {
  mesh::Point sum{0, 0, 0};
  for (const auto v : vertices) sum = sum + 1 / static_cast<double>(vertices.size()) * positions[v];
  return sum;
}

bool selects_probes(const document::Document& document) {
  return document.selection.kind() == document::ElementKind::probe;
}

// Returns the given vertices that have an edge to the largest fixed part of the cage.
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
  std::vector<std::uint32_t> joined_to(count, 0);  // the size of the largest fixed part beside a vertex
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

// Returns axes with this Z axis. The X axis is as close as possible to `near_x`.
glm::dmat3 axes_from(const glm::dvec3& z, const glm::dvec3& near_x) {
  const glm::dvec3 across = near_x - glm::dot(near_x, z) * z;
  const double length = glm::length(across);
  const glm::dvec3 x = length > 1e-9 ? across / length : plane_axes(z).u;
  return {x, glm::cross(z, x), z};
}

// Reverses the axis if its largest component is negative, so that it does not flip while vertices move.
glm::dvec3 forward(const mesh::Vec3& axis) {
  const glm::dvec3 a = glm::normalize(document::vector_of(axis));
  int largest = 0;
  for (int i = 1; i < 3; ++i) {
    if (std::abs(a[i]) > std::abs(a[largest]) + 1e-9) largest = i;
  }
  return a[largest] < 0 ? -a : a;
}

glm::dvec3 middle_of(const document::Document& document, const Vertices& vertices) {
  if (!selects_probes(document)) return document::vector_of(mean_of(document.pose.positions, vertices));
  glm::dvec3 sum(0);
  const auto count = static_cast<double>(document.selection.size());
  for (const auto i : document.selection.indices())
    sum += document::vector_of(probe_center(document, i)) / count;
  return sum;
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

// Returns axes of the selection as columns, sorted from its longest extent to its shortest.
glm::dmat3 axes_of_selection(const document::Document& document, const Vertices& vertices) {
  mesh::Surface cloud;
  for (const auto v : vertices) cloud.positions.push_back(document.pose.positions[v]);
  if (cloud.positions.size() < 2 || !(mesh::bounds(cloud.positions).diagonal() > 0)) return glm::dmat3(1);
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

}  // namespace

std::optional<glm::dvec3> center_of_active(const document::Document& document) {
  const auto active = document.selection.active();
  if (!active || selects_probes(document)) return std::nullopt;
  return document::vector_of(element_middle(document, document.selection.kind(), *active));
}

std::optional<glm::dvec3> joint_of(const document::Document& document,
                                   const std::vector<std::uint32_t>& vertices) {
  const Vertices border = border_of(*document.cage, vertices);
  if (border.empty()) return std::nullopt;
  return document::vector_of(mean_of(document.pose.positions, border));
}

std::vector<std::uint32_t> leading_vertices(const document::Document& document,
                                            const document::Mirror* mirror) {
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

Anchor anchor_of(const document::Document& document, const document::Handling& handling,
                 const document::Mirror* mirror, const document::Camera& camera) {
  const Vertices vertices = leading_vertices(document, mirror);
  Anchor anchor{pivot_of(document, handling, vertices)};
  if (handling.axes == document::Axes::view)
    anchor.axes = {glm::dvec3(camera.right()), glm::dvec3(camera.up()), -glm::dvec3(camera.forward())};
  if (handling.axes == document::Axes::selection) anchor.axes = axes_of_selection(document, vertices);
  return anchor;
}

}  // namespace viete::interact
