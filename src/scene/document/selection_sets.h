// Hiding what is selected, and keeping it by name. Each change is an edit that can be undone; all require a
// cage.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "scene/document/document.h"

namespace viete::scene {

/// Of the elements of a kind, 1 for those that are hidden; of probes none is.
std::vector<std::uint8_t> hidden_elements(const Document& document, ElementKind kind);
/// Without what is hidden.
Selection without_hidden(const Document& document, Selection selection);
std::vector<std::uint32_t> without_hidden(const Document& document, std::vector<std::uint32_t> vertices);

/// Nothing of it is selected any more.
void hide_selected(Document& document);
/// All but what is selected.
void hide_others(Document& document);
void show_all(Document& document);

/// What is selected, as "Set 1" or the next number; requires a selection of the cage.
void save_set(Document& document);
/// It is selected, added to the selection or taken out of it, which is then of its kind.
void select_set(Document& document, std::size_t set, SelectMode mode);
/// An empty name changes nothing, nor does that of another set.
void rename_set(Document& document, std::size_t set, const std::string& name);
void remove_set(Document& document, std::size_t set);

/// Where vertices of another cage come from vertices of this one, each from all of those: hidden are those
/// that come from hidden ones alone; sets go likewise, and those that have none left go.
CageGroups carried(const CageGroups& groups, std::size_t vertices,
                   const std::vector<std::span<const std::uint32_t>>& origins);
/// Names of sets that are not there any more, for a sentence: "Arm" and "Leg"; empty for none.
std::string lost_sets(const CageGroups& before, const CageGroups& after);

/// The vertices of the cage that move with the selection; none of probes.
std::vector<std::uint32_t> moving_vertices(const Document& document);

/// Another selection as an edit, without what is hidden. Where nothing is selected before and after there is
/// nothing to take back. Nothing may be in the hand.
void set_selection(Document& document, Selection selection);

}  // namespace viete::scene
