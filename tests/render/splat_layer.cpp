#include "render/splat_layer.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "support/pictures.h"
#include "support/stage.h"

using namespace viete;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity(),
                not_a_number = std::numeric_limits<float>::quiet_NaN();

struct Capture {
  std::vector<render::SurfaceVertex> vertices;
  std::vector<render::SplatShape> shapes;
  std::vector<render::SplatTurn> turns;
  render::SplatLooks looks;
  std::vector<float> harmonics;

  void add(const glm::vec3& at, const render::SplatShape& shape, float opacity, const glm::vec3& color,
           const render::SplatTurn& turn = {1, 0, 0, 0}) {
    vertices.push_back({{at.x, at.y, at.z}, {}});
    shapes.push_back(shape);
    turns.push_back(turn);
    looks.opacities.push_back(opacity);
    looks.colors.push_back({color.r, color.g, color.b});
  }
};

render::SplatShape round_shape(float deviation) {
  return {deviation, 0, 0, 0, deviation, 0, 0, 0, deviation};
}

render::SplatTurn turn_of(std::mt19937& random) {
  std::normal_distribution<float> normal;
  const glm::vec4 q =
      glm::normalize(glm::vec4(normal(random), normal(random), normal(random), normal(random)));
  return {q.x, q.y, q.z, q.w};
}

glm::dmat3 matrix_of(const render::SplatTurn& q) {
  const double w = q[0], x = q[1], y = q[2], z = q[3];
  return glm::transpose(glm::dmat3(1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y),
                                   2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x),
                                   2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)));
}

// Overlapping needles, plates and balls with harmonics of this degree, and turned colours.
Capture many(int degree, std::size_t count = 60) {
  std::mt19937 random(7);
  std::normal_distribution<float> normal;
  std::uniform_real_distribution<float> even;
  Capture s;
  s.looks.degree = degree;
  for (std::size_t i = 0; i < count; ++i) {
    const glm::dmat3 rotation = matrix_of(turn_of(random));
    render::SplatShape shape;
    for (int k = 0; k < 3; ++k) {
      const float deviation = 0.5F * std::exp(normal(random) - 0.5F);
      for (int j = 0; j < 3; ++j) shape[3 * j + k] = static_cast<float>(rotation[k][j]) * deviation;
    }
    s.add({2 * normal(random), 2 * normal(random), 2 * normal(random)}, shape, even(random),
          {even(random), even(random), even(random)}, turn_of(random));
  }
  for (std::size_t i = 0; i < count * 3 * degree * (degree + 2); ++i)
    s.harmonics.push_back(0.3F * normal(random));
  return s;
}

// The reference: exact order, all pixels of all splats, in double. A card's framebuffer limits colours to 1
// after each splat; the processor does so at the end.
class Reference {
public:
  Reference(const Capture& splats, const render::View& view, bool of_card)
      : s_(splats), view_(view), most_(of_card ? 1 : 1e9) {}

  render::Image picture() const {
    std::vector<std::size_t> order(s_.vertices.size());
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return eye(i).z < eye(j).z; });
    std::vector<glm::dvec3> pixels(static_cast<std::size_t>(view_.size.x * view_.size.y), glm::dvec3(0));
    for (const std::size_t i : order) blend(i, pixels);
    render::Image image{view_.size.x, view_.size.y, {}};
    for (const glm::dvec3& pixel : pixels)
      for (int k = 0; k < 4; ++k)
        image.rgba.push_back(k == 3 ? 255
                                    : static_cast<std::uint8_t>(std::lround(255 * std::min(pixel[k], 1.0))));
    return image;
  }

