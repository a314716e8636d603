// Captures (Gaussian splats) and point sets in the view.
#include "formats/read.h"
#include "program/command_line.h"
#include "program/small_scene.h"
#include "support/pictures.h"
#include "workspace/open_save.h"

using namespace viete;
using test::Driver;

namespace {

// A ball of flat splats with radius 1: red at the front (z > 0), otherwise green.
document::OpenedSurface capture_of_ball(int subdivisions) {
  mesh::Surface points;
  points.positions = test::ball(1, subdivisions).positions;
  auto splats = std::make_shared<mesh::Splats>();
  const double spacing = std::sqrt(4 * M_PI / static_cast<double>(points.positions.size()));
  const auto log_size = static_cast<float>(std::log(0.6 * spacing));
  for (const mesh::Point& p : points.positions) {
    splats->log_scales.push_back({log_size, log_size, log_size - 2});
    const mesh::Point half{-0.5 * p[1], 0.5 * p[0], 0.5 + 0.5 * p[2]};  // turns z to p
    splats->rotations.push_back(
        {static_cast<float>(half[2]), static_cast<float>(half[0]), static_cast<float>(half[1]), 0});
    splats->opacities.push_back(4);
    const bool front = p[2] > 0;
    splats->colors.push_back({front ? 1.5F : -1.5F, front ? -1.5F : 1.5F, -1.5F});
  }
  document::OpenedSurface opened = document::generated_surface(std::move(points), "capture");
  opened.splats = std::move(splats);
  return opened;
}

struct Scene {
  explicit Scene(document::OpenedSurface&& model, const app::ViewerOptions& options = test::small_options())
      : d(options, test::with_pixels) {
    files::Opened opened;
    opened.document.emplace(std::move(model));
    document::set_cage(*opened.document, document::generated_surface(test::ball(1.2, 1), "cage"));
    workspace::apply_opened(d.workspace(), std::move(opened));
    auto& view = d.workspace().view;
    view.options.panels = view.options.cage = view.options.grid = false;
    d.settle();
  }

  void look(float yaw) {
    auto pose = d.workspace().view.camera.pose();
    pose.yaw = yaw;
    d.workspace().view.camera.set_pose(pose);
    d.frame(3);
  }
  // The numbers of pixels that are mostly red, green and blue.
  std::array<int, 3> colored() {
    const render::Image image = d.picture();
    std::array<int, 3> counts{};
    for (std::size_t i = 0; i < image.rgba.size(); i += 4)
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = [&](std::size_t channel) { return image.rgba[i + channel % 3]; };
        counts[k] += at(k) > 100 && at(k) > 2 * at(k + 1) && at(k) > 2 * at(k + 2) ? 1 : 0;
      }
    return counts;
  }

  Driver d;
};

}  // namespace

