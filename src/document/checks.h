// Finds the defects of a model and its cage, and problems of a pose, with messages for the user.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "document/document.h"
#include "mesh/summary.h"
#include "pose/maps.h"

namespace viete::document {

enum class Defect {
  vertices_outside,   ///< model vertices outside the cage
  self_intersection,  ///< cage faces that intersect other faces
  open,               ///< edges with one face
  nonmanifold_edge,   ///< edges with three or more faces
  pinched_vertex,     ///< vertices at which groups of faces meet without a shared edge
  misoriented,        ///< edges between faces of opposite orientation
  inside_out,         ///< all faces of a closed surface with negative volume
  degenerate,         ///< faces that contain a triangle without area
  thin,               ///< cage faces that contain a triangle thinner than a thousandth of its length
  doubled_vertex,     ///< vertices at the position of another vertex
  unused_vertex,      ///< vertices without a face
  repeated_face,      ///< cage faces with the corners of an earlier face
};

enum class Subject { model, cage };

/// A kind of defect, and the elements with this defect. Indices begin at 0, in file order.
struct Finding {
  Defect defect = Defect::open;
  Subject subject = Subject::model;        ///< the surface that contains the elements
  ElementKind kind = ElementKind::vertex;  ///< vertex, edge or face
  std::vector<std::uint32_t> elements;     ///< sorted vertices or faces; empty if `kind` is edge
  std::vector<mesh::Edge> edges;           ///< sorted edges; empty if `kind` is not edge

  std::size_t size() const { return kind == ElementKind::edge ? edges.size() : elements.size(); }
};

/// True if the defect has a visible effect on the deformation.
bool matters(const Finding& finding);
/// Returns a title such as "3 open edges".
std::string title(const Finding& finding);
/// Returns an explanation of one or two sentences.
std::string meaning(const Finding& finding);
/// Returns the first indices as text, such as "0, 5, 12 and 220 more". Writes an edge as "3-7".
std::string first_elements(const Finding& finding, std::size_t most);
std::vector<std::uint32_t> vertices_of(const Finding& finding, const mesh::Surface& surface,
                                       std::size_t element);

/// Check one surface. `summary` must belong to `model`. As the deformation does, cages are split as in
/// mesh::CenterSplit, and check_cage() merges cage vertices at equal positions first. `progress` may be null.
/// check_cage() throws base::Cancelled. Thread-safe.
std::vector<Finding> check_model(const mesh::Surface& model, const mesh::Summary& summary);
std::vector<Finding> check_cage(const mesh::Surface& cage, base::Progress* progress = nullptr);
/// Finds the model vertices outside the cage. If there are none, returns nullopt. Ignores face orientations.
std::optional<Finding> check_enclosure(const mesh::Surface& cage, const mesh::Surface& model,
                                       base::Progress* progress = nullptr);

/// Makes all checks. Lists findings that affect the deformation first. cage.surface may be null. Thread-safe.
std::vector<Finding> check(const OpenedSurface& model, const OpenedSurface& cage,
                           base::Progress* progress = nullptr);

/// Returns one message per kind of problem in a pose, with the number of places and the first place.
std::vector<std::string> pose_notes(const pose::LogReport& report, const pose::Cage& cage,
                                    const pose::Pose& pose);

/// `report.torn` lists pairs of neighbouring triangles that rotate strongly relative to each other. For the
/// first `most` pairs, returns the common edge of the two triangles, as a pair of vertices.
std::vector<std::array<std::uint32_t, 2>> torn_edges(const pose::LogReport& report, const pose::Cage& cage,
                                                     std::size_t most);

}  // namespace viete::document
