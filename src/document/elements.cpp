#include "document/elements.h"

#include <algorithm>
#include <utility>

#include "mesh/union_find.h"

namespace viete::document {

namespace {

using Marks = std::vector<std::uint8_t>;  // 1 for each marked vertex or element

Marks marked(std::size_t count, std::span<const std::uint32_t> some) {
  Marks marks(count, 0);
  for (const auto i : some) {
    if (i < count) marks[i] = 1;
  }
  return marks;
}

Marks marks_of(const pose::Cage& cage, const Selection& selection) {
  return marked(cage.surface.positions.size(), selected_vertices(cage, selection));
}

// Returns the elements with marked vertices. `holds` is std::ranges::all_of if all vertices of an element
// must be marked, or std::ranges::any_of if one marked vertex is sufficient.
template <class Holds>
Selection elements_with(const pose::Cage& cage, ElementKind kind, const Marks& marks, const Holds& holds) {
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < element_count(cage, kind); ++i)
    if (holds(element_vertices(cage, kind, i), [&](auto v) { return marks[v] != 0; })) found.push_back(i);
  return Selection(kind, found);
}

Selection within(const pose::Cage& cage, ElementKind kind, const Marks& marks) {
  return elements_with(cage, kind, marks, std::ranges::all_of);
}

Marks touched_by(const pose::Cage& cage, const Selection& selection) {
  const Marks own = marks_of(cage, selection);
  Marks touched = own;
  if (selection.kind() != ElementKind::vertex) return touched;
  for (const auto& [a, b] : cage.edges)
    if (own[a] || own[b]) touched[a] = touched[b] = 1;
  return touched;
}

}  // namespace

std::size_t element_count(const pose::Cage& cage, ElementKind kind) {
  switch (kind) {
    case ElementKind::vertex: return cage.surface.positions.size();
    case ElementKind::edge: return cage.edges.size();
    case ElementKind::probe: return 0;
    case ElementKind::face: break;
  }
  return cage.surface.polygon_count();
}

std::size_t element_count(const Document& document, ElementKind kind) {
  if (kind == ElementKind::probe) return document.probes().all.size();
  return document.has_cage() ? element_count(*document.cage(), kind) : 0;
}

std::vector<std::uint32_t> element_vertices(const pose::Cage& cage, ElementKind kind, std::uint32_t index) {
  if (kind == ElementKind::probe) return {};
  if (kind == ElementKind::vertex) return {index};
  if (kind == ElementKind::edge) return {cage.edges[index].begin(), cage.edges[index].end()};
  const auto& corners = cage.surface.corners;
  const auto& starts = cage.surface.polygon_starts;
  return {corners.begin() + starts[index], corners.begin() + starts[index + 1]};
}

mesh::Point element_middle(const Document& document, ElementKind kind, std::uint32_t index) {
  if (kind == ElementKind::probe) return probe_center(document, index);
  const auto vertices = element_vertices(*document.cage(), kind, index);
  mesh::Point sum{0, 0, 0};
  const double share = 1 / static_cast<double>(vertices.size());
  for (const auto v : vertices) sum = sum + share * document.pose().positions[v];
  return sum;
}

