#include "render/mark_layers.h"

#include "base/error.h"
#include "shapes.h"

using namespace viete;
using test::Point;

TEST_CASE("disc_at_a_corner_of_slanted_faces_is_whole") {
  test::Stage stage;
  render::FaceLayer faces(stage.gl);
  faces.set_triangles(std::vector<render::Triangle>{{0, 1, 2}}, 3);
  faces.set_positions(std::vector<Point>{{0, 0, 0}, {6, -4, 10}, {6, 4, 10}});  // rises to the viewer
  render::DiscLayer discs(stage.gl);
  test::set_disc(discs, {0, 0, 0}, {glm::vec4(1), 6, false});
  render::FaceStyle untinted;
  untinted.opacity = untinted.rim = 0;
  const render::Image image = stage.picture([&] {
    faces.draw(stage.view, untinted);
    discs.draw(stage.view, {});
  });
  CHECK(test::lit_area(image) == doctest::Approx(M_PI * 36).epsilon(0.03));
}

TEST_CASE("faces_tint_and_hide_lines_behind_them") {
  test::Stage stage;
  render::FaceLayer faces(stage.gl);
  const std::vector<render::Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
  faces.set_triangles(triangles, 4);
  faces.set_positions(std::vector<Point>{{0, -9, 1}, {15, -9, 1}, {15, 9, 1}, {0, 9, 1}});
  render::LineLayer lines(stage.gl);
  test::set_line(lines, {-12, 0, 0}, {12, 0, 0});
  render::FaceStyle style;
  style.opacity = 0.1F;
  render::LineStyle wide;
  wide.width = 4;
  const auto draw = [&] {
    faces.draw(stage.view, style);
    lines.draw(stage.view, wide);
  };
  const render::Image occluding = stage.picture(draw);
  CHECK(occluding.pixel(220, 50)[0] == doctest::Approx(25.5).epsilon(0.05));
  CHECK(occluding.pixel(100, 50)[0] == 0);
  CHECK(occluding.pixel(220, 100)[0] < 128);
  style.occlude = false;
  CHECK(stage.picture(draw).pixel(220, 100)[0] == 255);
}

TEST_CASE("edges_of_faces_are_not_hidden_by_their_own_faces") {
  test::Stage stage;
  stage.view.projection = glm::perspective(glm::radians(60.0), 1.6, 0.1, 100.0);
  render::FaceLayer faces(stage.gl);
  const std::vector<Point> corners{{-4, -3, 2}, {4, -2, -3}, {0, 4, -1}};
  faces.set_triangles(std::vector<render::Triangle>{{0, 1, 2}}, 3);
  faces.set_positions(corners);
  render::LineLayer lines(stage.gl);
  test::set_line(lines, corners[0], corners[1]);
  render::LineStyle wide;
  wide.width = 3;
  render::FaceStyle untinted;
  untinted.opacity = untinted.rim = 0;
  const render::Image image = stage.picture([&] {
    faces.draw(stage.view, untinted);
    lines.draw(stage.view, wide);
  });
  for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const glm::ivec2 at = stage.pixel_of({-4 + 8 * t, -3 + t, 2 - 5 * t});
    CHECK(image.pixel(at.x, at.y)[0] == 255);
  }
}
