// Vertices, edges and faces of a cage as selectable elements: their vertices and connectivity.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "deform/cage.h"
#include "scene/document/document.h"
#include "scene/document/selection.h"

namespace viete::scene {

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

/// "vertex", "edge", "face" or "probe".
std::string element_name(ElementKind kind);
/// "an edge", "3 faces".
std::string counted(ElementKind kind, std::size_t count);

/// Adds the edge rings of the selected edges; for vertices, of the edges between them. Two triangles that
/// form a good quad (cages/extraction.h) count as one quad, so that rings run through triangulated quad cages.
/// Faces and probes are unchanged. O(n log n).
Selection ringed(const deform::Cage& cage, const Selection& selection);

}  // namespace viete::scene
