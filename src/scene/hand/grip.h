// The vertices that a drag moves: the selected ones, their mirror partners, and those of the soft selection.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "scene/document/handling.h"
#include "scene/hand/anchor.h"
#include "scene/hand/shape.h"
#include "scene/hand/transform.h"

namespace viete::scene {

/// A vertex of the soft selection.
struct Softened {
  std::uint32_t vertex;
  double share;           ///< in (0, 1]; 1: moves like the selection
  std::uint32_t nearest;  ///< index in the list of selected vertices
};

/// The falloff at a distance in units of the radius: 1 at 0, 0 from 1 on.
double soft_share(SoftCurve curve, double distance);

/// The vertices of the soft selection, including the selected ones, ascending. `positions` of the cage in its
/// pose; `radius` in the file's units. Distances along edges are shortest paths. O(n log n).
std::vector<Softened> softened(const deform::Cage& cage, std::span<const mesh::Point> positions,
                               std::span<const std::uint32_t> selected, const SoftSelection& soft,
                               double radius);

/// A vertex moved by a drag.
struct Gripped {
  /// Side of the mirror: the dragged side, the other side, or on the plane, which such vertices never leave.
  enum class Side { own, other, plane };

  std::uint32_t vertex;
  double share = 1;         ///< share of the motion, in (0, 1]
  std::uint32_t pivot = 0;  ///< index in Anchor::pivots; on the other side the pivot is mirrored
  Side side = Side::own;
};

struct Grip {
  Anchor anchor;
  cages::Plane plane;             ///< used if a vertex is not on the own side
  std::vector<Gripped> vertices;  ///< ascending, unique; empty for probes
  Shaping shaping{};              ///< replaces moving, rotating and scaling
};

/// The grip of a drag that starts now. `mirror` may be null. Requires a selection.
Grip grip_of(const Document& document, const Handling& handling, const Mirror* mirror, const Camera& camera);
/// The vertices with another soft selection, at the same anchor, in the current pose.
std::vector<Gripped> gripped(const Document& document, const SoftSelection& soft, const Mirror* mirror,
                             const Anchor& anchor);
std::vector<std::uint32_t> vertices_of(const Grip& grip);

/// Transforms the vertices of `from` about their pivots; positions that map to themselves keep their bits.
/// Ignores Transform::pivot. For shaping only Transform::degrees or ::amount is used. to.size() ==
/// from.size().
void apply(const Transform& transform, const Grip& grip, std::span<const mesh::Point> from,
           std::span<mesh::Point> to);

}  // namespace viete::scene
