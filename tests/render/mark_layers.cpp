#include "render/mark_layers.h"

#include "render/surface_layer.h"
#include "support/stage.h"

using namespace viete;
using test::Point;

namespace {

const glm::dmat4 perspective = glm::perspective(glm::radians(60.0), 1.6, 0.1, 100.0);

// Returns the largest value of a channel in 20 pixels: `from`, from + step, from + 2 * step and so on.
int brightest(const render::Image& image, glm::ivec2 from, glm::ivec2 step, int channel) {
  int most = 0;
  for (int i = 0; i < 20; ++i, from += step) most = std::max<int>(most, image.pixel(from.x, from.y)[channel]);
  return most;
}

/// A black wall at x >= 0 and z = 1. It hides what is behind it, and is itself as black as the background.
struct Wall {
  explicit Wall(const render::Gl& gl) : surface(gl) {
    const std::vector<Point> corners{{0, -9, 1}, {15, -9, 1}, {15, 9, 1}, {0, 9, 1}};
    const std::vector<render::Triangle> triangles{{0, 1, 2}, {0, 2, 3}};
    surface.set_triangles(triangles, 4);
    surface.set_positions(corners, std::vector<base::PackedNormal>(4));
  }
  void draw(const render::View& view) const {
    render::Theme black = render::theme(true);
    black.exposure = 0;
    surface.draw(view, black, {});
  }
  render::SurfaceLayer surface;
};

void set_line(render::LineLayer& lines, const Point& a, const Point& b,
              const glm::vec4& color = glm::vec4(1)) {
  lines.set_segments(std::vector<render::Segment>{{0, 1}}, 2);
  lines.set_positions(std::vector<Point>{a, b});
  lines.set_color(color);
}

void set_disc(render::DiscLayer& discs, const Point& at, const render::Disc& disc) {
  discs.set_discs(std::vector<render::Disc>{disc});
  discs.set_positions(std::vector<Point>{at});
}

struct Marks : test::Stage {
  render::DiscLayer discs{gl};
  render::LineLayer lines{gl};
  render::FaceLayer faces{gl};
};

}  // namespace

TEST_CASE("disc_shows_its_colour_where_its_point_projects") {
  Marks stage;
  stage.view.projection = perspective;
  const Point at{2.2, 1.1, -3};
  set_disc(stage.discs, at, {glm::vec4(0.2F, 0.8F, 1, 1), 5, false});
  const render::Image image = stage.picture([&] { stage.discs.draw(stage.view, {}); });
  const glm::ivec2 middle = stage.pixel_of(at);
  CHECK(image.pixel(middle.x, middle.y) == render::Rgba8{51, 204, 255, 255});
  CHECK(test::brightness(image.pixel(middle.x + 9, middle.y)) == 0);
}

TEST_CASE("disc_covers_a_circle_of_its_radius_at_any_scale") {
  Marks stage;
  set_disc(stage.discs, {0.02, 0.03, 0}, {glm::vec4(1), 6, false});
  for (const float scale : {1.0F, 2.0F}) {
    stage.view.scale = scale;
    const double area = test::lit_area(stage.picture([&] { stage.discs.draw(stage.view, {}); }));
    CHECK(area == doctest::Approx(M_PI * 36 * scale * scale).epsilon(0.03));
  }
}

TEST_CASE("ring_is_around_the_disc_with_a_gap_and_as_strong_if_the_disc_is_hidden") {
  Marks stage;
  const Wall wall(stage.gl);
  const render::DiscStyle style{.ring = glm::vec3(0, 1, 0)};
  for (const int x : {-5, 5}) {
    set_disc(stage.discs, {double(x), 0, -2}, {glm::vec4(1, 0, 0, 1), 6, true});
    const render::Image image = stage.picture([&] {
      wall.draw(stage.view);
      stage.discs.draw(stage.view, style);
    });
    const int middle = 160 + 10 * x;
    CHECK((image.pixel(middle, 100)[0] < 128) == (x > 0));
    CHECK(image.pixel(middle, 100)[1] == 0);
    CHECK(brightest(image, {middle, 100}, {1, 0}, 1) > 200);
  }
}

