// The camera of a view: orbits, pans, zooms to the cursor, and animates to standard views.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace viete::document {

/// The part of the window that is free of panels, in logical pixels from the top left of the window.
struct Viewport {
  glm::vec2 window{1, 1};  ///< the size of the whole window
  glm::vec2 origin{0, 0};  ///< the top left of the free part
  glm::vec2 size{1, 1};    ///< the size of the free part
  /// In a split view: the top left and the size of this view's pane, as fractions of the free part.
  glm::vec2 pane{0, 0}, pane_size{1, 1};

  friend bool operator==(const Viewport&, const Viewport&) = default;
  glm::vec2 seen() const { return pane_size * size; }
  /// The top left and the bottom right of the pane.
  glm::vec2 low() const { return origin + pane * size; }
  glm::vec2 high() const { return origin + (pane + pane_size) * size; }
  glm::vec2 middle() const { return origin + (pane + 0.5f * pane_size) * size; }
};

enum class StandardView { front, back, right, left, top, bottom, home };

/// The file's up axis. It changes only the view, not the coordinates. In most captures, Y points down.
enum class UpAxis { y, z, minus_y };

/// The pose of a camera. Angles are in radians, lengths in view units (document/space.h). Camera clamps the
/// values to the ranges in document/range.h.
struct CameraPose {
  glm::vec3 target{0, 0, 0};
  float distance = 4;
  float yaw = 0.65f;          ///< about the up axis; at 0, looks along -Z or, if Z is up, along Y
  float pitch = 0.32f;        ///< above the horizon, in [-pi/2, pi/2]
  bool orthographic = false;  ///< if true, no perspective; sizes at the target stay the same
  UpAxis up = UpAxis::y;

  friend bool operator==(const CameraPose&, const CameraPose&) = default;
};

/// A ray in view units. The direction has length 1.
struct Ray {
  glm::dvec3 origin, direction;
};

struct RayHit {
  double distance;               ///< from the ray's origin; negative behind the origin
  std::array<double, 3> shares;  ///< barycentric coordinates
};
/// Intersects the line of the ray with a triangle, from both sides. If they do not meet, returns nullopt.
std::optional<RayHit> hit_triangle(const Ray& ray, const std::array<glm::dvec3, 3>& corners);

class Camera {
public:
  static constexpr float vertical_field = 0.55f;  ///< the vertical field of view, in radians

  Viewport viewport;  ///< the part of the window that the camera fills

  const CameraPose& pose() const { return current_; }
  /// If an animation runs, returns its final pose, otherwise the current pose.
  const CameraPose& destination() const { return moving() ? goal_ : current_; }
  void set_pose(const CameraPose& pose);

  glm::vec3 eye() const;
  glm::vec3 right() const;
  glm::vec3 up() const;
  glm::vec3 forward() const;
  glm::mat4 view() const;
  /// Returns the projection matrix. The target is in the center of the view's pane.
  glm::mat4 projection() const;
  /// Returns the view-space depth of a point, positive in front of the camera.
  float depth(const glm::vec3& point) const;
  /// Returns the number of view units per logical pixel. An orthographic view ignores the depth.
  double per_pixel(double depth) const;
  /// Returns the ray under the cursor. The origin of the ray is in the view plane through the eye.
  Ray ray(const glm::vec2& cursor) const;
  /// Returns the displacement in the view plane that moves a point at this depth by `pixels` (right, down).
  glm::dvec3 plane_displacement(const glm::vec2& pixels, double depth) const;

  void set_orthographic(bool orthographic);
  /// Changes the up axis, but not the yaw and pitch angles.
  void set_up(UpAxis up);
  void orbit(const glm::vec2& pixels);
  void pan(const glm::vec2& pixels);
  /// If `steps` is positive, zooms in. A point under the cursor, at the depth of the target, does not move.
  void zoom(float steps, const glm::vec2& cursor);

  /// Animates the camera to a new target, without a change of direction and distance.
  void center(const glm::vec3& target);
  void look(StandardView view);
  /// Shows all points as large as possible in the view's pane, with a margin. A single point is shown like a
  /// small sphere. Keeps the lowest `covered` logical pixels of the pane free.
  void frame(std::span<const glm::vec3> points, bool eased = true, float covered = 0);
  /// Advances the animation. If no animation runs, returns false.
  bool animate(float seconds);
  bool moving() const { return remaining_ > 0; }

private:
  void ease_to(const CameraPose& goal);
  void jump();

  CameraPose current_, start_, goal_;
  float remaining_ = 0;
};

/// Returns the center of the bounding box of the points. There must be a point.
glm::vec3 center_of(std::span<const glm::vec3> points);

}  // namespace viete::document