std::vector<std::uint32_t> selected_vertices(const pose::Cage& cage, const Selection& selection) {
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

Selection converted(const pose::Cage& cage, const Selection& selection, ElementKind kind) {
  return kind == selection.kind() ? selection : within(cage, kind, marks_of(cage, selection));
}

Selection linked(const pose::Cage& cage, const Selection& selection) {
  mesh::UnionFind parts(cage.surface.positions.size());
  for (const auto& [a, b] : cage.edges) parts.join(a, b);
  Marks reached(cage.surface.positions.size(), 0), marks = reached;
  for (const auto v : selected_vertices(cage, selection)) reached[parts.find(v)] = 1;
  for (std::uint32_t v = 0; v < marks.size(); ++v) marks[v] = reached[parts.find(v)];
  return within(cage, selection.kind(), marks);
}

Selection grown(const pose::Cage& cage, const Selection& selection) {
  if (selection.kind() == ElementKind::probe) return selection;
  return elements_with(cage, selection.kind(), touched_by(cage, selection), std::ranges::any_of);
}

Selection shrunk(const pose::Cage& cage, const Selection& selection) {
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

namespace {

Selection hidden_of(const Document& document, ElementKind kind) {
  const auto& hidden = document.groups().hidden;
  if (kind == ElementKind::probe || !document.has_cage() || hidden.empty()) return Selection(kind);
  if (kind == ElementKind::vertex) return Selection(kind, hidden);
  return within(*document.cage(), kind, marked(document.cage()->surface.positions.size(), hidden));
}

// Sets the hidden vertices, and deselects hidden elements. Both changes form one edit.
void put_hidden(Document& document, std::vector<std::uint32_t> hidden, const char* label) {
  if (hidden == document.groups().hidden) return;
  record_edit(document, label);
  document.changed_groups().hidden = std::move(hidden);
  document.changed_selection() = without_hidden(document, std::move(document.changed_selection()));
}

bool has_name(const Document& document, const std::string& name) {
  return std::ranges::count(document.groups().sets, name, &NamedSet::name) > 0;
}

std::string free_name(const Document& document) {
  for (int number = 1;; ++number) {
    const std::string name = "Set " + std::to_string(number);
    if (!has_name(document, name)) return name;
  }
}

}  // namespace

std::vector<std::uint8_t> hidden_elements(const Document& document, ElementKind kind) {
  return marked(element_count(document, kind), hidden_of(document, kind).indices());
}

Selection without_hidden(const Document& document, Selection selection) {
  selection.apply(hidden_of(document, selection.kind()).indices(), SelectMode::remove);
  return selection;
}

std::vector<std::uint32_t> without_hidden(const Document& document, std::vector<std::uint32_t> vertices) {
  const auto& hidden = document.groups().hidden;
  std::erase_if(vertices, [&](auto v) { return std::ranges::binary_search(hidden, v); });
  return vertices;
}

void hide_selected(Document& document) {
  Selection hidden(ElementKind::vertex, document.groups().hidden);
  hidden.apply(selected_vertices(*document.cage(), document.selection()), SelectMode::add);
  put_hidden(document, hidden.indices(), "hide selected");
}

void hide_others(Document& document) {
  Selection hidden(ElementKind::vertex, selected_vertices(*document.cage(), document.selection()));
  hidden.invert(document.cage()->surface.positions.size());
  put_hidden(document, hidden.indices(), "hide unselected");
}

void show_all(Document& document) {
  put_hidden(document, {}, "show hidden");
}

void save_set(Document& document) {
  record_edit(document, "save selection set");
  document.changed_groups().sets.push_back({free_name(document), document.selection().kind(),
                                            selected_vertices(*document.cage(), document.selection())});
}

void select_set(Document& document, std::size_t set, SelectMode mode) {
  const NamedSet& named = document.groups().sets[set];
  const Selection vertices(ElementKind::vertex, named.vertices);
  const Selection elements = converted(*document.cage(), vertices, named.kind);
  Selection now = mode == SelectMode::replace || document.selection().kind() == ElementKind::probe
                      ? Selection(named.kind)
                      : converted(*document.cage(), document.selection(), named.kind);
  now.apply(elements.indices(), mode);
  set_selection(document, std::move(now));
}

void rename_set(Document& document, std::size_t set, const std::string& name) {
  if (name.empty() || has_name(document, name)) return;
  record_edit(document, "rename selection set");
  document.changed_groups().sets[set].name = name;
}

void remove_set(Document& document, std::size_t set) {
  record_edit(document, "delete selection set");
  document.changed_groups().sets.erase(document.groups().sets.begin() + static_cast<std::ptrdiff_t>(set));
}

CageGroups carried(const CageGroups& groups, std::size_t vertices,
                   const std::vector<std::span<const std::uint32_t>>& origins) {
  const auto carry = [&](std::span<const std::uint32_t> some) {
    const auto marks = marked(vertices, some);
    std::vector<std::uint32_t> now;
    for (std::uint32_t v = 0; v < origins.size(); ++v) {
      const bool from_them = std::ranges::all_of(origins[v], [&](auto o) { return marks[o] != 0; });
      if (!origins[v].empty() && from_them) now.push_back(v);
    }
    return now;
  };
  CageGroups now{carry(groups.hidden), {}};
  for (const NamedSet& set : groups.sets) {
    auto left = carry(set.vertices);
    if (!left.empty()) now.sets.push_back({set.name, set.kind, std::move(left)});
  }
  return now;
}

std::string lost_sets(const CageGroups& before, const CageGroups& after) {
  std::string names;
  for (const NamedSet& set : before.sets) {
    if (std::ranges::count(after.sets, set.name, &NamedSet::name) == 0)
      names += (names.empty() ? "\"" : ", \"") + set.name + '"';
  }
  return names;
}

std::vector<std::uint32_t> moving_vertices(const Document& document) {
  if (document.selection().kind() == ElementKind::probe) return {};
  return without_hidden(document, selected_vertices(*document.cage(), document.selection()));
}

void set_selection(Document& document, Selection selection) {
  const Selection before =
      std::exchange(document.changed_selection(), without_hidden(document, std::move(selection)));
  record_selection(document, before);
}

}  // namespace viete::document