private:
  glm::dvec3 position(std::size_t i) const {
    const float* p = s_.vertices[i].position;
    return {p[0], p[1], p[2]};
  }
  glm::dvec3 eye(std::size_t i) const { return glm::dvec3(view_.view * glm::dvec4(position(i), 1)); }
  bool perspective() const { return view_.projection[3][3] == 0; }

  glm::dvec3 color(std::size_t i) const {
    const glm::dmat3 to_world = glm::transpose(glm::dmat3(view_.view));
    const glm::dvec3 seen = to_world * (perspective() ? glm::normalize(eye(i)) : glm::dvec3(0, 0, -1));
    const glm::dvec3 d = glm::transpose(matrix_of(s_.turns[i])) * seen;
    const double x = d.x, y = d.y, z = d.z, pi = M_PI;
    const double basis[] = {-std::sqrt(3 / (4 * pi)) * y,
                            std::sqrt(3 / (4 * pi)) * z,
                            -std::sqrt(3 / (4 * pi)) * x,
                            std::sqrt(15 / (4 * pi)) * x * y,
                            -std::sqrt(15 / (4 * pi)) * y * z,
                            std::sqrt(5 / (16 * pi)) * (3 * z * z - 1),
                            -std::sqrt(15 / (4 * pi)) * x * z,
                            std::sqrt(15 / (16 * pi)) * (x * x - y * y),
                            -std::sqrt(35 / (32 * pi)) * y * (3 * x * x - y * y),
                            std::sqrt(105 / (4 * pi)) * x * y * z,
                            -std::sqrt(21 / (32 * pi)) * y * (5 * z * z - 1),
                            std::sqrt(7 / (16 * pi)) * z * (5 * z * z - 3),
                            -std::sqrt(21 / (32 * pi)) * x * (5 * z * z - 1),
                            std::sqrt(105 / (16 * pi)) * z * (x * x - y * y),
                            -std::sqrt(35 / (32 * pi)) * x * (x * x - 3 * y * y)};
    const int bands = s_.looks.degree * (s_.looks.degree + 2);
    glm::dvec3 sum(s_.looks.colors[i][0], s_.looks.colors[i][1], s_.looks.colors[i][2]);
    for (int k = 0; k < 3; ++k)
      for (int b = 0; b < bands; ++b) sum[k] += basis[b] * s_.harmonics[(3 * i + k) * bands + b];
    return glm::max(sum, 0.0);
  }

  // The covariance on the screen, in squared pixels. `e` is the centre in eye space.
  glm::dmat2 covariance(std::size_t i, const glm::dvec3& e) const {
    const render::SplatShape& m = s_.shapes[i];
    const glm::dvec2 factor =
        0.5 * glm::dvec2(view_.size) * glm::dvec2(view_.projection[0][0], view_.projection[1][1]);
    // Beyond 1.3 times the picture's half size, the Jacobian stays constant.
    const glm::dvec2 most = 1.3 / glm::dvec2(view_.projection[0][0], view_.projection[1][1]);
    const double z = perspective() ? -e.z : 1;
    const glm::dvec2 slope = perspective() ? glm::clamp(glm::dvec2(e) / z, -most, most) : glm::dvec2(0);
    glm::dmat2 v(0);
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 axis = glm::dmat3(view_.view) * glm::dvec3(m[k], m[3 + k], m[6 + k]);
      const glm::dvec2 on_screen = factor * (glm::dvec2(axis) + slope * axis.z) / z;
      v += glm::outerProduct(on_screen, on_screen);
    }
    return v + glm::dmat2(0.3);
  }

  void blend(std::size_t i, std::vector<glm::dvec3>& pixels) const {
    const glm::dvec3 e = eye(i);
    const glm::dvec4 clip = view_.projection * glm::dvec4(e, 1);
    if (clip.z < -clip.w || clip.z > clip.w) return;
    const glm::dvec2 center = (0.5 + 0.5 * glm::dvec2(clip) / clip.w) * glm::dvec2(view_.size);
    const glm::dmat2 inverse = glm::inverse(covariance(i, e));
    const glm::dvec3 c = color(i);
    for (int y = 0; y < view_.size.y; ++y)
      for (int x = 0; x < view_.size.x; ++x) {
        const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - center;
        const double square = glm::dot(d, inverse * d);
        if (square > 9) continue;
        const double alpha = std::min(0.99, s_.looks.opacities[i] * std::exp(-0.5 * square));
        glm::dvec3& pixel = pixels[static_cast<std::size_t>((view_.size.y - 1 - y) * view_.size.x + x)];
        pixel = glm::min(alpha * c + (1 - alpha) * pixel, most_);
      }
  }

  const Capture& s_;
  const render::View& view_;
  double most_;
};

struct SplatStage : test::Stage {
  explicit SplatStage(bool software) { gl.software = software; }
};

// If `software`, the processor blends the splats.
template <bool software>
struct SplatScene : SplatStage {
  SplatScene() : SplatStage(software), layer(gl) {
    view.size = {64, 64};
    orthographic();
  }

  void orthographic() {
    view.view = glm::lookAt(glm::dvec3(2, 3, 9), glm::dvec3(0), glm::dvec3(0, 1, 0));
    view.projection = glm::ortho(-6.0, 6.0, -6.0, 6.0, 0.1, 100.0);
  }
  void perspective() {
    view.view = glm::lookAt(glm::dvec3(-3, 2, 8), glm::dvec3(0.3, 0, 0), glm::dvec3(0, 1, 0));
    view.projection = glm::perspective(0.9, 1.0, 0.1, 100.0);
  }

