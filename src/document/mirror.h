// The pairs of mirrored vertices of a symmetric cage. Mirrored edits change both vertices of a pair.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "cages/subject.h"
#include "document/handling.h"
#include "pose/cage.h"

namespace viete::document {

mesh::Point reflected(const cages::Plane& plane, const mesh::Point& p);
mesh::Vec3 reflected_direction(const cages::Plane& plane, const mesh::Vec3& d);

struct Mirror {
  static constexpr std::uint32_t none = 0xFFFFFFFF;

  cages::Plane plane;
  std::vector<std::uint32_t> partners;  ///< one per vertex; a vertex on the plane is its own partner

  std::size_t unpaired() const;
  bool is_on_plane(std::uint32_t v) const { return partners[v] == v; }
  bool is_paired(std::uint32_t v) const { return partners[v] != none && partners[v] != v; }
};

/// Finds the mirror of the cage at rest. Two vertices are partners if each is nearest to the mirror image of
/// the other, within 2 % of the cage's diagonal. For x, y and z, tests the planes at 0 and in the cage's
/// middle, and takes the plane with more pairs. Returns nullopt if `choice`
/// is `none`, or if it is `fit` and no plane is found.
std::optional<Mirror> mirror_of(const pose::Cage& cage, MirrorPlane choice);

/// Returns the corners of a rectangle in the mirror plane, slightly larger than the projection of the points.
std::array<mesh::Point, 4> rectangle_in_plane(const Mirror& mirror, std::span<const mesh::Point> positions);

struct MirrorCache {
  std::shared_ptr<const pose::Cage> cage;
  MirrorPlane choice = MirrorPlane::none;
  std::optional<Mirror> mirror;

  /// If an argument changed, computes the mirror again. The cage may be null.
  void follow(const std::shared_ptr<const pose::Cage>& now, MirrorPlane chosen);
  const Mirror* get() const { return mirror ? &*mirror : nullptr; }
};

/// Returns the vertices and their mirror partners, sorted. If `mirror` is null, adds no partners.
std::vector<std::uint32_t> with_partners(std::vector<std::uint32_t> vertices, const Mirror* mirror);

}  // namespace viete::document
