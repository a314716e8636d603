#include "weights/binding.h"

#include "pose/cage_state.h"
#include "pose/maps.h"

namespace viete::weights {

std::vector<Vec3> displacements_of(const SharedShape& shape, std::span<const mesh::Point> rest) {
  std::vector<Vec3> displacements;
  if (!shape) return displacements;
  displacements.reserve(rest.size());
  for (std::size_t v = 0; v < rest.size(); ++v) displacements.push_back((*shape)[v] - rest[v]);
  return displacements;
}

Shares product(Shares shares, std::span<const float> mask) {
  if (mask.empty()) return shares;
  if (shares.empty()) return {mask.begin(), mask.end()};
  for (std::size_t i = 0; i < shares.size(); ++i) shares[i] *= static_cast<double>(mask[i]);
  return shares;
}

base::MemoryNeed binding_memory(double bytes, std::size_t vertices, std::size_t handles) {
  return {bytes,
          "binding " + std::to_string(vertices) + " vertices to " + std::to_string(handles) +
              " cage elements takes",
          "use a coarser cage or a coarser model", ""};
}

namespace {

// Returns the number of cage faces that mesh::one_sided() flipped or removed.
std::size_t seen_otherwise(const pose::Cage& cage) {
  const auto& [triangles, of, closed] = cage.sides;
  std::vector<std::uint8_t> differs(cage.surface.polygon_count(), 0);
  for (const auto polygon : cage.elements.triangle_polygon) differs[polygon] = 1;
  for (std::size_t i = 0; i < of.size(); ++i)
    if (triangles[i] == cage.elements.triangles[of[i]]) differs[cage.polygon_of(of[i])] = 0;
  return static_cast<std::size_t>(std::ranges::count(differs, 1));
}

}  // namespace

std::vector<std::string> weight_warnings(const pose::Cage& cage, pose::Weights weights, std::size_t failed,
                                         std::size_t vertices) {
  std::vector<std::string> warnings;
  if (weights != pose::Weights::mean_value) return warnings;
  if (!cage.sides.closed) {
    warnings.push_back(
        "the cage is open; with mean value coordinates, the model follows the cage's rotation and stretch "
        "only approximately");
  }
  if (const std::size_t other = seen_otherwise(cage); other > 0) {
    warnings.push_back(std::to_string(other) + " of " + std::to_string(cage.surface.polygon_count()) +
                       " cage faces are flipped or ignored for mean value coordinates, so that all faces "
                       "point outwards");
  }
  if (failed > 0) {
    warnings.push_back(std::to_string(failed) + " of " + std::to_string(vertices) +
                       " vertices have no mean value coordinates; they follow the closest point of the cage");
  }
  return warnings;
}

}  // namespace viete::weights
