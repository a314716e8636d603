// The vertices that a drag moves (the selection, its mirror partners, the soft selection), their pivot, and
// the ends between which bend, twist and taper act.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "document/camera.h"
#include "document/document.h"
#include "document/handling.h"
#include "document/mirror.h"
#include "interact/transform.h"
#include "pose/cage.h"

namespace viete::interact {

/// The pivot and the axes of the selection, at which the gizmo is drawn.
struct Anchor {
  glm::dvec3 center{0, 0, 0};  ///< the pivot, in file coordinates
  glm::dmat3 axes{1};          ///< columns of length 1, right-handed
};

/// Returns the selected vertices that a drag moves directly, ascending. If both partners of a mirrored pair
/// are selected, returns only the partner on one side: the side of the active element or, without an active
/// element, the side with more selected vertices.
std::vector<std::uint32_t> leading_vertices(const document::Document& document,
                                            const document::Mirror* mirror);

/// Returns the anchor in the current pose. `mirror` may be null. Requires a selection.
Anchor anchor_of(const document::Document& document, const document::Handling& handling,
                 const document::Mirror* mirror, const document::Camera& camera);

/// Returns the falloff, from 1 at distance 0 to 0 at distance 1. The distance is relative to the radius.
double soft_share(document::SoftCurve curve, double distance);

/// A vertex that a drag moves.
struct Gripped {
  /// `own`: the dragged side. `other`: its mirror image. `plane`: the mirror plane, on which vertices stay.
  enum class Side { own, other, plane };

  std::uint32_t vertex;
  double share = 1;  ///< the vertex's fraction of the motion, in (0, 1]
  Side side = Side::own;
};

/// Returns the selected vertices and the vertices of the soft selection, ascending, on Side::own. `positions`
/// are the positions of the posed cage. The radius is in the file's units.
std::vector<Gripped> softened(const pose::Cage& cage, std::span<const mesh::Point> positions,
                              std::span<const std::uint32_t> selected, const document::SoftSelection& soft,
                              double radius);

struct Grip {
  Anchor anchor;
  cages::Plane plane;             ///< the mirror plane
  std::vector<Gripped> vertices;  ///< ascending, without hidden vertices; empty if probes are selected
  Shaping shaping{};              ///< if its shape is not `none`, used instead of move, rotate and scale
};

/// Returns the grip in the current pose. `mirror` may be null. Requires a selection.
Grip grip_of(const document::Document& document, const document::Handling& handling,
             const document::Mirror* mirror, const document::Camera& camera);
/// Returns Grip::vertices, without computing the rest of the grip.
std::vector<Gripped> gripped(const document::Document& document, const document::SoftSelection& soft,
                             const document::Mirror* mirror);
std::vector<std::uint32_t> vertices_of(const Grip& grip);

/// Moves the grip's vertices from their positions in `from`. Does not change other entries of `to`. The
/// center is the grip's anchor, not Transform::pivot. If the grip has a shape, uses only Transform::degrees
/// or Transform::amount. `to` must have the size of `from`.
void move_gripped(const Transform& transform, const Grip& grip, std::span<const mesh::Point> from,
                  std::span<mesh::Point> to);

/// Returns the shaping of the selection in the current pose. Bend, twist and taper have two ends:
/// - the fixed end: the grip's center; if `at_median`, the joint (as for Pivot::joint) or, if none, the far
/// end
/// - the moving end: the active element or, without it, the part of the selection farthest from the fixed end
/// If the ends coincide, returns Shape::none. A bend is in the view plane.
Shaping shaping_of(const document::Document& document, Shape shape, const Grip& grip, bool at_median,
                   const document::Camera& camera);

/// Returns the bending axis nearest to the direction; nullopt if the direction is parallel to `to - from`.
std::optional<glm::dvec3> hinge_near(const Shaping& shaping, const glm::dvec3& direction);

}  // namespace viete::interact
