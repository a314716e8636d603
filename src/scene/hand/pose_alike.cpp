#include "scene/hand/pose_alike.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scene/document/part_match.h"
#include "scene/hand/mirror_edit.h"
#include "scene/document/vectors.h"

namespace viete::scene {

namespace {

using Numbers = std::vector<std::uint32_t>;

std::vector<mesh::Point> places_of(std::span<const std::uint32_t> vertices,
                                   const std::vector<mesh::Point>& all) {
  std::vector<mesh::Point> places;
  for (const auto v : vertices) places.push_back(all[v]);
  return places;
}

// What is of neither part and within two edges of the one: what is next to it may be a mere line, which does
// not tell how it turns.
Numbers joint_vertices(const deform::Cage& cage, std::span<const std::uint32_t> part,
                       std::span<const std::uint32_t> other) {
  std::vector<std::uint8_t> steps(cage.surface.positions.size(), 3);
  for (const auto v : part) steps[v] = 0;
  for (const std::uint8_t step : std::array<std::uint8_t, 2>{1, 2}) {
    const std::vector<std::uint8_t> before = steps;
    for (const auto& [a, b] : cage.edges) {
      if (before[a] + 1 == step && before[b] > step) steps[b] = step;
      if (before[b] + 1 == step && before[a] > step) steps[a] = step;
    }
  }
  Numbers joint;
  for (std::uint32_t v = 0; v < steps.size(); ++v) {
    const bool near = steps[v] == 1 || steps[v] == 2;
    if (near && !std::ranges::binary_search(other, v)) joint.push_back(v);
  }
  return joint;
}

// Where a part hangs, from rest to the pose: turned and moved. Less than three places have no turn that could
// be told.
PartFit motion_of_joint(const Document& document, std::span<const std::uint32_t> part,
                        std::span<const std::uint32_t> other) {
  const Numbers joint = joint_vertices(*document.cage, part, other);
  if (joint.empty()) return {};
  PartFit fit = fit_of(places_of(joint, document.cage->surface.positions),
                       places_of(joint, document.pose.positions), false);
  const double scale = std::cbrt(glm::determinant(fit.linear));
  fit.linear = joint.size() < 3 || !(scale > 0) ? glm::dmat3(1) : fit.linear / scale;
  return fit;
}

// By the mirror, where the one part is the image of the other.
std::optional<PartMatch> match_by_mirror(const deform::Cage& cage, std::span<const std::uint32_t> part,
                                         std::span<const std::uint32_t> target, const Mirror* mirror) {
  if (!mirror) return std::nullopt;
  PartMatch match;
  for (const auto v : part) match.images.push_back(mirror->partners[v]);
  Numbers sorted = match.images;
  std::ranges::sort(sorted);
  if (!std::ranges::equal(sorted, target)) return std::nullopt;
  const auto& rest = cage.surface.positions;
  match.fit = fit_of(places_of(part, rest), places_of(match.images, rest), true);
  return match;
}

std::optional<KnownImage> known_of(const PosedPart& part, std::span<const std::uint32_t> target,
                                   std::optional<std::uint32_t> active) {
  if (!part.active || !active || !std::ranges::binary_search(target, *active)) return std::nullopt;
  return KnownImage{*part.active, *active};
}

}  // namespace

std::string pose_alike(Document& document, const PosedPart& part, std::span<const std::uint32_t> target,
                       std::optional<std::uint32_t> active, const Mirror* mirror) {
  if (std::ranges::equal(part.vertices, target))
    return "This is the part whose pose was copied; select the one that is to be posed like it.";
  std::string why;
  auto match = match_by_mirror(*document.cage, part.vertices, target, mirror);
  if (!match) match = match_parts(*document.cage, part.vertices, target, known_of(part, target, active), why);
  if (!match) return "This part is not built like the one whose pose was copied: " + why + ".";
  const auto& rest = document.cage->surface.positions;
  const PartFit from = motion_of_joint(document, part.vertices, target),
                to = motion_of_joint(document, target, part.vertices);
  std::vector<mesh::Point> places;
  for (std::size_t i = 0; i < part.vertices.size(); ++i) {
    const glm::dvec3 in_joint =
        glm::transpose(from.linear) * (vector_of(part.positions[i]) - from.to) + from.from;
    const glm::dvec3 moved = match->fit.linear * (in_joint - vector_of(rest[part.vertices[i]]));
    const glm::dvec3 place = to.linear * (vector_of(rest[match->images[i]]) + moved - to.from) + to.to;
    places.push_back({place.x, place.y, place.z});
  }
  paste_pose(document, match->images, places, nullptr);
  return "";
}

}  // namespace viete::scene
