#include "scene/document/selection_sets.h"

#include <algorithm>
#include <utility>

#include "scene/document/elements.h"
#include "scene/document/record.h"

namespace viete::scene {

namespace {

std::vector<std::uint8_t> marked(std::size_t count, std::span<const std::uint32_t> some) {
  std::vector<std::uint8_t> marks(count, 0);
  for (const auto i : some) {
    if (i < count) marks[i] = 1;
  }
  return marks;
}

std::vector<std::uint32_t> numbers_of(const std::vector<std::uint8_t>& marks) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < marks.size(); ++i) {
    if (marks[i]) numbers.push_back(i);
  }
  return numbers;
}

// Hides vertices and deselects them in the same edit.
void put_hidden(Document& document, std::vector<std::uint32_t> hidden, const char* label) {
  if (hidden == document.groups.hidden) return;
  record_edit(document, label);
  document.groups.hidden = std::move(hidden);
  document.selection = without_hidden(document, std::move(document.selection));
}

bool has_name(const Document& document, const std::string& name) {
  return std::ranges::count(document.groups.sets, name, &NamedSet::name) > 0;
}

std::string free_name(const Document& document) {
  for (int number = 1;; ++number) {
    const std::string name = "Set " + std::to_string(number);
    if (!has_name(document, name)) return name;
  }
}

}  // namespace

std::vector<std::uint8_t> hidden_elements(const Document& document, ElementKind kind) {
  std::vector<std::uint8_t> hidden(element_count(document, kind), 0);
  if (kind == ElementKind::probe || !document.has_cage() || document.groups.hidden.empty()) return hidden;
  const auto vertices = marked(document.cage->surface.positions.size(), document.groups.hidden);
  if (kind == ElementKind::vertex) return vertices;
  for (std::uint32_t i = 0; i < hidden.size(); ++i) {
    const auto own = element_vertices(*document.cage, kind, i);
    hidden[i] = std::ranges::all_of(own, [&](auto v) { return vertices[v] != 0; });
  }
  return hidden;
}

Selection without_hidden(const Document& document, Selection selection) {
  if (document.groups.hidden.empty()) return selection;
  const auto hidden = hidden_elements(document, selection.kind());
  selection.apply(numbers_of(hidden), SelectMode::remove);
  return selection;
}

std::vector<std::uint32_t> without_hidden(const Document& document, std::vector<std::uint32_t> vertices) {
  const auto& hidden = document.groups.hidden;
  std::erase_if(vertices, [&](auto v) { return std::ranges::binary_search(hidden, v); });
  return vertices;
}

void hide_selected(Document& document) {
  Selection hidden(ElementKind::vertex, document.groups.hidden);
  hidden.apply(selected_vertices(*document.cage, document.selection), SelectMode::add);
  put_hidden(document, hidden.indices(), "hide");
}

void hide_others(Document& document) {
  Selection hidden(ElementKind::vertex, selected_vertices(*document.cage, document.selection));
  hidden.invert(document.cage->surface.positions.size());
  put_hidden(document, hidden.indices(), "hide others");
}

void show_all(Document& document) {
  put_hidden(document, {}, "show all");
}

void save_set(Document& document) {
  record_edit(document, "save selection set");
  document.groups.sets.push_back({free_name(document), document.selection.kind(),
                                  selected_vertices(*document.cage, document.selection)});
}

void select_set(Document& document, std::size_t set, SelectMode mode) {
  const NamedSet& named = document.groups.sets[set];
  const Selection vertices(ElementKind::vertex, named.vertices);
  const Selection elements = converted(*document.cage, vertices, named.kind);
  Selection now = mode == SelectMode::replace || document.selection.kind() == ElementKind::probe
                      ? Selection(named.kind)
                      : converted(*document.cage, document.selection, named.kind);
  now.apply(elements.indices(), mode);
  set_selection(document, std::move(now));
}

void rename_set(Document& document, std::size_t set, const std::string& name) {
  if (name.empty() || has_name(document, name)) return;
  record_edit(document, "rename selection set");
  document.groups.sets[set].name = name;
}

void remove_set(Document& document, std::size_t set) {
  record_edit(document, "delete selection set");
  document.groups.sets.erase(document.groups.sets.begin() + static_cast<std::ptrdiff_t>(set));
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
  if (document.selection.kind() == ElementKind::probe) return {};
  return without_hidden(document, selected_vertices(*document.cage, document.selection));
}

void set_selection(Document& document, Selection selection) {
  const Selection before = std::exchange(document.selection, without_hidden(document, std::move(selection)));
  record_selection(document, before);
}

}  // namespace viete::scene
