// The pivot of the selection and its axes: position and orientation of the gizmo.
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
  glm::dvec3 center{0, 0, 0};        ///< gizmo center
  glm::dmat3 axes{1};                ///< columns of length 1, right-handed
  std::vector<glm::dvec3> pivots{};  ///< centers of rotation and scale; at least one
  /// With several pivots: the pivot index for each leading vertex, in their order. Otherwise empty.
  std::vector<std::uint32_t> pivot_of{};
};

/// The selected vertices that a drag moves directly, ascending: with a mirror and both sides selected, those
/// of one side, that of the active element or else of the larger part.
std::vector<std::uint32_t> leading_vertices(const Document& document, const Mirror* mirror);

/// In the current pose; mirror may be null. Requires a selection.
Anchor anchor_of(const Document& document, const Handling& handling, const Mirror* mirror,
                 const Camera& camera);

/// The center of the boundary between the vertices and the largest remaining part of the cage; nullopt if
/// they are not connected.
std::optional<glm::dvec3> joint_of(const Document& document, const std::vector<std::uint32_t>& vertices);

/// Principal axes: columns from the longest extent to the shortest; nullopt for fewer than two places.
std::optional<glm::dmat3> axes_of_points(std::vector<mesh::Point> points);

}  // namespace viete::scene
