// How dark the ground is below a surface: from points that are spread over it, without the graphics card.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/view.h"

namespace viete::render {

/// Places spread evenly over triangles as they were at first: few enough to be moved in every frame, whatever
/// the size of the surface, and enough for large triangles.
class SpreadPoints {
public:
  struct Place {
    std::array<std::uint32_t, 3> corners;
    std::array<float, 3> shares;  ///< of the corners; their sum is 1
  };

  SpreadPoints() = default;
  /// Triangles must name vertices that are there.
  SpreadPoints(std::span<const Triangle> triangles, std::span<const Point> positions);

  std::span<const Place> places() const { return places_; }

private:
  std::vector<Place> places_;
};

/// Darkness of cells of the ground, row by row.
struct GroundShadow {
  static constexpr int square = 6;  ///< cells along a side of the squares that are drawn
  int width = 0, height = 0;        ///< in cells, whole squares; 0: there is none
  glm::vec2 low{0, 0};              ///< the corner of the first cell
  float cell = 1;
  std::vector<std::uint8_t> darkness;                 ///< 0 to 255; 0 along the edges
  std::vector<std::array<std::uint32_t, 2>> squares;  ///< columns and rows of those that are not all light
};

/// Of points whose x and y lie on the ground and whose z is the height above it. Dark and sharp where they
/// touch it, wide and faint below what is high; nothing of what is far below it. size: of the surface.
GroundShadow ground_shadow(std::span<const glm::vec3> points, float size);

}  // namespace viete::render
