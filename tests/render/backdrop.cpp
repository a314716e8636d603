#include "render/backdrop.h"
#include "render/surface_layer.h"
#include "support/stage.h"

using namespace viete;

TEST_CASE("grid_lies_behind_the_model_and_fades_out") {
  test::Stage stage;
  stage.view.view = glm::lookAt(glm::dvec3(0, 12, 12), glm::dvec3(0), glm::dvec3(0, 1, 0));
  const render::Grid grid(stage.gl);
  render::GridStyle style;
  style.center = {0, -1, 0};
  style.radius = 9;
  const auto draw_grid = [&] { grid.draw(stage.view, render::theme(true), style); };
  const render::Image alone = stage.picture(draw_grid);
  CHECK(test::count_not_black(alone) > 500);
  CHECK(test::brightness(alone.pixel(2, 2)) == 0);
  CHECK(test::brightness(alone.pixel(318, 198)) == 0);

  const test::Ball ball = test::ball(5, {0, 4, 0});
  render::SurfaceLayer surface(stage.gl);
  surface.set_triangles(ball.triangles, ball.positions.size());
  surface.set_positions(ball.positions, ball.normals);
  const auto draw_model = [&] { surface.draw(stage.view, render::theme(true), {}); };
  const render::Image model = stage.picture(draw_model);
  const render::Image both = stage.picture([&] {
    draw_model();
    draw_grid();
  });
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 320; ++x)
      if (test::brightness(model.pixel(x, y)) > 0) CHECK_EQ(both.pixel(x, y), model.pixel(x, y));
}
