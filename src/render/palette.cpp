#include "render/view.h"

#include <algorithm>
#include <cmath>

namespace viete::render {

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
