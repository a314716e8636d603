// The camera, perspective or orthographic: orbit, pan, zoom to the cursor, animated standard views.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <span>

namespace viete::document {

/// The part of the window that is not covered by panels, in logical pixels from the top left.
struct Viewport {
  glm::vec2 window{1, 1};  ///< size of the whole window
  glm::vec2 origin{0, 0};  ///< top left of the free part
  glm::vec2 size{1, 1};    ///< size of the free part
  /// The view's pane within the free part when it is split: offset from its top left and size, both as
  /// fractions of the free part.
  glm::vec2 pane{0, 0}, pane_size{1, 1};

  friend bool operator==(const Viewport&, const Viewport&) = default;
  glm::vec2 seen() const { return pane_size * size; }
  glm::vec2 middle() const { return origin + (pane + 0.5f * pane_size) * size; }
};

enum class StandardView { front, back, right, left, top, bottom, home };

/// The file's up axis. It only affects the view: files and computed data keep their coordinates.
enum class UpAxis { y, z };

/// Angles in radians; lengths in view units (scene/document/space.h). Camera clamps every value to the ranges
/// of scene/document/range.h.
struct CameraPose {
  glm::vec3 target{0, 0, 0};
  float distance = 4;
  float yaw = 0.65f;          ///< about the up axis; 0 looks along -Z, or along Y if Z is up
  float pitch = 0.32f;        ///< above the horizon, in [-pi/2, pi/2]
  bool orthographic = false;  ///< `distance` then sets the scale: as in perspective at the target's depth
  UpAxis up = UpAxis::y;

  friend bool operator==(const CameraPose&, const CameraPose&) = default;
};

/// Half a line, in view units; the direction has length 1.
struct Ray {
  glm::dvec3 origin, direction;
};

/// The intersection of a ray's line with a triangle, from either side: its distance from the origin, negative
/// behind it, and the barycentric coordinates.
struct RayHit {
  double distance;
  std::array<double, 3> shares;
};
std::optional<RayHit> hit_triangle(const Ray& ray, const std::array<glm::dvec3, 3>& corners);

class Camera {
public:
  static constexpr float vertical_field = 0.55f;  ///< radians

  const CameraPose& pose() const { return current_; }
  /// The pose at the end of a running animation, otherwise the current pose.
  const CameraPose& destination() const { return moving() ? goal_ : current_; }
  void set_pose(const CameraPose& pose);

  glm::vec3 eye() const;
  glm::vec3 right() const;
  glm::vec3 up() const;
  glm::vec3 forward() const;
  glm::mat4 view() const;
  /// The target appears in the center of the free part of the window.
  glm::mat4 projection(const Viewport& viewport) const;
  /// View-space depth of a point, positive in front of the camera.
  float depth(const glm::vec3& point) const;
  /// View units per logical pixel at this depth; the same at every depth if orthographic.
  double per_pixel(double depth, const Viewport& viewport) const;
  /// The ray under the cursor; starts at the eye, or, if orthographic, in the view plane through it.
  Ray ray(const glm::vec2& cursor, const Viewport& viewport) const;
  /// The displacement in the view plane at `depth` that moves a point by `pixels` (right, down).
  glm::dvec3 plane_displacement(const glm::vec2& pixels, double depth, const Viewport& viewport) const;

  void set_orthographic(bool orthographic);
  /// Immediate; keeps the view angles.
  void set_up(UpAxis up);
  void orbit(const glm::vec2& pixels);
  void pan(const glm::vec2& pixels, const Viewport& viewport);
  /// steps > 0 zooms in; the point under the cursor at the target's depth stays under it.
  void zoom(float steps, const glm::vec2& cursor, const Viewport& viewport);

  /// Moves the target; keeps direction and distance; animated.
  void center(const glm::vec3& target);
  /// A view along an axis; animated.
  void look(StandardView view);
  /// Moves as close as possible with all points in the free part of the window, with a margin; a single point
  /// is framed like a small sphere. The lowest `covered` logical pixels of the free part stay empty.
  void frame(std::span<const glm::vec3> points, const Viewport& viewport, bool eased = true,
             float covered = 0);
  /// Advances the animation by `seconds`; true while it is running.
  bool animate(float seconds);
  bool moving() const { return remaining_ > 0; }

private:
  void ease_to(const CameraPose& goal);
  void jump();

  CameraPose current_, start_, goal_;
  float remaining_ = 0;
};

}  // namespace viete::document
