// Finds the elements under the cursor, or inside a rectangle, a lasso or a circle.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "document/camera.h"
#include "document/document.h"
#include "document/selection.h"
#include "document/space.h"
#include "interact/cursor_projection.h"

namespace viete::interact {

/// A coarse depth buffer with one sample per 2 x 2 logical pixels. A point is visible if it is at most 0.5 %
/// of the model's diagonal behind the front surface. Without this tolerance, the cage would hide its own
/// elements.
class Sight {
public:
  explicit Sight(const document::Camera& camera);

  /// Draws a triangle that can hide elements. The corners are results of a Projector.
  void hide_behind(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
  /// True if the point is visible. `at` is the result of a Projector.
  bool sees(const glm::vec3& at) const;

private:
  float nearness(float depth) const;  // larger for points nearer to the camera; linear on screen

  bool orthographic_;
  int columns_, rows_;
  std::vector<float> nearest_;
};

struct Pick {
  std::uint32_t index;
  float depth;  ///< the depth of the picked point from the camera, in view units
};

/// Picks the element of this kind nearest to the cursor, within 8 logical pixels. If several distances differ
/// by at most 2 pixels, picks the element nearest to the camera. If no face is under the cursor, picks a face
/// at the nearest edge. Ignores hidden elements and, if `sight` is given, elements behind surfaces.
std::optional<Pick> pick_element(const document::Document& document, document::ElementKind kind,
                                 const document::Camera& camera, const glm::vec2& cursor,
                                 const Sight* sight = nullptr);
/// Picks an element of the selection's kind.
std::optional<Pick> pick_element(const document::Document& document, const document::Camera& camera,
                                 const glm::vec2& cursor, const Sight* sight = nullptr);
/// True if the cage vertices around the cursor are so close together that the user cannot click between them.
bool is_crowded(const document::Document& document, const document::Camera& camera, const glm::vec2& cursor,
                const Sight* sight = nullptr);

/// Returns the elements of the selected kind that have all vertices inside the rectangle, ascending. If
/// `sight` is given, returns only elements with a visible center.
std::vector<std::uint32_t> pick_elements_in_box(const document::Document& document,
                                                const document::Camera& camera, const glm::vec2& corner,
                                                const glm::vec2& opposite, const Sight* sight = nullptr);
/// Returns the elements inside a closed polyline, like pick_elements_in_box().
std::vector<std::uint32_t> pick_elements_in_lasso(const document::Document& document,
                                                  const document::Camera& camera,
                                                  std::span<const glm::vec2> line,
                                                  const Sight* sight = nullptr);
/// Returns the elements with their center in the circle, and the element under the circle's center.
std::vector<std::uint32_t> pick_elements_in_circle(const document::Document& document,
                                                   const document::Camera& camera, const glm::vec2& center,
                                                   float radius, const Sight* sight = nullptr);

enum class SelectShape { box, lasso, brush };

/// The limits of the selection brush's radius, in logical pixels.
inline constexpr float least_select_radius = 4, largest_select_radius = 400;

struct Lasso {
  std::vector<glm::vec2> line;  ///< a closed polyline, in logical pixels
  document::SelectMode mode;
};

/// Adds the cursor position unless it is nearer than 2 pixels to the last position.
void draw_on(Lasso& lasso, const glm::vec2& to);
/// True if the closed polyline winds around the point. The polyline may cross itself.
bool encloses(std::span<const glm::vec2> line, const glm::vec2& point);

}  // namespace viete::interact