TEST_CASE("a_disc_behind_the_eye_is_not_drawn_and_their_number_must_match") {
  Marks stage;
  stage.view.projection = perspective;
  set_disc(stage.discs, {0, 0, 15}, {});
  CHECK(test::count_not_black(stage.picture([&] { stage.discs.draw(stage.view, {}); })) == 0);
  stage.discs.set_positions(std::vector<Point>(3));
  CHECK_THROWS_AS(stage.discs.draw(stage.view, {}), base::Error);
}

TEST_CASE("line_has_the_asked_width_at_any_scale") {
  Marks stage;
  set_line(stage.lines, {-10, 0.03, 0}, {10, 0.03, 0});
  for (const float scale : {1.0F, 2.0F}) {
    stage.view.scale = scale;
    const render::LineStyle style{.width = 3};
    const double area = test::lit_area(stage.picture([&] { stage.lines.draw(stage.view, style); }));
    const double width = 3 * scale, length = 200;
    CHECK(area == doctest::Approx(length * width + M_PI * width * width / 4).epsilon(0.03));
  }
}

TEST_CASE("hidden_parts_are_fainter_than_visible_ones") {
  Marks stage;
  const Wall wall(stage.gl);
  set_line(stage.lines, {-12, 4, 0}, {12, 4, 0});
  stage.discs.set_discs(std::vector<render::Disc>(2, render::Disc{glm::vec4(1), 6, false}));
  stage.discs.set_positions(std::vector<Point>{{-5, 0, -2}, {5, 0, -2}});
  const render::LineStyle style{.width = 4, .hidden_opacity = 0.25F};
  const render::Image image = stage.picture([&] {
    wall.draw(stage.view);
    stage.lines.draw(stage.view, style);
    stage.discs.draw(stage.view, {});
  });
  CHECK(image.pixel(100, 60)[0] == 255);
  CHECK(image.pixel(220, 60)[0] == doctest::Approx(64).epsilon(0.05));
  CHECK(image.pixel(110, 100)[0] == 255);
  CHECK(image.pixel(210, 100)[0] > 40);
  CHECK(image.pixel(210, 100)[0] < 128);
}

TEST_CASE("line_through_the_near_plane_is_cut_there") {
  Marks stage;
  stage.view.projection = perspective;
  set_line(stage.lines, {0, -1, 0}, {0, -1, 40});  // from 10 in front of the eye to 30 behind the eye
  const render::Image image = stage.picture([&] { stage.lines.draw(stage.view, {}); });
  CHECK(image.pixel(160, 195)[0] > 0);  // the line ends at the lower border
  for (int y = 0; y < 100; ++y) CHECK(image.pixel(160, y)[0] == 0);
  set_line(stage.lines, {-1, -1, 20}, {1, 1, 40});  // completely behind the eye
  CHECK(test::count_not_black(stage.picture([&] { stage.lines.draw(stage.view, {}); })) == 0);
}

TEST_CASE("segments_have_their_own_colours_or_interpolate_those_of_their_ends") {
  Marks stage;
  stage.lines.set_segments(std::vector<render::Segment>{{0, 1}, {2, 3}}, 4);
  stage.lines.set_positions(std::vector<Point>{{-10, 5, 0}, {10, 5, 0}, {-10, -5, 0}, {10, -5, 0}});
  const glm::vec4 red(1, 0, 0, 1), green(0, 1, 0, 1), blue(0, 0, 1, 1);
  stage.lines.set_colors(std::vector<glm::vec4>{red, green});
  const render::LineStyle style{.width = 4};
  const auto picture = [&] { return stage.picture([&] { stage.lines.draw(stage.view, style); }); };
  const render::Image each = picture();
  CHECK(each.pixel(160, 50) == render::Rgba8{255, 0, 0, 255});
  CHECK(each.pixel(160, 150) == render::Rgba8{0, 255, 0, 255});
  stage.lines.set_end_colors(std::vector<glm::vec4>{red, blue, green, green});
  const render::Image ramp = picture();
  CHECK(ramp.pixel(80, 50)[0] > ramp.pixel(120, 50)[0]);
  CHECK(ramp.pixel(80, 50)[2] < ramp.pixel(120, 50)[2]);
  CHECK(std::abs(ramp.pixel(160, 50)[0] - ramp.pixel(160, 50)[2]) < 6);
  CHECK_THROWS(stage.lines.set_end_colors(std::vector<glm::vec4>{red}));
}

