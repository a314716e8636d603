#include <doctest/doctest.h>
#include <glm/gtc/matrix_transform.hpp>

#include "render/view.h"

using namespace viete;

TEST_CASE("eye_matrix_is_exact_far_from_the_origin") {
  render::View view;
  const render::Point origin{4e9, -3e9, 7e9};
  view.view = glm::lookAt(glm::dvec3(origin[0], origin[1], origin[2] + 2),
                          glm::dvec3(origin[0], origin[1], origin[2]), glm::dvec3(0, 1, 0));
  const glm::vec4 seen = render::eye_matrix(view, origin) * glm::vec4(0.5F, 0.25F, 0, 1);
  CHECK(seen.x == doctest::Approx(0.5).epsilon(1e-5));
  CHECK(seen.y == doctest::Approx(0.25).epsilon(1e-5));
  CHECK(seen.z == doctest::Approx(-2).epsilon(1e-5));
}

TEST_CASE("rays_through_pixels_hit_points_drawn_there") {
  render::View view;
  view.size = {640, 360};
  view.projection = glm::frustum(-0.3, 0.5, -0.2, 0.25, 0.4, 50.0);  // off centre
  const glm::dvec3 point(1.3, -0.7, -5);
  const glm::dvec4 clip = view.projection * glm::dvec4(point, 1);
  const glm::dvec2 pixel = (0.5 + 0.5 * glm::dvec2(clip) / clip.w) * glm::dvec2(view.size);
  const glm::vec4 ray = render::eye_ray(view);
  CHECK(ray.x * pixel.x + ray.z == doctest::Approx(point.x / -point.z).epsilon(1e-5));
  CHECK(ray.y * pixel.y + ray.w == doctest::Approx(point.y / -point.z).epsilon(1e-5));
  view.projection = glm::ortho(-2.0, 2.0, -1.0, 1.0, 0.1, 10.0);
  CHECK(render::eye_ray(view) == glm::vec4(0));
}

namespace {

/// Returns the CIE lightness, from 0 to 100, of a colour as displayed.
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
  for (std::size_t i = 1; i < colors.size(); ++i)
    CHECK(lightness(colors[i]) - lightness(colors[i - 1]) == doctest::Approx(step).epsilon(0.25));
}

TEST_CASE("palette_starts_and_ends_with_its_keys") {
  const glm::vec3 first(0.2F, 0.4F, 0.9F), last(0.9F, 0.1F, 0);
  const auto colors = render::blend_palette({first, glm::vec3(0.5F), last}, 11);
  CHECK(render::rgb(0xff8000) == glm::vec3(1, 128.0F / 255.0F, 0));
  CHECK(colors.size() == 11);
  CHECK(glm::length(colors.front() - first) < 2e-3F);
  CHECK(glm::length(colors.back() - last) < 2e-3F);
  CHECK(glm::length(colors[5] - glm::vec3(0.5F)) < 2e-3F);
}
