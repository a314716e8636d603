// Two parts of a cage that are built alike: which vertex of one is which of the other.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "deform/cage.h"

namespace viete::scene {

/// How one part lies in place of the other at rest: x' = linear (x - from) + to, a rotation, or a reflection,
/// times a scale.
struct PartFit {
  glm::dmat3 linear{1};
  glm::dvec3 from{0, 0, 0}, to{0, 0, 0};
  double miss = 0;  ///< what it leaves between them, root mean square, of the size of the part
};

struct PartMatch {
  std::vector<std::uint32_t> images;  ///< of each vertex of the one part, in its order
  PartFit fit;
};

/// A vertex that is known to be another one.
struct KnownImage {
  std::uint32_t vertex, image;
};

/// By the faces that have all their vertices in a part: they must hang together, take in every vertex of it,
/// and be the same on both sides, or the same as in a mirror, and hang on the rest of the cage by the same
/// vertices. Of several ways it is the one that fits best at rest, with the places where the parts hang, and
/// then the one that turns least. Nothing, and why, if there is none. `known` is kept to. O(n^2) at worst,
/// with n vertices.
std::optional<PartMatch> match_parts(const deform::Cage& cage, std::span<const std::uint32_t> part,
                                     std::span<const std::uint32_t> other, std::optional<KnownImage> known,
                                     std::string& why);

/// Of points in pairs; `mirrored` asks for a reflection.
PartFit fit_of(std::span<const mesh::Point> points, std::span<const mesh::Point> images, bool mirrored);

}  // namespace viete::scene
