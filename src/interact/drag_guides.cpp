#include "interact/drag_guides.h"

#include <algorithm>
#include <cmath>

#include "interact/gizmo.h"

namespace viete::interact {

namespace {

using Kind = Constraint::Kind;

bool follows(const TransformDrag& drag, int axis) {
  const Constraint& c = drag.constraint();
  if (drag.tool() == Tool::rotate || c.kind == Kind::free) return false;
  return (c.kind == Kind::axis) == (axis == c.axis);
}

// Returns the arc that the point under the cursor follows during the rotation.
std::vector<glm::vec2> swept(double degrees, const CursorProjection& projection, const glm::dvec3& center,
                             const TransformDrag& drag, const document::Camera& camera,
                             const document::Viewport& viewport) {
  const Transform& t = drag.transform();
  const auto from = projection.angle(t.axis, glm::dvec2(drag.press()));
  if (!from) return {};
  const double radius =
      projection.per_pixel() * (drag.constraint().kind == Kind::free ? gizmo_view_ring : gizmo_radius);
  const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(degrees) / 4)));
  const PlaneAxes across = plane_axes(t.axis);
  std::vector<glm::vec2> arc;
  for (int i = 0; i <= steps; ++i) {
    const double angle = *from + degrees * i / steps * 0.017453292519943295;
    const glm::dvec3 at = center + radius * (std::cos(angle) * across.u + std::sin(angle) * across.v);
    arc.push_back(glm::vec2(CursorProjection(at, camera, viewport).at()));
  }
  return arc;
}

}  // namespace

DragGuides drag_guides(const TransformDrag& drag, const document::Space& space,
                       const document::Camera& camera, const document::Viewport& viewport) {
  const glm::dvec3& pivot = drag.transform().pivot;
  const glm::dvec3 center(space.to_view({pivot.x, pivot.y, pivot.z}));
  const CursorProjection projection(center, camera, viewport);
  DragGuides guides;
  guides.start = glm::vec2(projection.at());
  for (int axis = 0; axis < 3; ++axis) {
    const glm::dvec3& direction = drag.grip().anchor.axes[axis];
    const glm::dvec2 motion = projection.motion(direction);
    if (!follows(drag, axis) || !(glm::length(motion) * projection.per_pixel() > 0.02)) continue;
    guides.axes.push_back(axis);
    guides.axis_directions.push_back(glm::vec2(glm::normalize(motion)));
  }
  if (drag.tool() != Tool::rotate) return guides;
  const double degrees = drag.transform().degrees;
  guides.whole_turns = static_cast<int>(std::min(std::abs(degrees) / 360, 1e6));
  guides.arc = swept(std::fmod(degrees, 360.0), projection, center, drag, camera, viewport);
  if (guides.whole_turns > 0) guides.circle = swept(360, projection, center, drag, camera, viewport);
  return guides;
}

}  // namespace viete::interact
