// The vertex pairs of a symmetric cage, for edits that act on both sides.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cages/subject.h"
#include "deform/cage.h"
#include "document/handling.h"

namespace viete::document {

/// The mirror image of a point, and of a direction.
mesh::Point reflected(const cages::Plane& plane, const mesh::Point& p);
mesh::Vec3 reflected_direction(const cages::Plane& plane, const mesh::Vec3& d);

struct Mirror {
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  cages::Plane plane;
  std::vector<std::uint32_t> partners;  ///< one per vertex: itself on the plane, `none` without a partner

  std::size_t unpaired() const;
  bool is_on_plane(std::uint32_t v) const { return partners[v] == v; }
  bool is_paired(std::uint32_t v) const { return partners[v] != none && partners[v] != v; }
};

/// The symmetry of the cage at rest. Partners are mutual nearest neighbours of each other's image, within 2 %
/// of the cage's diagonal. The plane across an axis passes through 0 or the middle of the cage, whichever
/// pairs more vertices. Nullopt if no plane fits or none is chosen. O(n log n).
std::optional<Mirror> mirror_of(const deform::Cage& cage, MirrorPlane choice);

/// The corners of a rectangle in the plane, in order, somewhat larger than the projection of the points.
std::array<mesh::Point, 4> rectangle_in_plane(const Mirror& mirror, std::span<const mesh::Point> positions);

/// Caches the last computed mirror and its inputs.
struct MirrorCache {
  std::shared_ptr<const deform::Cage> cage;
  MirrorPlane choice = MirrorPlane::none;
  std::optional<Mirror> mirror;

  /// Recomputes the mirror only if an input changed. cage may be null.
  void follow(const std::shared_ptr<const deform::Cage>& now, MirrorPlane chosen);
  /// Null if there is no mirror.
  const Mirror* get() const { return mirror ? &*mirror : nullptr; }
};

/// The vertices and their mirror partners, ascending; without a mirror the vertices themselves.
std::vector<std::uint32_t> with_partners(std::vector<std::uint32_t> vertices, const Mirror* mirror);

}  // namespace viete::document