  void set(const Capture& s) {
    auto looks = s.looks;
    looks.harmonics = std::make_shared<const std::vector<float>>(s.harmonics);
    layer.set_looks(std::make_shared<const render::SplatLooks>(std::move(looks)));
    layer.set_splats(s.vertices, {0, 0, 0}, s.shapes, s.turns);
  }
  render::Image drawn(const render::SurfaceStyle& style = {}, std::size_t step = 1) {
    return picture([&] { layer.draw(view, style, step); });
  }
  render::Image drawn(const Capture& s) {
    set(s);
    return drawn();
  }

  render::SplatLayer layer;
};

using OnProcessor = SplatScene<true>;
using OnCard = SplatScene<false>;

int largest_difference(const render::Image& a, const render::Image& b) {
  int largest = 0;
  for (std::size_t i = 0; i < a.rgba.size(); ++i)
    largest = std::max(largest, std::abs(a.rgba[i] - b.rgba[i]));
  return largest;
}

}  // namespace

TEST_CASE_TEMPLATE("splats_of_every_degree_equal_the_reference_within_four_levels_in_both_projections", Scene,
                   OnProcessor, OnCard) {
  Scene scene;
  for (const bool perspective : {false, true})
    for (const int degree : {0, 1, 2, 3}) {
      if (perspective) scene.perspective();
      const Capture splats = many(degree);
      const render::Image drawn = scene.drawn(splats),
                          exact = Reference(splats, scene.view, !scene.gl.software).picture();
      CAPTURE(perspective);
      CAPTURE(degree);
      CHECK(test::count_not_black(exact) > 3000);
      CHECK(largest_difference(drawn, exact) <= 4);
      CHECK(test::difference(drawn, exact, 2) < 0.01);
    }
}

TEST_CASE_TEMPLATE("single_splat_has_a_gaussian_profile_and_its_color", Scene, OnProcessor, OnCard) {
  Scene scene;
  scene.view.view = glm::lookAt(glm::dvec3(0, 0, 10), glm::dvec3(0), glm::dvec3(0, 1, 0));
  Capture one;
  one.add({0.09375F, 0.09375F, 0}, round_shape(1), 0.8F, {1, 0.5F, 0.25F});  // the middle of a pixel
  const render::Image image = scene.drawn(one);
  const double variance = 0.3 + std::pow(64.0 / 12, 2);  // in squared pixels
  for (const int d : {0, 3, 7, 12}) {
    const double alpha = 0.8 * std::exp(-0.5 * d * d / variance);
    for (const render::Rgba8& pixel : {image.pixel(32 + d, 31), image.pixel(32, 31 - d)}) {
      for (int k = 0; k < 3; ++k) CHECK(std::abs(pixel[k] - 255 * alpha / (1 << k)) < 1);
    }
  }
  CHECK(test::brightness(image.pixel(32 + 17, 31)) == 0);
}

TEST_CASE_TEMPLATE("splats_without_an_ellipse_are_not_drawn", Scene, OnProcessor, OnCard) {
  Scene scene;
  CHECK(test::count_not_black(scene.drawn()) == 0);  // without looks
  CHECK(test::count_not_black(scene.drawn(Capture())) == 0);
  for (const bool perspective : {false, true}) {
    if (perspective) scene.perspective();
    Capture hidden;
    const glm::vec3 white(1);
    for (const float bad : {not_a_number, infinite, -infinite}) {
      hidden.add({0, bad, 0}, round_shape(1), 1, white);
      hidden.add({0, 0, 0}, round_shape(bad), 1, white);
    }
    hidden.add({0, 0, 0}, round_shape(1), not_a_number, white);
    hidden.add({0, 0, 0}, round_shape(1), 0, white);
    hidden.add({-9, 6, 24}, round_shape(1e3F), 1, white);  // behind the eye of both views
    hidden.add({0, 0, -1e9F}, round_shape(1), 1, white);
    CHECK(test::count_not_black(scene.drawn(hidden)) == 0);
    hidden.add({0, 0, 0}, round_shape(1), 1, white);
    CHECK(test::count_not_black(scene.drawn(hidden)) > 100);
  }
}

