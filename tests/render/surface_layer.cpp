#include "render/surface_layer.h"

#include <limits>

#include "support/pictures.h"
#include "support/stage.h"

using namespace viete;
using test::Point;

namespace {

struct Scene {
  explicit Scene(const test::Ball& shape) : surface(stage.gl) {
    surface.set_triangles(shape.triangles, shape.positions.size());
    surface.set_positions(shape.positions, shape.normals);
  }

  render::Image picture(const render::SurfaceStyle& style = {}, int samples = 0) {
    return stage.picture([&] { surface.draw(stage.view, theme, style); }, samples);
  }

  test::Stage stage;
  render::SurfaceLayer surface;
  render::Theme theme = render::theme(true);
};

// Two triangles, 16 units wide and high. The texture has a red, a green, a blue and a transparent quarter.
struct Card : Scene {
  Card()
      : Scene({{{-8, -8, 0}, {8, -8, 0}, {8, 8, 0}, {-8, 8, 0}},
               std::vector<base::PackedNormal>(4),
               {{0, 1, 2}, {0, 2, 3}}}) {
    looks.texture_points = {{0, 1}, {1, 1}, {1, 0}, {0, 1}, {1, 0}, {0, 0}};
    render::Image image{64, 64, {}};
    for (int y = 0; y < 64; ++y)
      for (int x = 0; x < 64; ++x) {
        const bool right = x >= 32, lower = y >= 32;
        const std::uint8_t opacity = right && lower ? 0 : 255;
        const std::uint8_t all[] = {std::uint8_t(right || lower ? 20 : 230), std::uint8_t(right ? 230 : 20),
                                    std::uint8_t(lower ? 230 : 20), opacity};
        image.rgba.insert(image.rgba.end(), all, all + 4);
      }
    looks.images = {image};
    looks.runs = {{.triangles = 2, .image = 0}};
  }

  render::Image painted(render::Paint paint) {
    surface.set_looks(looks);
    return picture({.paint = paint});
  }

  render::SurfaceLooks looks;
};

bool mostly(const render::Rgba8& pixel, std::size_t channel) {
  for (std::size_t k = 0; k < 3; ++k)
    if (k != channel && 2 * pixel[k] > pixel[channel]) return false;
  return pixel[channel] > 60;
}

}  // namespace

TEST_CASE("lit_ball_covers_its_projected_area_multisampled_or_not") {
  Scene scene(test::ball(7));  // the ball has a radius of 70 pixels
  const render::Image plain = scene.picture(), sampled = scene.picture({}, 4);
  CHECK(static_cast<double>(test::count_not_black(plain)) == doctest::Approx(M_PI * 70 * 70).epsilon(0.01));
  CHECK(test::lit_area(sampled) == doctest::Approx(test::lit_area(plain)).epsilon(0.01));
  CHECK(test::difference(plain, sampled, 8) < 0.02);
  CHECK(test::difference(plain, scene.picture({.closed = true}), 1) < 0.001);
}

