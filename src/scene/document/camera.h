// The camera, perspective or orthographic: orbits a target, pans, zooms to the cursor, eases to standard
// views.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace viete::scene {

/// The part of the window that is not covered by panels, in logical pixels from the top left.
struct Viewport {
  glm::vec2 window{1, 1};  ///< size of the whole window
  glm::vec2 origin{0, 0};  ///< top left of the free part
  glm::vec2 size{1, 1};    ///< size of the free part
  /// The part of that in which the camera's picture stands, where it is split: from its left and top, as
  /// parts of its width and height.
  glm::vec2 pane{0, 0}, pane_size{1, 1};

  friend bool operator==(const Viewport&, const Viewport&) = default;
  glm::vec2 seen() const { return pane_size * size; }
  glm::vec2 middle() const { return origin + (pane + 0.5f * pane_size) * size; }
};

enum class StandardView { front, back, right, left, top, bottom, home };

/// The axis of the file that points up. Files and what is computed of them are as they are, whichever it is.
enum class UpAxis { y, z };

/// Angles in radians; lengths in view units (scene/document/space.h). What a Camera has is always in range
/// (scene/document/range.h), whatever it was told.
struct CameraPose {
  glm::vec3 target{0, 0, 0};
  float distance = 4;
  float yaw = 0.65f;          ///< about the up axis; 0 looks along -Z, or, where Z is up, along Y
  float pitch = 0.32f;        ///< above the horizon, in [-pi/2, pi/2]
  bool orthographic = false;  ///< then `distance` says how large things are: as in perspective at the target
  UpAxis up = UpAxis::y;

  friend bool operator==(const CameraPose&, const CameraPose&) = default;
};

/// Half a line, in view units; the direction has length 1.
struct Ray {
  glm::dvec3 origin, direction;
};

class Camera {
public:
  static constexpr float vertical_field = 0.55f;  ///< radians

  const CameraPose& pose() const { return current_; }
  /// Where an easing that runs will end; the pose if none does.
  const CameraPose& destination() const { return moving() ? goal_ : current_; }
  void set_pose(const CameraPose& pose);

  glm::vec3 eye() const;
  glm::vec3 right() const;
  glm::vec3 up() const;
  glm::vec3 forward() const;
  glm::mat4 view() const;
  /// The target appears in the middle of the free part of the window.
  glm::mat4 projection(const Viewport& viewport) const;
  /// View-space depth of a point, positive in front of the camera.
  float depth(const glm::vec3& point) const;
  /// View units per logical pixel at this depth; the same at every depth if orthographic.
  double per_pixel(double depth, const Viewport& viewport) const;
  /// All points under the cursor. From the eye, or, if orthographic, from the plane through it.
  Ray ray(const glm::vec2& cursor, const Viewport& viewport) const;
  /// The displacement in the view plane at `depth` that moves a point by `pixels` (right, down).
  glm::dvec3 plane_displacement(const glm::vec2& pixels, double depth, const Viewport& viewport) const;

  void set_orthographic(bool orthographic);
  /// At once, under the same angles.
  void set_up(UpAxis up);
  void orbit(const glm::vec2& pixels);
  void pan(const glm::vec2& pixels, const Viewport& viewport);
  /// steps > 0 comes nearer; the point under the cursor at the target's depth stays under it.
  void zoom(float steps, const glm::vec2& cursor, const Viewport& viewport);

  /// Another target, from the same side and as large as before; eased.
  void center(const glm::vec3& target);
  /// Seen from an axis; eased.
  void look(StandardView view);
  /// As near as all points stay in the free part of the window, with a margin; a single point is framed like
  /// a small sphere. The lowest `covered` logical pixels of that part stay empty.
  void frame(std::span<const glm::vec3> points, const Viewport& viewport, bool eased = true,
             float covered = 0);
  /// Moves on by `seconds`; true while something still moves.
  bool animate(float seconds);
  bool moving() const { return remaining_ > 0; }

private:
  void ease_to(const CameraPose& goal);
  void jump();

  CameraPose current_, start_, goal_;
  float remaining_ = 0;
};

}  // namespace viete::scene
