// The elements that the user can select: vertices, edges and faces of a cage, and probes. Grows, hides and
// saves selections. Each change is an undoable edit.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "document/document.h"
#include "document/selection.h"
#include "pose/cage.h"

namespace viete::document {

/// Returns the number of elements of the cage; 0 for probes.
std::size_t element_count(const pose::Cage& cage, ElementKind kind);
/// Returns the number of elements of the document, including probes.
std::size_t element_count(const Document& document, ElementKind kind);

/// Returns the vertices of an element. A face's vertices are in polygon order; a probe has no vertices.
std::vector<std::uint32_t> element_vertices(const pose::Cage& cage, ElementKind kind, std::uint32_t index);

/// Returns the mean of the element's vertices in the current pose, or the position of a probe.
mesh::Point element_middle(const Document& document, ElementKind kind, std::uint32_t index);

/// Returns the vertices of all selected elements, ascending and unique.
std::vector<std::uint32_t> selected_vertices(const pose::Cage& cage, const Selection& selection);

/// Returns the elements of `kind` whose vertices are all in the selection.
Selection converted(const pose::Cage& cage, const Selection& selection, ElementKind kind);

/// Returns the selection, and all elements that are connected with the selection by edges.
Selection linked(const pose::Cage& cage, const Selection& selection);

/// Grows the selection by one ring. If vertices are selected, adds their neighbours along edges. If edges or
/// faces are selected, adds all edges or faces at a vertex of the selection. Selected probes do not change.
Selection grown(const pose::Cage& cage, const Selection& selection);
/// Shrinks the selection by one ring. At the boundary of an open cage, elements stay selected.
Selection shrunk(const pose::Cage& cage, const Selection& selection);

/// Returns "vertex", "edge", "face" or "probe".
std::string element_name(ElementKind kind);
/// Returns text such as "an edge" or "3 faces".
std::string counted(ElementKind kind, std::size_t count);

/// Returns 1 for each hidden element and 0 for each other element. Probes are never hidden.
std::vector<std::uint8_t> hidden_elements(const Document& document, ElementKind kind);
Selection without_hidden(const Document& document, Selection selection);
std::vector<std::uint32_t> without_hidden(const Document& document, std::vector<std::uint32_t> vertices);

/// Hides the selected elements and deselects them.
void hide_selected(Document& document);
void hide_others(Document& document);
void show_all(Document& document);

/// Saves the selection as "Set 1", or with the next free number. Requires selected cage elements.
void save_set(Document& document);
/// Selects a set, adds it to the selection, or deselects it. The new selection has the set's kind.
void select_set(Document& document, std::size_t set, SelectMode mode);
/// Renames a set. If the name is empty or in use, does nothing.
void rename_set(Document& document, std::size_t set, const std::string& name);
void remove_set(Document& document, std::size_t set);

/// Transfers hidden vertices and sets to an edited cage. `vertices` is the old number of vertices. origins[v]
/// has the old vertices of the new vertex v. If all of them are hidden, v is hidden. If all of them are in a
/// set, v is in the set. Removes empty sets.
CageGroups carried(const CageGroups& groups, std::size_t vertices,
                   const std::vector<std::span<const std::uint32_t>>& origins);
/// Returns the names of the removed sets, such as "Arm", "Leg". If no set was removed, returns an empty text.
std::string lost_sets(const CageGroups& before, const CageGroups& after);

/// Returns the cage vertices that a drag of the selection moves. If probes are selected, returns no vertices.
std::vector<std::uint32_t> moving_vertices(const Document& document);

/// Selects the elements, except hidden elements, as an undoable edit. Must not be called during a drag.
void set_selection(Document& document, Selection selection);

}  // namespace viete::document
