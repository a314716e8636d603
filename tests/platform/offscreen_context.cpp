#include "platform/offscreen_context.h"
#include "render/backdrop.h"
#include "render/surface_layer.h"
#include "support/pictures.h"
#include "support/stage.h"

using namespace viete;
using Kind = platform::OffscreenContext::Kind;

namespace {

render::Image ball_picture(Kind kind) {
  test::Stage stage(kind);
  const test::Ball ball = test::ball(7);
  const render::Backdrop backdrop(stage.gl);
  render::SurfaceLayer surface(stage.gl);
  surface.set_triangles(ball.triangles, ball.positions.size());
  surface.set_positions(ball.positions, ball.normals);
  return stage.picture([&] {
    backdrop.draw(render::theme(true));
    surface.draw(stage.view, render::theme(true), {});
  });
}

}  // namespace

TEST_CASE("osmesa_and_egl_give_the_same_picture" * doctest::test_suite(test::if_present)) {
  if (!test::available(Kind::osmesa) || !test::available(Kind::driver)) return;
  const render::Image by_osmesa = ball_picture(Kind::osmesa), by_egl = ball_picture(Kind::driver);
  CHECK(test::count_not_black(by_osmesa) > 0);
  CHECK(test::difference(by_osmesa, by_egl, 2) <= 0.001);
}

TEST_CASE("contexts_can_be_created_repeatedly") {
  for (int i = 0; i < 3; ++i) CHECK(test::count_not_black(ball_picture(Kind::any)) > 10000);
}
