// Picks the elements under the cursor or inside a rectangle, a lasso or a circle.
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

/// A coarse depth buffer, with one sample per two logical pixels. Points are visible up to half a percent of
/// the model's diagonal behind the nearest surface; otherwise the cage would hide its own elements.
class Sight {
public:
  Sight(const document::Camera& camera, const document::Viewport& viewport);

  /// Draws a triangle that hides elements behind it. The corners are results of a Projector.
  void hide_behind(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
  /// True if the point is visible. `at` is the result of a Projector.
  bool sees(const glm::vec3& at) const;

private:
  float nearness(float depth) const;  // increases towards the eye, linear on screen

  bool orthographic_;
  int columns_, rows_;
  std::vector<float> nearest_;
};

struct Pick {
  std::uint32_t index;
  float depth;  ///< of the picked point in front of the camera, in view units
};

/// Picks the element of this kind nearest to the cursor, within 8 logical pixels. If other elements are at
/// most 2 pixels farther from the cursor, picks the front element. If no face is under the cursor, picks a
/// face at the nearest edge. With `sight`, picks visible elements only.
std::optional<Pick> pick_element(const document::Document& document, document::ElementKind kind,
                                 const document::Camera& camera, const document::Viewport& viewport,
                                 const glm::vec2& cursor, const Sight* sight = nullptr);
/// Picks an element of the selection's kind.
std::optional<Pick> pick_element(const document::Document& document, const document::Camera& camera,
                                 const document::Viewport& viewport, const glm::vec2& cursor,
                                 const Sight* sight = nullptr);
/// True if the cage vertices around the cursor are so dense that the user cannot click between them.
bool is_crowded(const document::Document& document, const document::Camera& camera,
                const document::Viewport& viewport, const glm::vec2& cursor, const Sight* sight = nullptr);

/// Returns the elements of the selection's kind whose vertices are all inside the rectangle, ascending. With
/// `sight`, only elements with a visible center are returned.
std::vector<std::uint32_t> pick_elements_in_box(const document::Document& document,
                                                const document::Camera& camera,
                                                const document::Viewport& viewport, const glm::vec2& corner,
                                                const glm::vec2& opposite, const Sight* sight = nullptr);
/// Returns the elements inside a closed polyline, like pick_elements_in_box().
std::vector<std::uint32_t> pick_elements_in_lasso(const document::Document& document,
                                                  const document::Camera& camera,
                                                  const document::Viewport& viewport,
                                                  std::span<const glm::vec2> line,
                                                  const Sight* sight = nullptr);
/// Returns the elements whose center is in the circle, and the element under the center of the circle.
std::vector<std::uint32_t> pick_elements_in_circle(const document::Document& document,
                                                   const document::Camera& camera,
                                                   const document::Viewport& viewport,
                                                   const glm::vec2& center, float radius,
                                                   const Sight* sight = nullptr);

enum class SelectShape { box, lasso, brush };

/// The radius of the selection brush, in logical pixels.
inline constexpr float least_select_radius = 4, largest_select_radius = 400;

struct Lasso {
  std::vector<glm::vec2> line;  ///< a closed polyline, in logical pixels
  document::SelectMode mode;
};

/// Adds the cursor position if it is at least 2 pixels from the last position.
void draw_on(Lasso& lasso, const glm::vec2& to);
/// True if the closed polyline winds around the point. The polyline may intersect itself.
bool encloses(std::span<const glm::vec2> line, const glm::vec2& point);

}  // namespace viete::interact
