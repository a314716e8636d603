// The vertices that a drag moves: the selection, its mirror partners, and the soft selection.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "document/handling.h"
#include "interact/anchor.h"
#include "interact/transform.h"

namespace viete::interact {

/// Returns the falloff: 1 at distance 0, and 0 at distance 1. The distance is relative to the radius.
double soft_share(document::SoftCurve curve, double distance);

/// A vertex that a drag moves.
struct Gripped {
  /// The dragged side of the mirror, the other side, or the plane. A vertex on the plane stays on the plane.
  enum class Side { own, other, plane };

  std::uint32_t vertex;
  double share = 1;  ///< the vertex's fraction of the motion, in (0, 1]
  Side side = Side::own;
};

/// Returns the selected vertices and the vertices of the soft selection, ascending, on Side::own. `positions`
/// are the positions of the posed cage. The radius is in the file's units.
std::vector<Gripped> softened(const deform::Cage& cage, std::span<const mesh::Point> positions,
                              std::span<const std::uint32_t> selected, const document::SoftSelection& soft,
                              double radius);

struct Grip {
  Anchor anchor;
  cages::Plane plane;             ///< the mirror plane
  std::vector<Gripped> vertices;  ///< ascending and unique; if probes are selected, empty
  Shaping shaping{};              ///< if its shape is not `none`, it replaces move, rotate and scale
};

/// Returns the grip in the current pose. `mirror` may be null. Requires a selection.
Grip grip_of(const document::Document& document, const document::Handling& handling,
             const document::Mirror* mirror, const document::Camera& camera);
/// Returns the vertices of the grip, without its other data.
std::vector<Gripped> gripped(const document::Document& document, const document::SoftSelection& soft,
                             const document::Mirror* mirror);
std::vector<std::uint32_t> vertices_of(const Grip& grip);

/// Moves the grip's vertices from their positions in `from`. The center is the grip's anchor, not
/// Transform::pivot. Copies the positions of other vertices exactly. If the grip has a shape, uses only
/// Transform::degrees or Transform::amount. `to` must have the size of `from`.
void apply(const Transform& transform, const Grip& grip, std::span<const mesh::Point> from,
           std::span<mesh::Point> to);

}  // namespace viete::interact