TEST_CASE("a_capture_shows_its_colors_from_all_sides_and_hides_what_is_behind") {
  Scene scene(capture_of_ball(4));
  scene.look(0);
  const auto front = scene.colored();
  scene.look(static_cast<float>(M_PI));
  const auto back = scene.colored();
  const auto [most, least] = std::minmax(front[0], front[1], std::greater());
  CHECK(most > 20'000);
  CHECK(least < most / 100);
  CHECK(std::abs(front[0] - back[1]) < most / 50);
  CHECK(std::abs(front[1] - back[0]) < most / 50);
}

TEST_CASE("a_map_colors_a_capture_and_points") {
  document::OpenedSurface plain = capture_of_ball(4);
  plain.splats = nullptr;
  for (document::OpenedSurface& model : std::array{capture_of_ball(4), std::move(plain)}) {
    Scene scene(std::move(model));
    const render::Image without = scene.d.picture();
    auto& positions = scene.d.workspace().document.changed_pose().positions;
    for (mesh::Point& p : positions) p[1] *= 1.3;
    scene.d.workspace().view.options.field = analysis::Field::displacement;
    scene.d.settle();
    scene.d.viewer().finish_views();
    scene.d.frame(3);
    const render::Image with = scene.d.picture();
    CHECK(test::difference(with, without, 30) > 0.1);
    const auto colored = scene.colored();
    CHECK(colored[0] + colored[1] < 50);
  }
}

TEST_CASE("the_cage_is_drawn_over_a_capture_and_a_dragged_vertex_bends_it") {
  Scene scene(capture_of_ball(4));
  scene.look(0);
  const render::Image without = scene.d.picture();
  scene.d.workspace().view.options.cage = true;
  scene.d.frame(3);
  CHECK(test::difference(scene.d.picture(), without, 30) > 0.02);
  scene.d.workspace().view.options.cage = false;
  auto& positions = scene.d.workspace().document.changed_pose().positions;
  for (mesh::Point& p : positions) p[0] *= 1.5;
  scene.d.settle();
  const auto wider = scene.colored();
  CHECK(wider[0] + wider[1] > 25'000);
  CHECK(test::difference(scene.d.picture(), without, 30) > 0.05);
}

TEST_CASE("large_captures_move_with_fewer_splats_and_rest_with_all") {
  auto options = test::small_options();
  options.may_be_coarse = true;
  options.moving_triangles = 24'000;
  Scene scene(capture_of_ball(4), options);
  scene.d.workspace().preferences.coarse_motion = false;
  scene.look(0.1F);
  const auto in_motion = scene.colored();
  CHECK(scene.d.viewer().view_fineness() == app::Fineness::coarse);
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  scene.d.frame(6);
  CHECK(scene.d.viewer().view_fineness() == app::Fineness::plain);
  const auto at_rest = scene.colored();
  CHECK(in_motion != at_rest);
  CHECK(std::abs(in_motion[0] + in_motion[1] - at_rest[0] - at_rest[1]) < 0.2 * (at_rest[0] + at_rest[1]));
}

TEST_CASE("points_are_discs_with_the_colors_of_the_file") {
  for (const bool colored : {true, false}) {
    document::OpenedSurface points = capture_of_ball(5);
    points.splats = nullptr;
    auto attributes = std::make_shared<formats::Attributes>();
    for (const mesh::Point& p : points.surface->positions)
      attributes->colors.push_back(p[2] > 0 ? formats::Color{1, 0, 0, 1} : formats::Color{0, 1, 0, 1});
    if (colored) points.attributes = std::move(attributes);
    Scene scene(std::move(points));
    scene.look(0);
    const auto [red, green, blue] = scene.colored();
    CHECK(std::min(red, green) < 2000);
    CHECK(blue == 0);
    if (colored) CHECK(std::max(red, green) > 40'000);
    if (!colored) CHECK(red + green == 0);
    const render::Image with = scene.d.picture();
    scene.d.workspace().view.options.model = false;
    scene.d.frame(2);
    CHECK(test::difference(with, scene.d.picture(), 8) > 0.08);
  }
}

TEST_CASE("a_capture_is_drawn_side_by_side_and_has_a_shadow") {
  Scene scene(capture_of_ball(4));
  auto& w = scene.d.workspace();
  w.view.options.grid = true;
  scene.look(0);
  const auto one = scene.colored();
  workspace::put_side_views(w.view.split,
                            {.sides = {{w.document.deformer(), w.document.method(), {}}}, .cameras = {}});
  scene.d.settle();
  const auto two = scene.colored();
  CHECK(two[0] + two[1] > 0.4 * (one[0] + one[1]));
}

TEST_CASE("points_of_a_file_are_drawn_with_their_colors") {
  test::TemporaryFolder folder;
  std::string text =
      "ply\nformat ascii 1.0\nelement vertex 400\nproperty float x\nproperty float y\n"
      "property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nend_header\n";
  for (int i = 0; i < 400; ++i)
    text +=
        std::to_string(i % 20) + ' ' + std::to_string(i / 20) + ' ' + std::to_string(i % 7) + " 0 0 255\n";
  Driver d(test::small_options(), test::with_pixels);
  test::put_file(folder / "points.ply", text);
  REQUIRE(d.open({folder / "points.ply"}));
  d.workspace().view.options.panels = false;
  d.settle();
  const render::Image image = d.picture();
  std::size_t blue = 0;
  for (std::size_t i = 0; i < image.rgba.size(); i += 4)
    blue += image.rgba[i] < 10 && image.rgba[i + 1] < 10 && image.rgba[i + 2] > 250 ? 1 : 0;
  CHECK(blue > 400 * 10);
}

TEST_CASE("an_opened_capture_follows_the_mouse_and_its_export_is_that_of_viete_deform") {
  const test::TemporaryFolder folder;
  for (const char* name : {"capture.ply", "capture.spz"}) {
    INFO(name);
    const document::OpenedSurface ball = capture_of_ball(3);
    const mesh::Surface& points = *ball.surface;
    formats::write(folder / name, {points, points.positions, {}, nullptr, ball.splats.get()}, nullptr, {});
    formats::write(folder / "cage.obj", test::ball(1.2, 1));
    Driver d(test::small_options());
    REQUIRE(d.open({folder / name, folder / "cage.obj"}));
    d.settle();
    const std::uint32_t v = d.free_vertex();
    d.drag(d.vertex(v), d.vertex(v) + glm::vec2(40, 25));
    d.settle();
    REQUIRE(d.moved().size() == 1);
    const auto proposed = [&](const char* command) {
      d.run(command);
      d.workspace().files.browser.open = false;
      d.frame();
      return std::filesystem::path(d.workspace().files.browser.suggested);
    };
    CHECK(proposed("save_model").extension() == std::filesystem::path(name).extension());
    d.run("set_key");
    CHECK(proposed("save_animation") == "capture_####" + std::filesystem::path(name).extension().string());
    const auto posed = folder / (std::string("posed_") + name), deformed = folder / name;
    d.save(workspace::SaveFile::Content::model, posed);
    REQUIRE(workspace::save_session(d.workspace(), folder / "s.viete"));
    const auto same = folder / (std::string("same_") + name);
    const test::Outcome outcome =
        test::run("deform " + test::quoted(folder / "s.viete") + " -o " + test::quoted(same));
    INFO(outcome.text);
    CHECK(outcome.code == 0);
    CHECK(test::file_bytes(same) == test::file_bytes(posed));
    CHECK(test::file_bytes(posed) != test::file_bytes(folder / name));
    const auto cache = test::run("animate " + test::quoted(folder / "s.viete") + " --force -o " +
                                 test::quoted(folder / "a.pc2"));
    CHECK(test::mentions(cache, "left out of the point cache: sizes, rotations"));
  }
}

TEST_CASE("splats_under_the_mouse_are_inspected_painted_and_probed") {
  Scene scene(capture_of_ball(4));
  auto& w = scene.d.workspace();
  w.view.options.panels = true;
  scene.look(0);
  scene.d.settle();
  const glm::vec2 middle = w.view.camera.viewport.middle();
  const auto& positions = w.document.model().surface->positions;
  const mesh::Point toward = w.document.space().to_file(glm::dvec3(w.view.camera.eye()));
  const auto is_in_front = [&](const mesh::Point& p) {
    return mesh::dot(p, toward) > 0.99 * mesh::norm(p) * mesh::norm(toward);
  };
  scene.d.move(middle);
  scene.d.run("pick_vertex");
  REQUIRE(w.view.vertex.vertex);
  CHECK(is_in_front(positions[*w.view.vertex.vertex]));
  scene.d.run("add_probe");
  REQUIRE(w.document.probes().all.size() == 1);
  CHECK(is_in_front(w.document.probes().all[0].place));
  scene.d.run("tool_paint");
  scene.d.drag(middle, middle + glm::vec2(3, 0));
  REQUIRE(w.document.mask());
  for (std::size_t v = 0; v < positions.size(); ++v)
    if ((*w.document.mask())[v] == 0) CHECK(mesh::dot(positions[v], toward) > 0);
}

TEST_CASE("maps_of_surfaces_are_not_available_for_captures_and_maps_of_matrices_are_complete") {
  Scene scene(capture_of_ball(3));
  auto& w = scene.d.workspace();
  w.document.put_mask(
      std::make_shared<const std::vector<float>>(w.document.model().surface->positions.size(), 0.5F));
  for (mesh::Point& p : w.document.changed_pose().positions) p[1] *= 1.3;
  using analysis::Field;
  for (const Field field :
       {Field::volume, Field::gap, Field::exp_error, Field::frame_error, Field::displacement}) {
    INFO(base::entry_of(field).word);
    w.view.options.field = field;
    scene.d.settle();
    scene.d.viewer().finish_views();
    scene.d.frame(3);
    const auto& shown = w.view.split.views[0].shown;
    REQUIRE(shown.values);
    CHECK(shown.values->size() == w.document.model().surface->positions.size());
  }
  CHECK(w.view.split.views[0].shown.stats.most > 0.01);
  for (const Field field : {Field::area, Field::energy, Field::signed_difference}) {
    w.view.options.field = field;
    CHECK(workspace::shown_field(w) == Field::none);
  }
  w.view.options.field = Field::none;
}

TEST_CASE("commands_that_need_faces_are_disabled_for_captures") {
  Scene scene(capture_of_ball(3));
  const auto& w = scene.d.workspace();
  for (const char* command :
       {"add_pin", "import_shapes", "toggle_wireframe", "shading_zebra", "next_shading"})
    CHECK_FALSE(workspace::find_command(command)->enabled(w));
  for (const char* command : {"add_probe", "tool_paint", "save_model", "pick_vertex", "import_animation"})
    CHECK(workspace::find_command(command)->enabled(w));
}

TEST_CASE("a_probe_without_a_cage_turns_splats_in_the_view_and_in_the_export") {
  const test::TemporaryFolder folder;
  const document::OpenedSurface ball = capture_of_ball(3);
  const mesh::Surface& points = *ball.surface;
  formats::write(folder / "capture.ply", {points, points.positions, {}, nullptr, ball.splats.get()}, nullptr,
                 {});
  Driver d(test::small_options(), test::with_pixels);
  REQUIRE(d.open({folder / "capture.ply"}));
  d.run("add_probe");
  d.workspace().view.options.panels = d.workspace().view.options.cage = false;
  d.settle();
  const render::Image before = d.picture();
  auto& pose = d.document().changed_probes().all[0].pose;
  pose.turn = {0, 0, 1};
  pose.move = {0, 0.3, 0};
  d.settle();
  CHECK(test::difference(d.picture(), before, 30) > 0.001);
  d.save(workspace::SaveFile::Content::model, folder / "posed.ply");
  const formats::ReadResult posed = formats::read(folder / "posed.ply");
  REQUIRE(posed.splats);
  const auto& rotations = posed.splats->rotations;
  std::size_t turned = 0;
  for (std::size_t v = 0; v < rotations.size(); ++v)
    turned += rotations[v] != ball.splats->rotations[v] ? 1 : 0;
  CHECK(turned > rotations.size() / 100);
  CHECK(turned < rotations.size());
}

TEST_CASE("timings_of_all_methods_contain_the_splats") {
  auto options = test::small_options();
  options.probe = true;
  Scene scene(capture_of_ball(3), options);
  auto& w = scene.d.workspace();
  w.view.options.panels = true;
  for (mesh::Point& p : w.document.changed_pose().positions) p[1] *= 1.3;
  const auto& times = w.frame.method_times;
  REQUIRE(scene.d.until([&] { return times.measured; }));
  for (const std::size_t i : {std::size_t(0), std::size_t(workspace::MethodTimes::fused)})
    CHECK(times.stages[i][workspace::Stage::splats] > 0);
}