TEST_CASE("vertices_that_a_gpu_copies_from_staging_memory_or_gets_directly_draw_the_same_picture") {
  for (const bool memory : {true, false}) {
    Scene direct(test::ball(7)), staged(test::ball(7));
    REQUIRE(bool(staged.stage.gl.BufferStorage));
    staged.stage.gl.software = false;
    if (!memory) staged.stage.gl.BufferStorage = [](GLenum, GLsizeiptr, const void*, GLbitfield) {};
    for (const int step : {1, 2, 3}) {
      auto moved = test::ball(7, {3.0 * step, 0, 0});
      for (Scene* scene : {&direct, &staged}) scene->surface.set_positions(moved.positions, moved.normals);
      const render::Image picture = direct.picture();
      CHECK(test::count_not_black(picture) > 10'000);
      CHECK(staged.picture().rgba == picture.rgba);
    }
  }
}

TEST_CASE("key_light_comes_from_the_upper_left_and_backs_are_lit_too") {
  const render::Image image = Scene(test::ball(7)).picture();
  const int upper_left = test::brightness(image.pixel(160 - 30, 100 - 40));
  const int lower_right = test::brightness(image.pixel(160 + 40, 100 + 40));
  CHECK(upper_left > lower_right + 100);
  CHECK(lower_right > 40);  // no part is black
  test::Ball inside_out = test::ball(7);
  for (auto& t : inside_out.triangles) std::swap(t[1], t[2]);
  for (auto& n : inside_out.normals) n = base::pack_normal(-1 * base::unpack_normal(n));
  const int back = test::brightness(Scene(inside_out).picture().pixel(140, 80));
  CHECK(back > test::brightness(image.pixel(140, 80)) / 2);
}

TEST_CASE("model_far_from_the_origin_looks_the_same") {
  Scene near_scene(test::ball(7));
  const render::Image here = near_scene.picture();
  const Point far{3e8, -2e8, 5e8};  // at this distance, float has steps of 32 units
  Scene far_scene(test::ball(7, far));
  far_scene.stage.view.view =
      far_scene.stage.view.view * glm::translate(glm::dmat4(1), glm::dvec3(-far[0], -far[1], -far[2]));
  CHECK(test::difference(here, far_scene.picture(), 2) < 0.001);
}

TEST_CASE("perspective_and_shifted_projections_put_the_highlight_where_it_belongs") {
  Scene scene(test::ball(4));
  scene.stage.view.projection = glm::perspective(glm::radians(60.0), 1.6, 0.1, 100.0);
  const render::Image middle = scene.picture();
  // Shifts the projected picture to the left by 80 pixels: half a unit of clip space.
  const glm::dmat4 shift = glm::translate(glm::dmat4(1), glm::dvec3(-0.5, 0, 0));
  scene.stage.view.projection = shift * scene.stage.view.projection;
  const render::Image shifted = scene.picture();
  std::size_t differing = 0;
  for (int y = 0; y < 200; ++y)
    for (int x = 0; x < 240; ++x) {
      const int change = test::brightness(shifted.pixel(x, y)) - test::brightness(middle.pixel(x + 80, y));
      differing += std::abs(change) > 6 ? 1 : 0;
    }
  CHECK(test::count_not_black(middle) > 5000);
  CHECK(differing < 50);
}

TEST_CASE("occlusion_darkens") {
  const test::Ball ball = test::ball(7);
  Scene scene(ball);
  const double open = test::lit_area(scene.picture());
  scene.surface.set_occlusion(std::vector<float>(ball.positions.size(), 0.3F));
  scene.surface.set_positions(ball.positions, ball.normals);
  CHECK(test::lit_area(scene.picture()) < 0.9 * open);
  CHECK(test::lit_area(scene.picture({.occlusion = 0})) == doctest::Approx(open).epsilon(1e-6));
}

TEST_CASE("scalars_choose_the_palette_colour") {
  const test::Ball ball = test::ball(7);
  Scene scene(ball);
  std::vector<float> values;
  for (const Point& p : ball.positions) values.push_back(p[0] < 0 ? -5.0F : 5.0F);
  scene.surface.set_scalars(values);
  scene.surface.set_palette(render::surface_palette());
  scene.surface.set_positions(ball.positions, ball.normals);
  const render::Image image = scene.picture({.scalars = true, .scalar_low = -5, .scalar_high = 5});
  const render::Rgba8 left = image.pixel(130, 100), right = image.pixel(190, 100);
  CHECK(left[2] > left[0] + 30);    // blue
  CHECK(right[0] > right[2] + 30);  // yellow
}

TEST_CASE("a_surface_without_triangles_is_drawn_as_points") {
  test::Ball ball = test::ball(7);
  ball.triangles.clear();
  Scene scene(ball);
  CHECK(test::count_not_black(scene.picture()) > 1000);
  CHECK(test::count_not_black(scene.picture({.paint = render::Paint::file, .wireframe = 1})) > 1000);
}

TEST_CASE("non_finite_vertices_do_not_spread_and_an_empty_surface_is_not_drawn") {
  CHECK(test::count_not_black(Scene(test::Ball{}).picture()) == 0);
  test::Ball ball = test::ball(7);
  ball.positions[2000] = {std::numeric_limits<double>::quiet_NaN(), 0,
                          std::numeric_limits<double>::infinity()};
  Scene scene(ball);
  CHECK(static_cast<double>(test::count_not_black(scene.picture())) ==
        doctest::Approx(M_PI * 4900).epsilon(0.02));
}

TEST_CASE("too_large_surfaces_and_wrong_sizes_and_indices_are_refused") {
  test::Stage stage;
  stage.gl.max_texels = 8;
  render::SurfaceLayer surface(stage.gl);
  const std::vector<render::Triangle> triangles{{0, 1, 2}, {0, 2, 3}, {1, 2, 3}};
  CHECK_THROWS_AS(surface.set_triangles(triangles, 4), base::Error);
  CHECK_NOTHROW(surface.set_triangles(std::span(triangles).first(2), 4));
  CHECK_THROWS_WITH_AS(surface.set_triangles(std::span(triangles).first(2), 3),
                       "surface triangles: element 1: refers to vertex 3, the mesh has 3", base::Error);
  const std::vector<Point> three(3), four(4);
  const std::vector<base::PackedNormal> normals(3);
  CHECK_THROWS_AS(surface.set_positions(three, normals), base::Error);
  CHECK_THROWS_AS(surface.set_positions(four, normals), base::Error);
  CHECK_THROWS_AS(surface.set_occlusion(std::vector<float>(3)), base::Error);
  CHECK_THROWS_AS(surface.set_scalars(std::vector<float>(5)), base::Error);
  CHECK_THROWS_AS(surface.set_palette(std::vector<glm::vec3>(1)), base::Error);
  render::SurfaceLooks looks;
  looks.texture_points.resize(5);
  CHECK_THROWS_AS(surface.set_looks(looks), base::Error);
  looks.texture_points.clear();
  looks.runs = {{.triangles = 3}};
  CHECK_THROWS_AS(surface.set_looks(looks), base::Error);
}

TEST_CASE("image_is_upright_and_transparent_pixels_are_cut_out") {
  Card card;
  const render::Image image = card.painted(render::Paint::file);
  CHECK(mostly(image.pixel(120, 60), 0));   // red at the upper left
  CHECK(mostly(image.pixel(200, 60), 1));   // green
  CHECK(mostly(image.pixel(120, 140), 2));  // blue
  CHECK(test::brightness(image.pixel(200, 140)) == 0);
  card.looks.runs[0].color = {1, 1, 0};
  card.looks.colors.assign(4, {255, 255, 255, 255});
  card.looks.images[0].rgba.assign(4 * 64 * 64, 255);
  const auto both = card.painted(render::Paint::file).pixel(160, 100);
  CHECK(both[0] > 3 * both[2]);
  CHECK(both[1] > 3 * both[2]);
  card.looks.colors.assign(4, {255, 0, 0, 255});
  CHECK(mostly(card.painted(render::Paint::file).pixel(160, 100), 0));
  // One triangle is red, and the other triangle is green.
  card.looks.colors.assign(6, {255, 0, 0, 255});
  std::fill(card.looks.colors.begin() + 3, card.looks.colors.end(), render::Rgba8{0, 255, 0, 255});
  card.looks.colors_of_corners = true;
  card.looks.runs[0].color = {1, 1, 1};
  const render::Image faces = card.painted(render::Paint::file);
  CHECK(mostly(faces.pixel(210, 130), 0));  // below the diagonal
  CHECK(mostly(faces.pixel(110, 70), 1));
}

TEST_CASE("checker_and_normals_paint_the_surface") {
  Card card;
  const render::Image checker = card.painted(render::Paint::checker);
  // The card has 16 x 16 squares in 160 x 160 pixels. A square has a side of 10 pixels.
  const int a = test::brightness(checker.pixel(105, 45)), b = test::brightness(checker.pixel(115, 45));
  CHECK(std::abs(a - b) > 40);
  CHECK(std::abs(a - test::brightness(checker.pixel(115, 55))) < 20);
  const auto facing = card.painted(render::Paint::normals).pixel(160, 100);
  CHECK(std::abs(facing[0] - 128) <= 1);
  CHECK(std::abs(facing[1] - 128) <= 1);
  CHECK(facing[2] >= 254);
}

TEST_CASE("flat_runs_have_one_light_for_each_face") {
  const test::Ball ball = test::ball(7, {0, 0, 0}, 6);
  Scene scene(ball);
  render::SurfaceLooks looks;
  looks.runs = {{.triangles = ball.triangles.size()}};
  const auto neighbours_differ = [&](bool flat) {
    looks.runs[0].flat = flat;
    scene.surface.set_looks(looks);
    const render::Image image = scene.picture({.paint = render::Paint::normals});
    int changes = 0;
    for (int x = 100; x < 219; ++x) changes += image.pixel(x, 90) != image.pixel(x + 1, 90);
    return changes;
  };
  CHECK(neighbours_differ(true) < 15);
  CHECK(neighbours_differ(false) > 60);
}

TEST_CASE("materials_differ_from_clay_and_from_each_other_and_zebra_has_stripes") {
  using render::Paint;
  Scene scene(test::ball(5));
  const auto picture = [&](Paint paint) { return scene.picture({.paint = paint}); };
  const auto clay = picture(Paint::plain).pixel(160, 100),
             porcelain = picture(Paint::porcelain).pixel(160, 100),
             jade = picture(Paint::jade).pixel(160, 100);
  CHECK(clay[0] > clay[2] + 15);            // clay is warm
  CHECK(porcelain[2] + 5 >= porcelain[0]);  // porcelain is white and slightly cool
  CHECK(jade[1] > jade[0] + 30);
  CHECK(jade[1] > jade[2] + 15);
  const render::Image zebra = picture(Paint::zebra);
  int changes = 0;
  for (int y = 40; y < 160; ++y)
    changes += std::abs(int(zebra.pixel(160, y)[0]) - int(zebra.pixel(160, y - 4)[0])) > 60;
  CHECK(changes >= 4);
}

TEST_CASE("points_have_the_size_of_their_spacing_within_limits_and_colors_of_the_file_or_the_map") {
  const test::Ball two{{{-8, 0, 0}, {8, 0, 0}}, std::vector<base::PackedNormal>(2), {}};
  Scene scene(two);
  const auto area = [&](float spacing, float scale) {
    scene.stage.view.scale = scale;
    return static_cast<double>(
               test::count_not_black(scene.picture({.paint = render::Paint::file, .spacing = spacing}))) /
           2;
  };
  CHECK(area(0.25F, 1) == doctest::Approx(M_PI / 4 * 4.5 * 4.5).epsilon(0.3));  // 10 pixels a unit
  CHECK(area(0, 1) == 4);
  CHECK(area(100, 1) == doctest::Approx(M_PI / 4 * 36).epsilon(0.3));
  CHECK(area(100, 2) == doctest::Approx(M_PI / 4 * 144).epsilon(0.2));
  render::SurfaceLooks looks;
  looks.colors = {{255, 0, 0, 255}, {0, 0, 255, 255}};
  scene.surface.set_looks(looks);
  const auto main_channel = [&](const render::SurfaceStyle& style, double x) {
    const glm::ivec2 at = scene.stage.pixel_of({x, 0, 0});
    const render::Rgba8 pixel = scene.picture(style).pixel(at.x, at.y);
    return mostly(pixel, 0) ? 0 : mostly(pixel, 1) ? 1 : mostly(pixel, 2) ? 2 : 3;
  };
  const render::SurfaceStyle of_file{.paint = render::Paint::file, .spacing = 1};
  CHECK(main_channel(of_file, -8) == 0);
  CHECK(main_channel(of_file, 8) == 2);
  CHECK(main_channel({.spacing = 1}, 8) == 3);
  const std::vector<glm::vec3> palette = {{0, 0, 1}, {0, 1, 0}};
  scene.surface.set_palette(palette);
  scene.surface.set_scalars(std::vector<float>{0, 1});
  CHECK(main_channel({.scalars = true, .spacing = 1}, -8) == 2);
  CHECK(main_channel({.scalars = true, .spacing = 1}, 8) == 1);
}
