// Bending, twisting and tapering what is selected between two ends, and pushing, smoothing, relaxing and
// flattening it: one amount, by which each vertex goes its own way.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "mesh/surface.h"
#include "scene/hand/grip.h"

namespace viete::scene {

class Camera;
struct Document;
/// Of the pose as it is. The end that stays is the pivot, unless that is the median: then the joint with the
/// rest. The other one is the active element, or else the far end of the selection. It bends in the plane of
/// the view. Nothing to be done, Shape::none, where both ends are one.
Shaping shaping_of(const Document& document, Shape shape, const Grip& grip, bool at_median,
                   const Camera& camera);

/// Across the way, as near to this direction as can be, of length 1; nothing where that is along the way.
std::optional<glm::dvec3> hinge_near(const Shaping& shaping, const glm::dvec3& direction);

}  // namespace viete::scene
