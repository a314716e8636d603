#include "render/view.h"

#include <algorithm>
#include <cmath>
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

Theme theme(bool dark) {
  if (dark)
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

float linear_light(float c) {
  return c <= 0.04045F ? c / 12.92F : std::pow((c + 0.055F) / 1.055F, 2.4F);
}

namespace {

float to_display(float c) {
  c = std::clamp(c, 0.0F, 1.0F);
  return c <= 0.0031308F ? 12.92F * c : 1.055F * std::pow(c, 1 / 2.4F) - 0.055F;
}

// The matrices of Oklab (see blend_palette()). GLM stores columns, so the published rows are transposed.
const glm::mat3 cone_from_rgb = glm::transpose(glm::mat3(0.4122214708F, 0.5363325363F, 0.0514459929F,  //
                                                         0.2119034982F, 0.6806995451F, 0.1073969566F,  //
                                                         0.0883024619F, 0.2817188376F, 0.6299787005F));
const glm::mat3 lab_from_root = glm::transpose(glm::mat3(0.2104542553F, 0.7936177850F, -0.0040720468F,  //
                                                         1.9779984951F, -2.4285922050F, 0.4505937099F,  //
                                                         0.0259040371F, 0.7827717662F, -0.8086757660F));

glm::vec3 to_oklab(const glm::vec3& display) {
  const glm::vec3 linear(linear_light(display.x), linear_light(display.y), linear_light(display.z));
  const glm::vec3 cone = cone_from_rgb * linear;
  return lab_from_root * glm::vec3(std::cbrt(cone.x), std::cbrt(cone.y), std::cbrt(cone.z));
}

glm::vec3 from_oklab(const glm::vec3& lab) {
  const glm::vec3 root = glm::inverse(lab_from_root) * lab;
  const glm::vec3 linear = glm::inverse(cone_from_rgb) * (root * root * root);
  return {to_display(linear.x), to_display(linear.y), to_display(linear.z)};
}

}  // namespace

std::vector<glm::vec3> blend_palette(const std::vector<glm::vec3>& keys, int count) {
  std::vector<glm::vec3> colors;
  for (int i = 0; i < count; ++i) {
    const float at =
        static_cast<float>(i) / static_cast<float>(count - 1) * static_cast<float>(keys.size() - 1);
    const std::size_t key = std::min(static_cast<std::size_t>(at), keys.size() - 2);
    colors.push_back(
        from_oklab(glm::mix(to_oklab(keys[key]), to_oklab(keys[key + 1]), at - static_cast<float>(key))));
  }
  return colors;
}

std::vector<glm::vec3> surface_palette(int count) {
  return blend_palette({rgb(0x2c63ba), rgb(0x6b82ab), rgb(0xa6a096), rgb(0xd6bf67), rgb(0xf9e24f)}, count);
}

std::vector<glm::vec3> diverging_palette(int count) {
  return blend_palette({rgb(0x2457b2), rgb(0x7fa6da), rgb(0xdad7d0), rgb(0xe59a56), rgb(0xb84a0a)}, count);
}

}  // namespace viete::render
