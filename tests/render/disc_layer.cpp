#include "render/mark_layers.h"

#include "base/error.h"
#include "shapes.h"

using namespace viete;
using test::Point;

TEST_CASE("disc_shows_its_colour_where_its_point_projects") {
  test::Stage stage;
  stage.view.projection = glm::perspective(glm::radians(60.0), 1.6, 0.1, 100.0);
  render::DiscLayer discs(stage.gl);
  const Point at{2.2, 1.1, -3};
  test::set_disc(discs, at, {glm::vec4(0.2F, 0.8F, 1, 1), 5, false});
  const render::Image image = stage.picture([&] { discs.draw(stage.view, {}); });
  const glm::ivec2 middle = stage.pixel_of(at);
  CHECK(image.pixel(middle.x, middle.y) == render::Rgba8{51, 204, 255, 255});
  CHECK(test::brightness(image.pixel(middle.x + 9, middle.y)) == 0);
}

TEST_CASE("disc_covers_a_circle_of_its_radius_at_any_scale") {
  test::Stage stage;
  render::DiscLayer discs(stage.gl);
  test::set_disc(discs, {0.02, 0.03, 0}, {glm::vec4(1), 6, false});
  for (const float scale : {1.0F, 2.0F}) {
    stage.view.scale = scale;
    const double area = test::lit_area(stage.picture([&] { discs.draw(stage.view, {}); }));
    CHECK(area == doctest::Approx(M_PI * 36 * scale * scale).epsilon(0.03));
  }
}

TEST_CASE("ring_is_drawn_around_the_disc_with_a_gap") {
  test::Stage stage;
  render::DiscLayer discs(stage.gl);
  test::set_disc(discs, {0.05, 0.05, 0}, {glm::vec4(1, 0, 0, 1), 5, true});
  render::DiscStyle style;
  style.ring = glm::vec3(0, 1, 0);
  const render::Image image = stage.picture([&] { discs.draw(stage.view, style); });
  int green = 0;
  for (int x = 160; x < 180; ++x) green = std::max<int>(green, image.pixel(x, 100)[1]);
  CHECK(green > 200);
  CHECK(image.pixel(160, 100)[1] == 0);
}

TEST_CASE("hidden_disc_is_fainter_than_a_visible_one") {
  test::Stage stage;
  const test::Wall wall(stage.gl);
  render::DiscLayer discs(stage.gl);
  discs.set_discs(std::vector<render::Disc>(2, render::Disc{glm::vec4(1), 6, false}));
  discs.set_positions(std::vector<Point>{{-5, 0, -2}, {5, 0, -2}});
  const render::Image image = stage.picture([&] {
    wall.draw(stage.view);
    discs.draw(stage.view, {});
  });
  CHECK(image.pixel(110, 100)[0] == 255);
  CHECK(image.pixel(210, 100)[0] > 40);
  CHECK(image.pixel(210, 100)[0] < 128);
}

TEST_CASE("ring_is_as_strong_around_a_hidden_disc") {
  test::Stage stage;
  const test::Wall wall(stage.gl);
  render::DiscLayer discs(stage.gl);
  test::set_disc(discs, {5, 0, -2}, {glm::vec4(1, 0, 0, 1), 6, true});
  render::DiscStyle style;
  style.ring = glm::vec3(0, 1, 0);
  const render::Image image = stage.picture([&] {
    wall.draw(stage.view);
    discs.draw(stage.view, style);
  });
  CHECK(image.pixel(210, 100)[0] < 128);
  int green = 0;
  for (int x = 210; x < 230; ++x) green = std::max<int>(green, image.pixel(x, 100)[1]);
  CHECK(green > 200);
}

TEST_CASE("disc_behind_the_eye_is_not_drawn") {
  test::Stage stage;
  stage.view.projection = glm::perspective(glm::radians(60.0), 1.6, 0.1, 100.0);
  render::DiscLayer discs(stage.gl);
  test::set_disc(discs, {0, 0, 15}, {});
  CHECK(test::count_not_black(stage.picture([&] { discs.draw(stage.view, {}); })) == 0);
}

TEST_CASE("discs_and_positions_must_be_equally_many") {
  test::Stage stage;
  render::DiscLayer discs(stage.gl);
  discs.set_discs(std::vector<render::Disc>(2));
  discs.set_positions(std::vector<Point>(3));
  CHECK_THROWS_AS(discs.draw(stage.view, {}), base::Error);
}
