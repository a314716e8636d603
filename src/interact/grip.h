// The vertices that a drag moves (the selection, its mirror partners, the soft selection), and their pivot.
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

/// Returns the center of the boundary between the vertices and the largest connected part of the other
/// vertices; nullopt without a boundary.
std::optional<glm::dvec3> joint_of(const document::Document& document,
                                   const std::vector<std::uint32_t>& vertices);

/// Returns the center of the active cage element; nullopt without an active cage element.
std::optional<glm::dvec3> center_of_active(const document::Document& document);

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

}  // namespace viete::interact
