// Picking: visibility, and the vertices, edges and faces under the cursor or inside a rectangle, a lasso or a
// brush.
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

/// A coarse depth buffer, one sample per two logical pixels. A point counts as visible up to half a percent
/// of the model's diagonal behind the nearest surface, so that the cage's own vertices and those slightly
/// inside are visible.
class Sight {
public:
  Sight(const document::Camera& camera, const document::Viewport& viewport);

  /// Draws an occluding triangle; corners as projected by a Projector. O(pixels covered).
  void hide_behind(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);
  /// A projected point with its depth, in logical pixels.
  bool sees(const glm::vec3& at) const;

private:
  // Increases towards the eye; linear on screen.
  float nearness(float depth) const;

  bool orthographic_;
  int columns_, rows_;
  std::vector<float> nearest_;
};

/// A picked element of the cage, and the depth of the picked point in front of the camera, in view units.
struct Pick {
  std::uint32_t index;
  float depth;
};

/// The element of this kind under the cursor, in the pose. Vertices: the nearest within 8 logical
/// pixels; among those within 2 pixels of the nearest, the front one. Edges: likewise, by their nearest
/// point. Faces: the front one; outside of all faces, the one at the nearest edge within that distance.
/// Hidden elements can be picked, as a cage is edited from both sides, unless `sight` is given. Nullopt
/// without a cage.
std::optional<Pick> pick_element(const document::Document& document, document::ElementKind kind,
                                 const document::Camera& camera, const document::Viewport& viewport,
                                 const glm::vec2& cursor, const Sight* sight = nullptr);
/// The same for the selection's kind.
std::optional<Pick> pick_element(const document::Document& document, const document::Camera& camera,
                                 const document::Viewport& viewport, const glm::vec2& cursor,
                                 const Sight* sight = nullptr);
/// True if cage vertices around the cursor are too dense to click between them.
bool is_crowded(const document::Document& document, const document::Camera& camera,
                const document::Viewport& viewport, const glm::vec2& cursor, const Sight* sight = nullptr);

/// The elements of the selection's kind with all vertices inside the rectangle, ascending; with `sight` only
/// those with a visible center.
std::vector<std::uint32_t> pick_elements_in_box(const document::Document& document,
                                                const document::Camera& camera,
                                                const document::Viewport& viewport, const glm::vec2& corner,
                                                const glm::vec2& opposite, const Sight* sight = nullptr);
/// As above, inside the closed polyline.
std::vector<std::uint32_t> pick_elements_in_lasso(const document::Document& document,
                                                  const document::Camera& camera,
                                                  const document::Viewport& viewport,
                                                  std::span<const glm::vec2> line,
                                                  const Sight* sight = nullptr);
/// The elements with their center in the circle, and the one under its center.
std::vector<std::uint32_t> pick_elements_in_circle(const document::Document& document,
                                                   const document::Camera& camera,
                                                   const document::Viewport& viewport,
                                                   const glm::vec2& center, float radius,
                                                   const Sight* sight = nullptr);

enum class SelectShape { box, lasso, brush };

/// The brush is a circle at the cursor.
inline constexpr float least_select_radius = 4, largest_select_radius = 400;  ///< logical pixels

/// In logical pixels; closed from end to start.
struct Lasso {
  std::vector<glm::vec2> line;
  document::SelectMode mode;
};

/// Appends the cursor position if it is visibly far from the last one.
void draw_on(Lasso& lasso, const glm::vec2& to);
/// True if the closed polyline winds around the point; it may intersect itself.
bool encloses(std::span<const glm::vec2> line, const glm::vec2& point);

}  // namespace viete::interact
