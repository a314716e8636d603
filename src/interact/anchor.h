// The pivot of the selection and its axes: position and orientation of the gizmo.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "document/camera.h"
#include "document/document.h"
#include "document/handling.h"
#include "document/mirror.h"

namespace viete::interact {

/// Lengths in the file's units.
struct Anchor {
  glm::dvec3 center{0, 0, 0};  ///< the gizmo's center, and that of rotation and scale
  glm::dmat3 axes{1};          ///< columns of length 1, right-handed
};

/// The selected vertices that a drag moves directly, ascending. If both mirror partners are selected, it
/// moves the one on the side of the active element or, without one, on the side with more selected vertices.
std::vector<std::uint32_t> leading_vertices(const document::Document& document,
                                            const document::Mirror* mirror);

/// The anchor in the current pose. mirror may be null. Requires a selection.
Anchor anchor_of(const document::Document& document, const document::Handling& handling,
                 const document::Mirror* mirror, const document::Camera& camera);

/// The center of the boundary between the vertices and the largest remaining part of the cage; nullopt if
/// they are not connected.
std::optional<glm::dvec3> joint_of(const document::Document& document,
                                   const std::vector<std::uint32_t>& vertices);

/// The center of the selected element of the cage that was clicked last; nullopt: none.
std::optional<glm::dvec3> center_of_active(const document::Document& document);

}  // namespace viete::interact