TEST_CASE_TEMPLATE("tiny_splats_have_the_size_of_the_blur_and_huge_ones_fill_the_view", Scene, OnProcessor,
                   OnCard) {
  Scene scene;
  for (const bool perspective : {false, true}) {
    if (perspective) scene.perspective();
    Capture tiny, huge, needle;
    tiny.add({0, 0, 0}, round_shape(1e-30F), 1, {1, 1, 1});
    huge.add({0, 0, 0}, round_shape(1e30F), 1, {1, 1, 1});
    needle.add({0, 0, 0}, {1e30F, 0, 0, 0, 1e-30F, 0, 0, 0, 1e-30F}, 1, {1, 1, 1});
    const double blur = 2 * M_PI * 0.3;  // the integral over the pixels
    CHECK(test::lit_area(scene.drawn(tiny)) == doctest::Approx(blur).epsilon(0.2));
    const render::Image filled = scene.drawn(huge);
    CHECK(test::count_not_black(filled) == 64 * 64);
    for (const auto& [x, y] : {std::pair(1, 1), {32, 32}, {62, 62}})
      CHECK(test::brightness(filled.pixel(x, y)) == doctest::Approx(3 * 0.99 * 255).epsilon(0.01));
    const auto count = test::count_not_black(scene.drawn(needle));
    CHECK(count > 100);
    CHECK(count < 400);
  }
}

