// Between points of the scene and pixels of the window: from points of the file to pixels, and from the
// cursor to a length along an axis, an angle about one, a place in a plane.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>

#include "scene/document/camera.h"
#include "scene/document/space.h"

namespace viete::scene {

/// Maps points of the file to logical pixels from the top left of the window.
class Projector {
public:
  Projector(const Space& space, const Camera& camera, const Viewport& viewport);

  /// x, y in logical pixels, z the depth in front of the camera; nothing for points behind it.
  std::optional<glm::vec3> operator()(const mesh::Point& p) const;
  /// The part of the segment that is in front of the near plane, both ends like that; nothing if none is.
  std::optional<std::array<glm::vec3, 2>> segment(const mesh::Point& a, const mesh::Point& b) const;

private:
  glm::vec4 clip(const mesh::Point& p) const;
  glm::vec3 on_screen(const glm::vec4& clip) const;

  Space space_;
  glm::mat4 view_, projection_, to_depth_;
  glm::vec2 window_;
};

/// A point as the camera sees it, and cursors projected to axes and planes through it. Points, axes and
/// lengths in view units, cursors in logical pixels.
class CursorProjection {
public:
  CursorProjection(const glm::dvec3& point, const Camera& camera, const Viewport& viewport);

  bool in_front() const { return in_front_; }
  glm::dvec2 at() const { return at_; }
  /// View units per logical pixel at the point.
  double per_pixel() const { return per_pixel_; }
  /// From the point to the eye, of length 1.
  glm::dvec3 to_eye() const { return to_eye_; }

  /// How the point moves on screen, in pixels per view unit, when it sets out in this direction.
  glm::dvec2 motion(const glm::dvec3& direction) const;

  /// Where on the axis through the point the cursor points, as a length from the point; exact in perspective
  /// too. 0 if the axis points at the eye; towards the vanishing point no more than 20 times what an
  /// orthographic view would give.
  double along(const glm::dvec3& axis, const glm::dvec2& cursor) const;

  /// The angle at which the cursor stands about the axis through the point, radians in (-pi, pi], from an
  /// arbitrary zero. Nothing where the ring around the axis is seen edge-on.
  std::optional<double> angle(const glm::dvec3& axis, const glm::dvec2& cursor) const;

  /// For a ring of this radius (pixels) that is seen edge-on: the angle by which its near side follows the
  /// cursor's movement.
  double edge_on_angle(const glm::dvec3& axis, const glm::dvec2& pixels, double radius) const;

  /// Where the ray meets the plane through the point; nothing where it hardly does: seen edge-on, or beyond
  /// its horizon.
  std::optional<glm::dvec3> in_plane(const glm::dvec3& normal, const Ray& ray) const;

private:
  glm::dvec3 point_, right_, up_, forward_, to_eye_;
  glm::dvec2 at_, slope_;  // slope: of the ray through the point, 0 if orthographic
  double depth_, per_pixel_;
  bool orthographic_, in_front_;
};

/// Two axes of the plane across an axis of length 1: cross(u, v) == axis.
struct PlaneAxes {
  glm::dvec3 u, v;
};
PlaneAxes plane_axes(const glm::dvec3& axis);

}  // namespace viete::scene
