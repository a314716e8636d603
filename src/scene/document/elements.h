// Vertices, edges and faces of a cage as things to select: which vertices they move, and what is linked with
// them.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "deform/cage.h"
#include "scene/document/document.h"
#include "scene/document/selection.h"

namespace viete::scene {

/// Of the cage: 0 for probes, which have no vertices either.
std::size_t element_count(const deform::Cage& cage, ElementKind kind);
/// Of the document, whether it has a cage or not.
std::size_t element_count(const Document& document, ElementKind kind);

/// In the order of the polygon; two for an edge, one for a vertex.
std::vector<std::uint32_t> element_vertices(const deform::Cage& cage, ElementKind kind, std::uint32_t index);

/// In the pose: the mean of its vertices, or where the probe is.
mesh::Point element_middle(const Document& document, ElementKind kind, std::uint32_t index);

/// The vertices of all selected elements, ascending, each once: what moves with them.
std::vector<std::uint32_t> selected_vertices(const deform::Cage& cage, const Selection& selection);

/// The elements of `kind` whose vertices are all among those of the selection.
Selection converted(const deform::Cage& cage, const Selection& selection, ElementKind kind);

/// With everything that edges connect to it.
Selection linked(const deform::Cage& cage, const Selection& selection);

/// "vertex", "edge", "face" or "probe".
std::string element_name(ElementKind kind);
/// "an edge", "3 faces".
std::string counted(ElementKind kind, std::size_t count);

/// With the rings that the selected edges are of; of vertices the edges between them. Two triangles that make
/// a good quad together (cages/extraction.h) count as one, so that rings run through cages that once were quads.
/// Faces and probes are as they were. O(n log n).
Selection ringed(const deform::Cage& cage, const Selection& selection);

}  // namespace viete::scene
