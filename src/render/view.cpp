#include "render/view.h"

#include <glm/gtc/matrix_transform.hpp>

namespace viete::render {

glm::mat4 eye_matrix(const View& view, const Point& origin) {
  return glm::mat4(glm::translate(view.view, glm::dvec3(origin[0], origin[1], origin[2])));
}

// In perspective, a pixel's ray (x, y, -1) satisfies 2 * pixel.x / size.x - 1 = p[0][0] * x - p[2][0]. This
// gives x. The same equation with p[1][1] and p[2][1] gives y.
glm::vec4 eye_ray(const View& view) {
  const glm::dmat4& p = view.projection;
  if (p[3][3] != 0) return glm::vec4(0);
  const glm::dvec2 slope(p[0][0], p[1][1]), shift(p[2][0], p[2][1]);
  return glm::vec4(glm::dvec4(2.0 / (glm::dvec2(view.size) * slope), (shift - 1.0) / slope));
}

Theme dark_theme() {
  return {
      .background_top = rgb(0x262b33),
      .background_bottom = rgb(0x15181d),
      .grid = rgb(0x8a97a8),
      .model = rgb(0xd2bfa8),
      .held = rgb(0x4a6d9e),
      .wire = rgb(0x2a2622),
      .cage = rgb(0x3fb8af),
      .selection = rgb(0xffb224),
      .hover = rgb(0xffffff),
      .finding = rgb(0xff5c8a),
      .outline = rgb(0x101317),
      .halo = {rgb(0x101317), 0.5F},
      .shadow = {rgb(0x020305), 1.0F},
      .exposure = 1.0F,
  };
}

Theme light_theme() {
  return {
      .background_top = rgb(0xf4f5f7),
      .background_bottom = rgb(0xdfe3e8),
      .grid = rgb(0x7b8796),
      .model = rgb(0xd4c5b0),
      .held = rgb(0x5b7fb5),
      .wire = rgb(0x2a2622),
      .cage = rgb(0x12857d),
      .selection = rgb(0xf59a00),
      .hover = rgb(0x1d2733),
      .finding = rgb(0xc4124f),
      .outline = rgb(0x1d2733),
      .halo = {rgb(0xffffff), 0.45F},
      .shadow = {rgb(0x2c3646), 0.62F},
      .exposure = 1.15F,
  };
}

}  // namespace viete::render
