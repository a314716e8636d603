// Bending, twisting and tapering the selection between two ends; smoothing and relaxing it. A single amount
// controls all vertices.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "interact/grip.h"
#include "mesh/surface.h"

namespace viete::document {
class Camera;
struct Document;
}  // namespace viete::document

namespace viete::interact {

/// Shapes the current pose between two ends. The fixed end is the pivot or, for a median pivot, the joint
/// with the rest of the cage; the moving end is the active element, or else the far end of the selection.
/// Bends in the view plane. Returns Shape::none if both ends coincide.
Shaping shaping_of(const document::Document& document, Shape shape, const Grip& grip, bool at_median,
                   const document::Camera& camera);

/// The axis nearest to this direction that is perpendicular to from-to, of length 1; nullopt if parallel.
std::optional<glm::dvec3> hinge_near(const Shaping& shaping, const glm::dvec3& direction);

}  // namespace viete::interact
