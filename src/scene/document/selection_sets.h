// Hiding the selection and saving selection sets. Each change is an undoable edit; all require a cage.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/document/document.h"

namespace viete::scene {

/// One flag per element of the kind: 1 if hidden. Probes are never hidden.
std::vector<std::uint8_t> hidden_elements(const Document& document, ElementKind kind);
/// Removes the hidden elements.
Selection without_hidden(const Document& document, Selection selection);
std::vector<std::uint32_t> without_hidden(const Document& document, std::vector<std::uint32_t> vertices);

/// Also deselects it.
void hide_selected(Document& document);
/// Hides everything except the selection.
void hide_others(Document& document);
void show_all(Document& document);

/// Saves the selection as "Set 1" or the next number; requires selected cage elements.
void save_set(Document& document);
/// Selects the set, adds it or removes it; the selection takes the set's kind.
void select_set(Document& document, std::size_t set, SelectMode mode);
/// An empty name, or one of another set, is ignored.
void rename_set(Document& document, std::size_t set, const std::string& name);
void remove_set(Document& document, std::size_t set);

/// Transfers the groups to another cage; `origins`: the source vertices of each new vertex. A vertex is
/// hidden if all its sources are; sets follow the same rule, and empty sets are removed.
CageGroups carried(const CageGroups& groups, std::size_t vertices,
                   const std::vector<std::span<const std::uint32_t>>& origins);
/// Names of removed sets for a message: "Arm" and "Leg"; empty: none.
std::string lost_sets(const CageGroups& before, const CageGroups& after);

/// Cage vertices that move with the selection; empty for probes.
std::vector<std::uint32_t> moving_vertices(const Document& document);

/// Sets the selection as an edit, without hidden elements. Two empty selections record nothing. Must not be
/// called during a drag.
void set_selection(Document& document, Selection selection);

}  // namespace viete::scene
