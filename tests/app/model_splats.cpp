#include <doctest/doctest.h>

#include <cmath>

#include "app/model_layer.h"

using namespace viete;

namespace {

mesh::Splats one_splat(const std::array<float, 4>& rotation, float opacity) {
  mesh::Splats splats;
  splats.log_scales = {{0, std::log(2.0F), std::log(3.0F)}};
  splats.rotations = {rotation};
  splats.opacities = {opacity};
  splats.colors = {{0, 1, -1}};
  return splats;
}

app::ModelSplats converted(mesh::Splats splats) {
  return app::splats_of(std::make_shared<const mesh::Splats>(std::move(splats)));
}

void check_shape(const app::ModelSplats& splats, const render::SplatShape& expected) {
  for (std::size_t i = 0; i < 9; ++i)
    CHECK(splats.shapes.at(0)[i] == doctest::Approx(expected[i]).epsilon(1e-6));
}

}  // namespace

TEST_CASE("shapes_of_splats_are_rotations_times_sizes") {
  check_shape(converted(one_splat({5, 0, 0, 0}, 0)), {1, 0, 0, 0, 2, 0, 0, 0, 3});
  check_shape(converted(one_splat({0, 0, 0, 0}, 0)), {1, 0, 0, 0, 2, 0, 0, 0, 3});
  check_shape(converted(one_splat({2, 0, 0, 2}, 0)),
              {0, -2, 0, 1, 0, 0, 0, 0, 3});  // a quarter turn around z
}

TEST_CASE("opacities_and_colors_of_splats_are_those_of_the_display") {
  CHECK(converted(one_splat({1, 0, 0, 0}, 0)).looks->opacities[0] == 0.5F);
  CHECK(converted(one_splat({1, 0, 0, 0}, 100)).looks->opacities[0] == 1);
  CHECK(converted(one_splat({1, 0, 0, 0}, -100)).looks->opacities[0] < 1e-30F);
  CHECK(std::isnan(converted(one_splat({1, 0, 0, 0}, std::nanf(""))).looks->opacities[0]));
  const auto looks = converted(one_splat({1, 0, 0, 0}, 0)).looks;
  CHECK(looks->colors[0][0] == 0.5F);
  CHECK(looks->colors[0][1] == doctest::Approx(0.5 + 1 / std::sqrt(4 * M_PI)));
  CHECK(looks->colors[0][2] == doctest::Approx(0.5 - 1 / std::sqrt(4 * M_PI)));
}

TEST_CASE("large_captures_are_drawn_in_motion_with_some_of_their_splats") {
  document::OpenedSurface capture;
  mesh::Surface points;
  points.positions.resize(1000);
  capture.surface = std::make_shared<const mesh::Surface>(points);
  auto splats = std::make_shared<mesh::Splats>();
  for (auto* all : {&splats->log_scales, &splats->colors}) all->resize(1000);
  splats->rotations.resize(1000);
  splats->opacities.resize(1000);
  capture.splats = splats;
  CHECK(app::shading_of(capture, 2'000'000).draft_step == 1);
  CHECK_FALSE(app::shading_of(capture, 2'000'000).has_draft());
  CHECK(app::shading_of(capture, 12'000).draft_step == 4);
  CHECK(app::shading_of(capture, 12'000).has_draft());
  CHECK(app::shading_of(capture, 0).draft_step == 1000);
}
