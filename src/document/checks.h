// Finds the defects of a model and its cage, and problems of a pose, with messages for the user.
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

enum class Defect {
  vertices_outside,   ///< model vertices outside the cage
  self_intersection,  ///< cage faces that intersect other faces
  open,               ///< edges with one face
  nonmanifold_edge,   ///< edges with three or more faces
  pinched_vertex,     ///< vertices at which several groups of faces meet without a shared edge
  misoriented,        ///< edges between faces of opposite orientation
  inside_out,         ///< all faces of a closed surface that has negative volume
  degenerate,         ///< faces that contain a triangle without area
  thin,               ///< cage faces that contain a triangle thinner than a thousandth of its length
  doubled_vertex,     ///< vertices at the position of another vertex
  unused_vertex,      ///< vertices without a face
};

enum class Subject { model, cage };

/// One kind of defect, and the elements that have this defect. Indices are 0-based, in file order.
struct Finding {
  Defect defect = Defect::open;
  Subject subject = Subject::model;        ///< the surface that has the elements
  ElementKind kind = ElementKind::vertex;  ///< vertex, edge or face
  std::vector<std::uint32_t> elements;     ///< ascending vertices or faces; empty if `kind` is edge
  std::vector<mesh::Edge> edges;           ///< ascending edges; empty unless `kind` is edge

  std::size_t size() const { return kind == ElementKind::edge ? edges.size() : elements.size(); }
};

/// True if the defect visibly affects the deformation.
bool matters(const Finding& finding);
/// Returns a title such as "3 open edges".
std::string title(const Finding& finding);
/// Returns an explanation of one or two sentences.
std::string meaning(const Finding& finding);
/// Returns the first indices, as in "0, 5, 12 and 220 more". An edge is written as "3-7".
std::string first_elements(const Finding& finding, std::size_t most);
std::vector<std::uint32_t> vertices_of(const Finding& finding, const mesh::Surface& surface,
                                       std::size_t element);

/// Check one surface. `summary` must belong to the model. Coincident vertices of the cage are merged first,
/// as in the deformation. `progress` may be null. Throw base::Cancelled. Thread-safe.
std::vector<Finding> check_model(const mesh::Surface& model, const mesh::Summary& summary);
std::vector<Finding> check_cage(const mesh::Surface& cage, base::Progress* progress = nullptr);
/// Returns the model vertices outside the cage; nullopt if the cage encloses all. Ignores face orientations.
std::optional<Finding> check_enclosure(const mesh::Surface& cage, const mesh::Surface& model,
                                       base::Progress* progress = nullptr);

/// Makes all checks. Findings that affect the deformation come first. cage.surface may be null. Thread-safe.
std::vector<Finding> check(const OpenedSurface& model, const OpenedSurface& cage,
                           base::Progress* progress = nullptr);

/// Returns one message per kind of problem in a pose, with its count and first location.
std::vector<std::string> pose_notes(const deform::LogReport& report, const deform::Cage& cage,
                                    const deform::Pose& pose);

/// Returns the end vertices of the edges between torn cage triangles, for the report's first `most` pairs.
std::vector<std::array<std::uint32_t, 2>> torn_edges(const deform::LogReport& report,
                                                     const deform::Cage& cage, std::size_t most);

}  // namespace viete::document
