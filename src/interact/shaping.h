// Bends, twists and tapers the selection between two ends. Smooths and relaxes the selection.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "interact/grip.h"

namespace viete::interact {

/// Returns the shaping of the selection in the current pose. Bend, twist and taper have two ends:
/// - the fixed end: the grip's center; if `at_median`, the joint (see joint_of()) or, if none, the far end
/// - the moving end: the active element or, without it, the part of the selection farthest from the fixed end
/// If the ends coincide, returns Shape::none. A bend is in the view plane.
Shaping shaping_of(const document::Document& document, Shape shape, const Grip& grip, bool at_median,
                   const document::Camera& camera);

/// Returns the bending axis nearest to the direction; nullopt if the direction is parallel to `to - from`.
std::optional<glm::dvec3> hinge_near(const Shaping& shaping, const glm::dvec3& direction);

}  // namespace viete::interact
