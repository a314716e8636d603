// Which vertex of a cage is the image of which: how edits act on both of its sides.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cages/subject.h"
#include "deform/cage.h"
#include "scene/document/handling.h"

namespace viete::scene {

/// The image of a point, and of a direction.
mesh::Point reflected(const cages::Plane& plane, const mesh::Point& p);
mesh::Vec3 reflected_direction(const cages::Plane& plane, const mesh::Vec3& d);

struct Mirror {
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  cages::Plane plane;
  std::vector<std::uint32_t> partners;  ///< of each vertex: itself on the plane, none where there is no image

  std::size_t unpaired() const;
  bool is_on_plane(std::uint32_t v) const { return partners[v] == v; }
  bool is_paired(std::uint32_t v) const { return partners[v] != none && partners[v] != v; }
};

/// Of the cage at rest. A vertex's partner is nearest to its image, no farther than 2 % of the cage's
/// diagonal, and the other way round. Across an axis the plane goes where it pairs most: through 0, or the
/// middle of the cage. Nothing where no plane fits, or none is chosen. O(n log n).
std::optional<Mirror> mirror_of(const deform::Cage& cage, MirrorPlane choice);

/// The corners of a rectangle in the plane, in order around it, somewhat larger than what the points cover
/// there.
std::array<mesh::Point, 4> rectangle_in_plane(const Mirror& mirror, std::span<const mesh::Point> positions);

/// The last one that was made, and of what.
struct KnownMirror {
  std::shared_ptr<const deform::Cage> cage;
  MirrorPlane choice = MirrorPlane::none;
  std::optional<Mirror> mirror;

  /// Made anew only where something has changed. cage may be null.
  void follow(const std::shared_ptr<const deform::Cage>& now, MirrorPlane chosen);
  /// Null where there is none.
  const Mirror* get() const { return mirror ? &*mirror : nullptr; }
};

/// With its partners on the other side; ascending. Without a mirror the vertices themselves.
std::vector<std::uint32_t> with_partners(std::vector<std::uint32_t> vertices, const Mirror* mirror);

}  // namespace viete::scene
