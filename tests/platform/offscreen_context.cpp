#include <cstdlib>
#include <string>

#include "platform/offscreen_context.h"
#include "render/backdrop.h"
#include "render/surface_layer.h"
#include "support/pictures.h"
#include "support/stage.h"

using namespace viete;
using Kind = platform::OffscreenContext::Kind;

namespace {

render::Image ball_picture(test::Stage& stage) {
  const test::Ball ball = test::ball(7);
  const render::Backdrop backdrop(stage.gl);
  render::SurfaceLayer surface(stage.gl);
  surface.set_triangles(ball.triangles, ball.positions.size());
  surface.set_positions(ball.positions, ball.normals);
  return stage.picture([&] {
    backdrop.draw(render::dark_theme());
    surface.draw(stage.view, render::dark_theme(), {});
  });
}

}  // namespace

TEST_CASE("osmesa_and_egl_give_the_same_picture" * doctest::test_suite(test::if_present)) {
  if (!test::available(Kind::osmesa) || !test::available(Kind::egl)) return;
  render::Image by_osmesa, by_egl;
  {
    test::Stage stage(Kind::osmesa);
    by_osmesa = ball_picture(stage);
  }
  {
    test::Stage stage(Kind::egl);
    by_egl = ball_picture(stage);
  }
  CHECK(test::count_not_black(by_osmesa) > 0);
  CHECK(test::difference(by_osmesa, by_egl, 2) <= 0.001);
}

TEST_CASE("contexts_can_be_created_repeatedly") {
  for (int i = 0; i < 3; ++i) {
    test::Stage stage;
    CHECK(test::count_not_black(ball_picture(stage)) > 10000);
  }
}

TEST_CASE("environment_is_as_before_after_making_a_context" * doctest::test_suite(test::if_present)) {
  if (!test::available(Kind::egl)) return;
  setenv("LIBGL_ALWAYS_SOFTWARE", "0", 1);
  const auto context = platform::OffscreenContext::create(Kind::egl);
  CHECK(std::string(std::getenv("LIBGL_ALWAYS_SOFTWARE")) == "0");
  unsetenv("LIBGL_ALWAYS_SOFTWARE");
}