TEST_CASE("splats_behind_opaque_ones_do_not_change_the_picture") {
  OnProcessor scene;
  Capture layers;
  for (int i = 0; i < 20; ++i) layers.add({0, 0, 3}, round_shape(1e3F), 1, {1, 0, 0});
  const render::Image front = scene.drawn(layers);
  for (int i = 0; i < 20'000; ++i) layers.add({0, 0, -3}, round_shape(1e3F), 0.9F, {0, 0, 1});
  CHECK(largest_difference(scene.drawn(layers), front) <= 1);
  CHECK(front.pixel(5, 60)[0] >= 254);
}

TEST_CASE_TEMPLATE("bad_colors_are_clamped", Scene, OnProcessor, OnCard) {
  Scene scene;
  Capture bad;
  bad.add({-3, 0, 0}, round_shape(1), 1, {not_a_number, -1, 0.5F});
  bad.add({3, 0, 0}, round_shape(1), 1, {infinite, 1e30F, 0.5F});
  const render::Image image = scene.drawn(bad);
  const auto at = [&](double x) {
    const glm::ivec2 pixel = scene.pixel_of({x, 0, 0});
    return image.pixel(pixel.x, pixel.y);
  };
  CHECK(at(-3)[0] + at(-3)[1] == 0);
  CHECK(at(-3)[2] > 100);
  CHECK(at(3)[0] == 255);
  CHECK(at(3)[1] == 255);
}

TEST_CASE_TEMPLATE("splats_are_hidden_by_nearer_surfaces_and_hide_what_is_drawn_behind_their_solid_parts",
                   Scene, OnProcessor, OnCard) {
  Scene scene;
  scene.view.view = glm::lookAt(glm::dvec3(0, 0, 10), glm::dvec3(0), glm::dvec3(0, 1, 0));
  Capture one;
  one.add({0, 0, 0}, round_shape(1), 1, {1, 0, 0});
  scene.set(one);
  render::SurfaceLayer wall(scene.gl);
  const std::vector<render::Triangle> triangles = {{0, 1, 2}};
  wall.set_triangles(triangles, 3);
  const auto picture = [&](double z, bool wall_first) {
    const std::vector<test::Point> corners = {{-50, -50, z}, {50, -50, z}, {0, 50, z}};
    wall.set_positions(corners, std::vector<base::PackedNormal>(3, base::pack_normal({0, 0, 1})));
    return scene.picture([&] {
      if (!wall_first) scene.layer.draw(scene.view, {});
      wall.draw(scene.view, render::theme(true), {});
      if (wall_first) scene.layer.draw(scene.view, {});
    });
  };
  const auto is_red = [&](const render::Rgba8& p) { return p[0] > 4 * p[1]; };
  CHECK(is_red(picture(-1, true).pixel(32, 32)));
  CHECK_FALSE(is_red(picture(1, true).pixel(32, 32)));
  CHECK(is_red(picture(-1, false).pixel(32, 32)));
  CHECK_FALSE(is_red(picture(1, false).pixel(32, 32)));
  CHECK_FALSE(is_red(picture(-1, false).pixel(32 + 10, 32)));  // less than half opacity
}

TEST_CASE_TEMPLATE("scalars_replace_the_colors_by_those_of_the_palette", Scene, OnProcessor, OnCard) {
  Scene scene;
  Capture row;
  for (const float x : {-4.0F, 0.0F, 4.0F}) row.add({x, 0, 0}, round_shape(0.6F), 1, {1, 1, 1});
  scene.set(row);
  const std::vector<glm::vec3> palette = {{0, 0, 1}, {0, 1, 0}, {1, 0, 0}};
  scene.layer.set_palette(palette);
  const auto main_channel = [&](const render::Image& image, double x) {
    const glm::ivec2 at = scene.pixel_of({x, 0, 0});
    const render::Rgba8 pixel = image.pixel(at.x, at.y);
    return std::max_element(pixel.begin(), pixel.begin() + 3) - pixel.begin();
  };
  const render::SurfaceStyle style{.scalars = true, .scalar_low = 10, .scalar_high = 30};
  const render::Image plain = scene.drawn(style);
  CHECK(plain.rgba == scene.drawn().rgba);  // without scalars
  scene.layer.set_scalars(std::vector<float>{not_a_number, 20, 1000});
  const render::Image map = scene.drawn(style);
  CHECK(main_channel(map, -4) == 2);
  CHECK(main_channel(map, 0) == 1);
  CHECK(main_channel(map, 4) == 0);
  CHECK(scene.drawn().rgba == plain.rgba);
  CHECK_THROWS_AS(scene.layer.set_scalars(std::vector<float>(2)), base::Error);
}

TEST_CASE_TEMPLATE("splats_far_from_the_origin_look_the_same", Scene, OnProcessor, OnCard) {
  Scene scene;
  scene.perspective();
  const Capture splats = many(2);
  const render::Image here = scene.drawn(splats);
  const glm::dvec3 far(3e8, -2e8, 5e8);
  scene.view.view = scene.view.view * glm::translate(glm::dmat4(1), -far);
  scene.layer.set_splats(splats.vertices, {far.x, far.y, far.z}, splats.shapes, splats.turns);
  CHECK(test::difference(here, scene.drawn(), 2) < 0.001);
}

TEST_CASE_TEMPLATE("every_second_splat_enlarged_covers_about_the_same_area", Scene, OnProcessor, OnCard) {
  Scene scene;
  Capture sheet;
  for (int i = 0; i < 4096; ++i)
    sheet.add({0.1F * static_cast<float>(i % 64) - 3.2F, 0.1F * static_cast<float>(i / 64) - 3.2F, 0},
              round_shape(0.05F), 0.7F, {1, 1, 1});
  scene.set(sheet);
  const double whole = test::lit_area(scene.drawn({}, 1));
  for (const std::size_t step : {2U, 5U, 9U})
    CHECK(test::lit_area(scene.drawn({}, step)) == doctest::Approx(whole).epsilon(0.2));
  CHECK(test::count_not_black(scene.drawn({}, 5000)) > 0);
}

TEST_CASE_TEMPLATE("wrong_numbers_of_splats_are_rejected", Scene, OnProcessor, OnCard) {
  Scene scene;
  const Capture splats = many(1, 4);
  scene.set(splats);
  const std::span<const render::SplatTurn> no_turns;
  const auto set = [&](std::size_t vertices, std::size_t shapes, std::size_t turns) {
    scene.layer.set_splats(std::span(splats.vertices).first(vertices), {0, 0, 0},
                           std::span(splats.shapes).first(shapes), std::span(splats.turns).first(turns));
  };
  CHECK_THROWS_AS(set(3, 4, 4), base::Error);
  CHECK_THROWS_AS(set(4, 3, 4), base::Error);
  CHECK_THROWS_AS(set(4, 4, 3), base::Error);
  CHECK_NOTHROW(set(4, 4, 0));
  auto looks = splats.looks;
  looks.harmonics = std::make_shared<const std::vector<float>>(35);
  CHECK_THROWS_AS(scene.layer.set_looks(std::make_shared<const render::SplatLooks>(looks)), base::Error);
}

TEST_CASE("depths_are_sorted_back_to_front_and_equal_ones_keep_their_order") {
  std::mt19937 random(3);
  std::normal_distribution<float> normal;
  std::vector<float> depths = {1, -1, 0, -0.0F, 1e-40F, -1e30F, 1e30F, 5, 5, 5};
  for (int i = 0; i < 10'000; ++i) depths.push_back(std::round(100 * normal(random)) * 0.01F);
  std::vector<std::uint32_t> order, exact(depths.size());
  std::iota(exact.begin(), exact.end(), 0);
  std::replace(depths.begin(), depths.end(), -0.0F, 0.0F);
  std::stable_sort(exact.begin(), exact.end(), [&](auto i, auto j) { return depths[i] > depths[j]; });
  render::sort_back_to_front(depths, order);
  CHECK(order == exact);
  render::sort_back_to_front({}, order);
  CHECK(order.empty());
}
