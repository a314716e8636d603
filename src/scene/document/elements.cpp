#include "scene/document/elements.h"

#include <algorithm>

#include "mesh/union_find.h"

namespace viete::scene {

namespace {

// One byte per vertex: faster to write than vector<bool>.
using Marks = std::vector<std::uint8_t>;

Marks marks_of(const deform::Cage& cage, const Selection& selection) {
  Marks marks(cage.surface.positions.size(), 0);
  for (const auto v : selected_vertices(cage, selection)) marks[v] = 1;
  return marks;
}

// The elements that have `holds` of the marks of their vertices.
template <class Holds>
Selection elements_with(const deform::Cage& cage, ElementKind kind, const Marks& marks, const Holds& holds) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < element_count(cage, kind); ++i)
    if (holds(element_vertices(cage, kind, i), [&](auto v) { return marks[v] != 0; })) found.push_back(i);
  return Selection(kind, found);
}

Selection within(const deform::Cage& cage, ElementKind kind, const Marks& marks) {
  return elements_with(cage, kind, marks, std::ranges::all_of);
}

// The vertices of the selection; of selected vertices also their neighbours.
Marks touched_by(const deform::Cage& cage, const Selection& selection) {
  const Marks own = marks_of(cage, selection);
  Marks touched = own;
  if (selection.kind() != ElementKind::vertex) return touched;
  for (const auto& [a, b] : cage.edges)
    if (own[a] || own[b]) touched[a] = touched[b] = 1;
  return touched;
}

}  // namespace

std::size_t element_count(const deform::Cage& cage, ElementKind kind) {
  switch (kind) {
    case ElementKind::vertex: return cage.surface.positions.size();
    case ElementKind::edge: return cage.edges.size();
    case ElementKind::probe: return 0;
    case ElementKind::face: break;
  }
  return cage.surface.polygon_count();
}

std::size_t element_count(const Document& document, ElementKind kind) {
  if (kind == ElementKind::probe) return document.probes.all.size();
  return document.has_cage() ? element_count(*document.cage, kind) : 0;
}

std::vector<std::uint32_t> element_vertices(const deform::Cage& cage, ElementKind kind, std::uint32_t index) {
  if (kind == ElementKind::probe) return {};
  if (kind == ElementKind::vertex) return {index};
  if (kind == ElementKind::edge) return {cage.edges[index].begin(), cage.edges[index].end()};
  const auto& corners = cage.surface.corners;
  const auto& starts = cage.surface.polygon_starts;
  return {corners.begin() + starts[index], corners.begin() + starts[index + 1]};
}

mesh::Point element_middle(const Document& document, ElementKind kind, std::uint32_t index) {
  if (kind == ElementKind::probe) return probe_center(document, index);
  const auto vertices = element_vertices(*document.cage, kind, index);
  mesh::Point sum{0, 0, 0};
  const double share = 1 / static_cast<double>(vertices.size());
  for (const auto v : vertices) {
    for (std::size_t k = 0; k < 3; ++k) sum[k] += share * document.pose.positions[v][k];
  }
  return sum;
}

std::vector<std::uint32_t> selected_vertices(const deform::Cage& cage, const Selection& selection) {
  if (selection.kind() == ElementKind::vertex) return selection.indices();
  std::vector<std::uint32_t> vertices;
  for (const auto i : selection.indices()) {
    const auto own = element_vertices(cage, selection.kind(), i);
    vertices.insert(vertices.end(), own.begin(), own.end());
  }
  std::sort(vertices.begin(), vertices.end());
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

Selection converted(const deform::Cage& cage, const Selection& selection, ElementKind kind) {
  return kind == selection.kind() ? selection : within(cage, kind, marks_of(cage, selection));
}

Selection linked(const deform::Cage& cage, const Selection& selection) {
  mesh::UnionFind parts(cage.surface.positions.size());
  for (const auto& [a, b] : cage.edges) parts.join(a, b);
  Marks reached(cage.surface.positions.size(), 0), marks = reached;
  for (const auto v : selected_vertices(cage, selection)) reached[parts.find(v)] = 1;
  for (std::uint32_t v = 0; v < marks.size(); ++v) marks[v] = reached[parts.find(v)];
  return within(cage, selection.kind(), marks);
}

Selection grown(const deform::Cage& cage, const Selection& selection) {
  if (selection.kind() == ElementKind::probe) return selection;
  return elements_with(cage, selection.kind(), touched_by(cage, selection), std::ranges::any_of);
}

Selection shrunk(const deform::Cage& cage, const Selection& selection) {
  if (selection.kind() == ElementKind::probe) return selection;
  Selection others = selection, inner = selection;
  others.invert(element_count(cage, selection.kind()));
  const Marks touched = touched_by(cage, others);
  inner.apply(elements_with(cage, selection.kind(), touched, std::ranges::any_of).indices(),
              SelectMode::remove);
  return inner;
}

std::string element_name(ElementKind kind) {
  constexpr const char* names[] = {"vertex", "edge", "face", "probe"};
  return names[static_cast<std::size_t>(kind)];
}

std::string counted(ElementKind kind, std::size_t count) {
  if (count == 1) return (kind == ElementKind::edge ? "an " : "a ") + element_name(kind);
  return std::to_string(count) + ' ' + (kind == ElementKind::vertex ? "vertices" : element_name(kind) + "s");
}

}  // namespace viete::scene
