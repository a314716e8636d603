// Defects of a model and its cage, element by element, with their effect on the deformation; and messages
// about ambiguous decisions of the deformer in a pose.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "deform/maps.h"
#include "document/document.h"
#include "mesh/summary.h"

namespace viete::document {

/// In the order of checking.
enum class Defect {
  vertices_outside,   ///< cage: model vertices outside it
  self_intersection,  ///< faces
  open,               ///< edges with one face
  nonmanifold_edge,   ///< edges with three or more faces
  pinched_vertex,     ///< vertices whose faces form several fans that meet only there
  misoriented,        ///< edges whose faces run in opposite directions
  inside_out,         ///< all faces of a closed surface with negative volume
  degenerate,         ///< faces with a zero-area triangle
  thin,               ///< cage: faces with a triangle thinner than a thousandth of its length
  doubled_vertex,     ///< vertices at the position of another one
  unused_vertex,      ///< vertices without a face
};

enum class Subject { model, cage };

/// One kind of defect and all elements that have it, by 0-based index in file order.
struct Finding {
  Defect defect = Defect::open;
  Subject subject = Subject::model;        ///< the surface the elements belong to
  ElementKind kind = ElementKind::vertex;  ///< element type: an edge is two vertices, a face a polygon
  std::vector<std::uint32_t> elements;     ///< vertices or faces, ascending
  std::vector<mesh::Edge> edges;           ///< or edges, ascending

  std::size_t size() const { return kind == ElementKind::edge ? edges.size() : elements.size(); }
};

/// True if the deformation is visibly affected; false for information only.
bool matters(const Finding& finding);
/// "3 open edges", with thousands separators.
std::string title(const Finding& finding);
/// An explanation in one or two sentences.
std::string meaning(const Finding& finding);
/// The first elements by index: "0, 5, 12 and 220 more", edges as "3-7".
std::string first_elements(const Finding& finding, std::size_t most);
/// Vertices of one element.
std::vector<std::uint32_t> vertices_of(const Finding& finding, const mesh::Surface& surface,
                                       std::size_t element);

/// `summary` must be the model's. The cage is checked with coincident vertices merged, as the deformation
/// uses it. progress may be null. Throws base::Cancelled. Thread-safe.
std::vector<Finding> check_model(const mesh::Surface& model, const mesh::Summary& summary);
std::vector<Finding> check_cage(const mesh::Surface& cage, base::Progress* progress = nullptr);
/// Checks that the cage encloses the model, regardless of face orientation: one finding or none.
std::optional<Finding> check_enclosure(const mesh::Surface& cage, const mesh::Surface& model,
                                       base::Progress* progress = nullptr);

/// All findings, those that matter first; cage.surface may be null. Thread-safe.
std::vector<Finding> check(const OpenedSurface& model, const OpenedSurface& cage,
                           base::Progress* progress = nullptr);

/// One line per kind of problem, with its count and first location; empty for a pose without problems.
/// Distinguishes a closed cage that is inside out, as by a mirror, from one that is torn.
std::vector<std::string> pose_notes(const deform::LogReport& report, const deform::Cage& cage,
                                    const deform::Pose& pose);

/// The end vertices of cage edges between torn neighbours, at most `most`; empty unless elements are
/// triangles or vertices.
std::vector<std::array<std::uint32_t, 2>> torn_edges(const deform::LogReport& report,
                                                     const deform::Cage& cage, std::size_t most);

}  // namespace viete::document
