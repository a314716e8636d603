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
  glm::dvec3 center{0, 0, 0};  ///< the gizmo's center, and that of rotation and scale
  glm::dmat3 axes{1};          ///< columns of length 1, right-handed
};

/// The selected vertices that a drag moves directly, ascending. If both mirror partners are selected, it
/// moves the one on the side of the active element or, without one, on the side with more selected vertices.
std::vector<std::uint32_t> leading_vertices(const Document& document, const Mirror* mirror);

/// The anchor in the current pose. mirror may be null. Requires a selection.
Anchor anchor_of(const Document& document, const Handling& handling, const Mirror* mirror,
                 const Camera& camera);

/// The center of the boundary between the vertices and the largest remaining part of the cage; nullopt if
/// they are not connected.
std::optional<glm::dvec3> joint_of(const Document& document, const std::vector<std::uint32_t>& vertices);

/// The center of the selected element of the cage that was clicked last; nullopt: none.
std::optional<glm::dvec3> center_of_active(const Document& document);

}  // namespace viete::scene
