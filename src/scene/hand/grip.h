// What moves with the hand: the selected vertices, their images on the other side of a mirror, and what goes
// along softly.
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

/// A vertex near selected ones.
struct Softened {
  std::uint32_t vertex;
  double share;           ///< in (0, 1]; 1: as far as the selected ones
  std::uint32_t nearest;  ///< which of the selected ones it goes with, a place in their list
};

/// The share at a distance in units of the radius: 1 at 0, 0 from 1 on.
double soft_share(SoftCurve curve, double distance);

/// What goes along with the selected vertices, which are among it, in ascending order. `positions` of the
/// cage in its pose; `radius` in the file's units. Distances over edges are shortest paths. O(n log n).
std::vector<Softened> softened(const deform::Cage& cage, std::span<const mesh::Point> positions,
                               std::span<const std::uint32_t> selected, const SoftSelection& soft,
                               double radius);

/// A vertex that moves.
struct Gripped {
  /// Of the mirror: the hand's own, the other one, or on the plane, which such a vertex does not leave.
  enum class Side { own, other, plane };

  std::uint32_t vertex;
  double share = 1;         ///< of the motion, in (0, 1]
  std::uint32_t pivot = 0;  ///< of Anchor::pivots; of the other side its image
  Side side = Side::own;
};

struct Grip {
  Anchor anchor;
  cages::Plane plane;             ///< of use where a vertex is not on the own side
  std::vector<Gripped> vertices;  ///< ascending, each once; none of probes
  Shaping shaping{};              ///< instead of moving, turning and scaling
};

/// What a hand that is at it holds. `mirror` may be null. Requires a selection.
Grip grip_of(const Document& document, const Handling& handling, const Mirror* mirror, const Camera& camera);
/// The same anchor with other shares, from the pose as it is.
std::vector<Gripped> gripped(const Document& document, const SoftSelection& soft, const Mirror* mirror,
                             const Anchor& anchor);
std::vector<std::uint32_t> vertices_of(const Grip& grip);

/// The vertices of `from` transformed about their pivots; whatever maps to itself keeps its bits.
/// Transform::pivot is not looked at. Of a grip that shapes only Transform::degrees or ::amount count.
/// to.size() == from.size().
void apply(const Transform& transform, const Grip& grip, std::span<const mesh::Point> from,
           std::span<mesh::Point> to);

}  // namespace viete::scene
