// About what the selection turns and along which axes it moves: where the gizmo stands, and how.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "scene/document/camera.h"
#include "scene/document/document.h"
#include "scene/document/handling.h"
#include "scene/document/mirror.h"

namespace viete::scene {

/// Lengths in the file's units.
struct Anchor {
  glm::dvec3 center{0, 0, 0};        ///< of the gizmo
  glm::dmat3 axes{1};                ///< columns of length 1, right-handed
  std::vector<glm::dvec3> pivots{};  ///< what vertices turn about; one at least
  /// With several pivots, by the place of a vertex among those that lead: its pivot. Empty with one.
  std::vector<std::uint32_t> pivot_of{};
};

/// The selected vertices that the hand moves itself, ascending: with a mirror those of one side, where their
/// partners are selected too. It is the side of the active element, else that of more of them.
std::vector<std::uint32_t> leading_vertices(const Document& document, const Mirror* mirror);

/// Of the pose as it is; mirror may be null. Requires a selection.
Anchor anchor_of(const Document& document, const Handling& handling, const Mirror* mirror,
                 const Camera& camera);

/// The middle of where the vertices join the largest part of the cage that is not among them; nothing where
/// they do not.
std::optional<glm::dvec3> joint_of(const Document& document, const std::vector<std::uint32_t>& vertices);

/// Columns: their longest extents, the third one across both; nothing of less than two places.
std::optional<glm::dmat3> axes_of_points(std::vector<mesh::Point> points);

}  // namespace viete::scene
