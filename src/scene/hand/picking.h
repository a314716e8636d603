// Picking: which of the cage can be seen, and which vertices, edges and faces are under the cursor, or inside
// a rectangle, a lasso or the circle of a brush.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "scene/document/camera.h"
#include "scene/document/document.h"
#include "scene/document/selection.h"
#include "scene/document/space.h"
#include "scene/hand/cursor_projection.h"

namespace viete::scene {

/// Depths of what hides, on a raster of two logical pixels. A place as near as the surface there, or up to
/// half a percent of the model's diagonal behind it, is seen: the cage's own vertices are, and those a little
/// inside.
class Sight {
public:
  Sight(const Camera& camera, const Viewport& viewport);

  /// Corners as a Projector gives them. O(pixels covered).
  void hide_behind(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
  /// Likewise, in logical pixels, with its depth.
  bool sees(const glm::vec3& at) const;

private:
  // Grows towards the eye, and is linear on screen.
  float nearness(float depth) const;

  bool orthographic_;
  int columns_, rows_;
  std::vector<float> nearest_;
};

/// An element of the cage, and how deep in front of the camera the place is at which the cursor met it, in
/// view units.
struct Pick {
  std::uint32_t index;
  float depth;
};

/// The element of the selection's kind under the cursor, in the pose: the vertex nearest to it within 8
/// logical pixels, of vertices within 2 pixels of the nearest the one in front; edges likewise, by their
/// nearest point; of faces the one in front, and outside of all the face at the nearest edge as close. The
/// mesh hides nothing: a cage is edited from outside and from behind; unless `sight` says what is seen.
/// Nothing if there is no cage.
std::optional<Pick> pick_element(const Document& document, const Camera& camera, const Viewport& viewport,
                                 const glm::vec2& cursor, const Sight* sight = nullptr);
/// True if so many vertices of the cage are around the cursor that a hand hardly finds a place between them.
bool is_crowded(const Document& document, const Camera& camera, const Viewport& viewport,
                const glm::vec2& cursor, const Sight* sight = nullptr);

/// The elements of the selection's kind that lie with all their vertices inside the rectangle, ascending;
/// with `sight` those whose middle is seen.
std::vector<std::uint32_t> pick_elements_in_box(const Document& document, const Camera& camera,
                                                const Viewport& viewport, const glm::vec2& corner,
                                                const glm::vec2& opposite, const Sight* sight = nullptr);
/// Likewise inside the closed line.
std::vector<std::uint32_t> pick_elements_in_lasso(const Document& document, const Camera& camera,
                                                  const Viewport& viewport, std::span<const glm::vec2> line,
                                                  const Sight* sight = nullptr);
/// Those whose middle is within the circle, and the one under its centre.
std::vector<std::uint32_t> pick_elements_in_circle(const Document& document, const Camera& camera,
                                                   const Viewport& viewport, const glm::vec2& center,
                                                   float radius, const Sight* sight = nullptr);

enum class SelectShape { box, lasso, brush };

/// The circle of the brush follows the cursor.
inline constexpr float least_select_radius = 4, largest_select_radius = 400;  ///< logical pixels

/// In logical pixels; closed from its end to its start.
struct Lasso {
  std::vector<glm::vec2> line;
  SelectMode mode;
};

/// Takes the next place of the cursor, where it is far enough from the last one to be seen.
void draw_on(Lasso& lasso, const glm::vec2& to);
/// True if the closed line goes round the point, however it crosses itself.
bool encloses(std::span<const glm::vec2> line, const glm::vec2& point);

}  // namespace viete::scene
