// The vertices that a drag moves: the selected ones, their mirror partners, and those of the soft selection.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "deform/cage.h"
#include "document/handling.h"
#include "interact/anchor.h"
#include "interact/transform.h"

namespace viete::interact {

/// The falloff at a distance in units of the radius: 1 at 0, 0 from 1 on.
double soft_share(document::SoftCurve curve, double distance);

/// A vertex moved by a drag.
struct Gripped {
  /// Side of the mirror: the dragged side, the other side, or the plane; vertices on the plane stay on it.
  enum class Side { own, other, plane };

  std::uint32_t vertex;
  double share = 1;  ///< share of the motion, in (0, 1]
  Side side = Side::own;
};

/// The selected vertices and those of the soft selection, ascending, with Side::own. `positions`: of the
/// posed cage; `radius` in the file's units. Distances along edges are shortest paths. O(n log n).
std::vector<Gripped> softened(const deform::Cage& cage, std::span<const mesh::Point> positions,
                              std::span<const std::uint32_t> selected, const document::SoftSelection& soft,
                              double radius);

struct Grip {
  Anchor anchor;
  cages::Plane plane;             ///< used if a vertex is not on the own side
  std::vector<Gripped> vertices;  ///< ascending, unique; empty for probes
  Shaping shaping{};              ///< replaces moving, rotating and scaling
};

/// The grip of a drag that starts now. `mirror` may be null. Requires a selection.
Grip grip_of(const document::Document& document, const document::Handling& handling,
             const document::Mirror* mirror, const document::Camera& camera);
/// The vertices with another soft selection, in the current pose.
std::vector<Gripped> gripped(const document::Document& document, const document::SoftSelection& soft,
                             const document::Mirror* mirror);
std::vector<std::uint32_t> vertices_of(const Grip& grip);

/// Transforms the vertices of `from` about the anchor; positions that map to themselves keep their bits.
/// Ignores Transform::pivot. For shaping only Transform::degrees or ::amount is used. to.size() ==
/// from.size().
void apply(const Transform& transform, const Grip& grip, std::span<const mesh::Point> from,
           std::span<mesh::Point> to);

}  // namespace viete::interact
