// The pivot and the axes of the selection. The gizmo is drawn there.
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

struct Anchor {
  glm::dvec3 center{0, 0, 0};  ///< the pivot, in file coordinates
  glm::dmat3 axes{1};          ///< columns of length 1, right-handed
};

/// Returns the selected vertices that a drag moves directly, ascending. If both vertices of a mirrored pair
/// are selected, returns only the vertex on one side: the side of the active element or, without an active
/// element, the side with more selected vertices.
std::vector<std::uint32_t> leading_vertices(const document::Document& document,
                                            const document::Mirror* mirror);

/// Returns the anchor in the current pose. `mirror` may be null. Requires a selection.
Anchor anchor_of(const document::Document& document, const document::Handling& handling,
                 const document::Mirror* mirror, const document::Camera& camera);

/// Returns the center of the boundary between these vertices and the largest connected part of the others. If
/// there is no boundary, returns nullopt.
std::optional<glm::dvec3> joint_of(const document::Document& document,
                                   const std::vector<std::uint32_t>& vertices);

/// Returns the center of the active element, or nullopt if no cage element is active.
std::optional<glm::dvec3> center_of_active(const document::Document& document);

}  // namespace viete::interact