TEST_CASE("halo_is_beside_its_line_and_under_other_lines") {
  Marks stage;
  stage.lines.set_segments(std::vector<render::Segment>{{0, 1}, {2, 3}}, 4);
  stage.lines.set_positions(std::vector<Point>{{-4, 0.05, 0}, {4, 0.05, 0}, {0.05, -4, 0}, {0.05, 4, 0}});
  stage.lines.set_color(glm::vec4(1, 0, 0, 1));
  render::LineStyle style{.width = 2};
  const render::Image plain = stage.picture([&] { stage.lines.draw(stage.view, style); });
  style.halo = glm::vec4(0, 0, 1, 1);
  const render::Image image = stage.picture([&] { stage.lines.draw(stage.view, style); });
  CHECK(brightest(plain, {130, 90}, {0, 1}, 2) == 0);
  CHECK(brightest(image, {130, 90}, {0, 1}, 2) > 100);
  for (int x = 130; x < 190; ++x)
    CHECK(brightest(image, {x, 90}, {0, 1}, 0) == brightest(plain, {x, 90}, {0, 1}, 0));
}

TEST_CASE("disc_at_a_corner_of_slanted_faces_is_whole") {
  Marks stage;
  stage.faces.set_triangles(std::vector<render::Triangle>{{0, 1, 2}}, 3);
  stage.faces.set_positions(
      std::vector<Point>{{0, 0, 0}, {6, -4, 10}, {6, 4, 10}});  // inclined to the viewer
  set_disc(stage.discs, {0, 0, 0}, {glm::vec4(1), 6, false});
  const render::FaceStyle untinted{.opacity = 0, .rim = 0};
  const render::Image image = stage.picture([&] {
    stage.faces.draw(stage.view, untinted);
    stage.discs.draw(stage.view, {});
  });
  CHECK(test::lit_area(image) == doctest::Approx(M_PI * 36).epsilon(0.03));
}

TEST_CASE("faces_tint_and_hide_lines_behind_them") {
  Marks stage;
  stage.faces.set_triangles(std::vector<render::Triangle>{{0, 1, 2}, {0, 2, 3}}, 4);
  stage.faces.set_positions(std::vector<Point>{{0, -9, 1}, {15, -9, 1}, {15, 9, 1}, {0, 9, 1}});
  set_line(stage.lines, {-12, 0, 0}, {12, 0, 0});
  render::FaceStyle style{.opacity = 0.1F};
  const render::LineStyle wide{.width = 4};
  const auto draw = [&] {
    stage.faces.draw(stage.view, style);
    stage.lines.draw(stage.view, wide);
  };
  const render::Image occluding = stage.picture(draw);
  CHECK(occluding.pixel(220, 50)[0] == doctest::Approx(25.5).epsilon(0.05));
  CHECK(occluding.pixel(100, 50)[0] == 0);
  CHECK(occluding.pixel(220, 100)[0] < 128);
  style.occlude = false;
  CHECK(stage.picture(draw).pixel(220, 100)[0] == 255);
}

TEST_CASE("edges_of_faces_are_not_hidden_by_their_own_faces") {
  Marks stage;
  stage.view.projection = perspective;
  const std::vector<Point> corners{{-4, -3, 2}, {4, -2, -3}, {0, 4, -1}};
  stage.faces.set_triangles(std::vector<render::Triangle>{{0, 1, 2}}, 3);
  stage.faces.set_positions(corners);
  set_line(stage.lines, corners[0], corners[1]);
  const render::LineStyle wide{.width = 3};
  const render::FaceStyle untinted{.opacity = 0, .rim = 0};
  const render::Image image = stage.picture([&] {
    stage.faces.draw(stage.view, untinted);
    stage.lines.draw(stage.view, wide);
  });
  for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const glm::ivec2 at = stage.pixel_of({-4 + 8 * t, -3 + t, 2 - 5 * t});
    CHECK(image.pixel(at.x, at.y)[0] == 255);
  }
}
