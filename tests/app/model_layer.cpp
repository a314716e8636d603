#include "app/model_layer.h"

#include <doctest/doctest.h>

#include <cmath>

#include "mesh/normals.h"
#include "support/folder.h"

using namespace viete;

namespace {

// Two quads in the plane z = 0. If `bend` is not 0, the second quad is bent up at x = 1.
struct BentStrip {
  explicit BentStrip(double bend) {
    surface.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, bend}, {0, 1, 0}, {1, 1, 0}, {2, 1, bend}};
    surface.corners = {0, 1, 4, 3, 1, 2, 5, 4};
    surface.polygon_starts = {0, 4, 8};
    mesh::triangulate(surface);
    normals.resize(6);
    const auto around = mesh::vertex_triangles(6, surface.triangles);
    mesh::vertex_normals(surface.positions, surface.triangles, around, 0, 6, normals);
    const double length = std::hypot(1, bend);
    attributes.normals = {{0, 0, 1}, {-bend / length, 0, 1 / length}};
    attributes.corner_normal = {0, 0, 0, 0, 1, 1, 1, 1};
  }

  app::ModelLooks looks() const { return app::looks_of(surface, attributes, normals); }

  mesh::Surface surface;
  formats::Attributes attributes;
  std::vector<mesh::Point> normals;
};

formats::Group group(std::uint32_t first_polygon, std::uint32_t material, bool smooth = true) {
  return {first_polygon, "", "", material, smooth};
}

}  // namespace

TEST_CASE("faces_are_flat_where_the_file_has_an_edge_or_says_so_and_nowhere_else") {
  BentStrip strip(1);
  auto runs = strip.looks().looks.runs;
  REQUIRE(runs.size() == 1);
  CHECK(runs[0].flat);
  CHECK_FALSE(BentStrip(0).looks().looks.runs.at(0).flat);
  strip.attributes.corner_normal.clear();
  CHECK_FALSE(strip.looks().looks.runs.at(0).flat);
  strip.attributes.groups = {group(0, mesh::none), group(1, mesh::none, false)};
  runs = strip.looks().looks.runs;
  REQUIRE(runs.size() == 2);
  CHECK((!runs[0].flat && runs[1].flat));
  CHECK(runs[0].triangles == 2);
}

TEST_CASE("triangles_of_a_material_come_together_with_their_texture_points") {
  BentStrip strip(0);
  strip.attributes.materials = {{.name = "red", .base_color = {1, 0, 0, 1}}, {.name = "grey"}};
  strip.attributes.groups = {group(0, 1), group(1, 0)};
  strip.attributes.texture_points = {{0.25, 0.25}};
  strip.attributes.corner_texture.assign(8, 0);
  const app::ModelLooks looks = strip.looks();
  REQUIRE(looks.looks.runs.size() == 2);
  CHECK(looks.looks.runs[0].color == glm::vec3(1, 0, 0));
  CHECK(looks.triangles[0] == mesh::Triangle{1, 2, 5});
  CHECK(looks.looks.texture_points.size() == 12);
  CHECK(looks.looks.texture_points[3] == std::array<float, 2>{0.25F, 0.75F});
  CHECK(looks.has_looks);
}

TEST_CASE("a_draft_has_the_looks_of_the_triangles_that_it_replaces") {
  BentStrip strip(0);
  strip.attributes.materials = {{.name = "red", .base_color = {1, 0, 0, 1}}, {.name = "grey"}};
  strip.attributes.groups = {group(0, 1), group(1, 0)};
  strip.attributes.texture_points = {{0.25, 0.25}, {0.5, 0.75}};
  strip.attributes.corner_texture = {0, 0, 0, 0, 1, 1, 1, 1};
  for (int v = 0; v < 6; ++v) strip.attributes.colors.push_back({v == 5 ? 1.0F : 0.0F, 0, 0, 1});
  const mesh::Draft draft{
      mesh::from_triangles(std::vector<mesh::Point>(4), {{0, 1, 2}, {1, 2, 3}}), {0, 1, 5, 2}, {0, 2}};
  const auto looks = app::looks_of(strip.surface, strip.attributes, strip.normals, &draft);
  CHECK(looks.draft_triangles == std::vector<mesh::Triangle>{{1, 2, 3}, {0, 1, 2}});  // red first
  REQUIRE(looks.draft_looks.runs.size() == 2);
  CHECK(looks.draft_looks.runs[0].color == glm::vec3(1, 0, 0));
  REQUIRE(looks.draft_looks.texture_points.size() == 6);
  CHECK(looks.draft_looks.texture_points[0] == std::array<float, 2>{0.5F, 0.25F});
  CHECK(looks.draft_looks.colors[2] == render::Rgba8{255, 0, 0, 255});
  CHECK(looks.draft_looks.colors[3] == render::Rgba8{0, 0, 0, 255});
}

TEST_CASE("colours_of_faces_are_those_of_their_corners_unless_vertices_have_some") {
  BentStrip strip(0);
  strip.attributes.polygon_colors = {{1, 0, 0, 1}, {0, 0, 1, 1}};
  strip.attributes.groups = {group(0, mesh::none), group(1, mesh::none, false)};
  app::ModelLooks looks = strip.looks();
  CHECK(looks.has_looks);
  CHECK(looks.looks.colors_of_corners);
  REQUIRE(looks.looks.colors.size() == 12);
  CHECK(looks.looks.colors[5] == render::Rgba8{255, 0, 0, 255});
  CHECK(looks.looks.colors[6] == render::Rgba8{0, 0, 255, 255});
  strip.attributes.colors.assign(6, {0, 1, 0, 1});
  looks = strip.looks();
  CHECK_FALSE(looks.looks.colors_of_corners);
  CHECK(looks.looks.colors.size() == 6);
}

TEST_CASE("grey_materials_are_ignored_and_a_bad_image_is_skipped") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "bad.png", "no picture");
  BentStrip strip(0);
  strip.attributes.materials = {{.name = "grey"}};
  strip.attributes.groups = {group(0, 0)};
  CHECK_FALSE(strip.looks().has_looks);
  strip.attributes.materials[0].base_color_image = 0;
  const auto text = std::make_shared<const std::string>("no picture");
  for (const auto& [image, name] : {std::pair{formats::ImageFile{folder / "bad.png", nullptr, ""}, "bad.png"},
                                    {{folder / "missing.png", nullptr, ""}, "missing.png"},
                                    {{{}, text, "within"}, "within"}}) {
    strip.attributes.images = {image};
    const app::ModelLooks looks = strip.looks();
    REQUIRE(looks.warnings.size() == 1);
    CHECK(looks.warnings[0].find(name) != std::string::npos);
    CHECK_FALSE(looks.has_looks);
    CHECK(looks.looks.runs.at(0).image == -1);
  }
}

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
