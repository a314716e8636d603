// Defects of a model and its cage, element by element, and what each means for the deformation; and what the
// deformer had to decide in a pose, in words.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/progress.h"
#include "deform/maps.h"
#include "mesh/summary.h"
#include "scene/document/document.h"

namespace viete::scene {

/// In the order of the checks.
enum class Defect {
  vertices_outside,   ///< of the cage: model vertices
  self_intersection,  ///< faces
  open,               ///< edges with one face
  nonmanifold_edge,   ///< edges with three or more faces
  pinched_vertex,     ///< vertices where fans of faces only touch
  misoriented,        ///< edges whose faces run in opposite directions
  inside_out,         ///< all faces of a closed surface of negative volume
  degenerate,         ///< faces with a triangle without area
  thin,               ///< of the cage: faces with a triangle thinner than a thousandth of its length
  doubled_vertex,     ///< vertices at the place of another one
  unused_vertex,      ///< vertices without a face
};

enum class Subject { model, cage };

/// One kind of defect and all elements that have it, by their numbers in the file's order, from 0.
struct Finding {
  Defect defect = Defect::open;
  Subject subject = Subject::model;        ///< whose elements they are
  ElementKind kind = ElementKind::vertex;  ///< what they are: an edge is two vertices, a face a polygon
  std::vector<std::uint32_t> elements;     ///< vertices or faces, ascending
  std::vector<mesh::Edge> edges;           ///< or edges, ascending
  bool turned = false;                     ///< of vertices outside: the cage fits clearly better when turned

  std::size_t size() const { return kind == ElementKind::edge ? edges.size() : elements.size(); }
};

/// True where the deformation is not what one expects; else it is good to know.
bool matters(const Finding& finding);
/// "3 open edges", with thousands apart.
std::string title(const Finding& finding);
/// One or two plain sentences.
std::string meaning(const Finding& finding);
/// The first elements by number: "0, 5, 12 and 220 more", edges as "3-7".
std::string first_elements(const Finding& finding, std::size_t most);
/// Vertices of one element.
std::vector<std::uint32_t> vertices_of(const Finding& finding, const mesh::Surface& surface,
                                       std::size_t element);

/// The summary is the model's. A cage is judged with vertices at one place joined, as
/// the deformation takes it. progress may be null. Throws base::Cancelled. Thread-safe.
std::vector<Finding> check_model(const mesh::Surface& model, const mesh::Summary& summary);
std::vector<Finding> check_cage(const mesh::Surface& cage, base::Progress* progress = nullptr);
/// Whether the cage encloses the model, whichever way its faces point: one finding or none.
std::optional<Finding> check_enclosure(const mesh::Surface& cage, const mesh::Surface& model,
                                       base::Progress* progress = nullptr);

/// All of them, those that matter first; cage.surface may be null. Thread-safe.
std::vector<Finding> check(const OpenedSurface& model, const OpenedSurface& cage,
                           base::Progress* progress = nullptr);

/// One line per kind of trouble, with how often and the first place; nothing for a pose without trouble. A
/// closed cage that is turned inside out, as by a mirror, is told from one that is only torn.
std::vector<std::string> pose_notes(const deform::LogReport& report, const deform::Cage& cage,
                                    const deform::Pose& pose);

/// The vertices at both ends of the cage's edges between torn neighbours, at most so many; nothing where
/// elements are neither triangles nor vertices.
std::vector<std::array<std::uint32_t, 2>> torn_edges(const deform::LogReport& report,
                                                     const deform::Cage& cage, std::size_t most);

}  // namespace viete::scene
