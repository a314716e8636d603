#include "render/palette.h"

#include <doctest/doctest.h>

#include <cmath>

using namespace viete;

namespace {

/// CIE lightness (0 to 100) of a colour as displayed.
float lightness(const glm::vec3& c) {
  const auto linear = [](float v) {
    return v <= 0.04045F ? v / 12.92F : std::pow((v + 0.055F) / 1.055F, 2.4F);
  };
  const float y = 0.2126F * linear(c.x) + 0.7152F * linear(c.y) + 0.0722F * linear(c.z);
  return y > 0.008856F ? 116 * std::cbrt(y) - 16 : 903.3F * y;
}

}  // namespace

TEST_CASE("surface_palette_rises_in_even_steps_of_lightness_and_starts_light") {
  const auto colors = render::surface_palette(9);
  const float step = (lightness(colors.back()) - lightness(colors.front())) / 8;
  CHECK(step > 5);
  CHECK(lightness(colors.front()) > 35);
  for (std::size_t i = 1; i < colors.size(); ++i) {
    CHECK(lightness(colors[i]) - lightness(colors[i - 1]) == doctest::Approx(step).epsilon(0.25));
  }
}

TEST_CASE("palette_starts_and_ends_with_its_keys") {
  const glm::vec3 first(0.2F, 0.4F, 0.9F), last(0.9F, 0.1F, 0);
  const auto colors = render::blend_palette({first, glm::vec3(0.5F), last}, 11);
  CHECK(colors.size() == 11);
  CHECK(glm::length(colors.front() - first) < 2e-3F);
  CHECK(glm::length(colors.back() - last) < 2e-3F);
  CHECK(glm::length(colors[5] - glm::vec3(0.5F)) < 2e-3F);
}
