// Vertices, edges and faces of a cage as selectable elements: their vertices and connectivity; hiding and
// saved sets. Each change is an undoable edit.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "deform/cage.h"
#include "document/document.h"
#include "document/selection.h"

namespace viete::document {

/// Elements of the cage; 0 for probes.
std::size_t element_count(const deform::Cage& cage, ElementKind kind);
/// Elements of the document, with or without a cage.
std::size_t element_count(const Document& document, ElementKind kind);

/// In polygon order; two for an edge, one for a vertex.
std::vector<std::uint32_t> element_vertices(const deform::Cage& cage, ElementKind kind, std::uint32_t index);

/// In the current pose: the mean of its vertices, or the probe's position.
mesh::Point element_middle(const Document& document, ElementKind kind, std::uint32_t index);

/// The vertices of all selected elements, ascending and unique.
std::vector<std::uint32_t> selected_vertices(const deform::Cage& cage, const Selection& selection);

/// The elements of `kind` whose vertices are all in the selection.
Selection converted(const deform::Cage& cage, const Selection& selection, ElementKind kind);

/// The selection and everything connected to it by edges.
Selection linked(const deform::Cage& cage, const Selection& selection);

/// Grows by one ring: adds vertices connected by an edge, or edges or faces that share a vertex. Probes are
/// unchanged.
Selection grown(const deform::Cage& cage, const Selection& selection);
/// Shrinks by one ring. Boundaries of an open cage stay.
Selection shrunk(const deform::Cage& cage, const Selection& selection);

/// "vertex", "edge", "face" or "probe".
std::string element_name(ElementKind kind);
/// "an edge", "3 faces".
std::string counted(ElementKind kind, std::size_t count);

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
/// Ignores an empty name and the name of another set.
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

}  // namespace viete::document
