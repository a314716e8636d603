// The viewer with real events: drags, clicks, undo, broken files.
#include <cmath>
#include <fstream>

#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "program/kept_work.h"
#include "scene/document/edit.h"
#include "scene/document/pose_edit.h"
#include "scene/hand/cursor_projection.h"
#include "scene/workspace/choice_commands.h"
#include "support/commands.h"
#include "support/edits.h"
#include "support/pictures.h"

using namespace viete;
using test::Driver;

namespace {

bool finite(const std::vector<mesh::Point>& points) {
  for (const auto& p : points) {
    for (const double x : p) {
      if (!std::isfinite(x)) return false;
    }
  }
  return true;
}

double largest_distance(const std::vector<mesh::Point>& a, const std::vector<mesh::Point>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    largest = std::max(largest, std::hypot(a[i][0] - b[i][0], a[i][1] - b[i][1], a[i][2] - b[i][2]));
  }
  return largest;
}

double diagonal(Driver& d) {
  return 2 / d.document().space.scale;
}

// In double; the displayed floats agree with it.
std::vector<mesh::Point> positions(Driver& d) {
  auto exact = d.exact_positions();
  const auto shown = d.viewer().deformer()->positions();
  CHECK(largest_distance({shown.begin(), shown.end()}, exact) < 2e-5 * diagonal(d));
  return exact;
}

// The number of model vertices that move with a cage vertex.
std::size_t followers(Driver& d) {
  const auto& rest = d.document().model.surface->positions;
  deform::Pose pose = deform::rest_pose(*d.document().cage);
  pose.positions[0][1] += 0.1 * diagonal(d);
  scene::set_pose(d.document(), pose);
  d.frame();
  const auto moved = positions(d);
  std::size_t count = 0;
  for (std::size_t i = 0; i < rest.size(); ++i) {
    count += std::hypot(moved[i][0] - rest[i][0], moved[i][1] - rest[i][1], moved[i][2] - rest[i][2]) >
             1e-9 * diagonal(d);
  }
  return count;
}

}  // namespace

TEST_CASE("settings_made_before_anything_is_open_are_kept_for_what_is_opened") {
  Driver d;
  test::run_command(d.workspace(), "weights_mean_value");
  scene::set_radius(d.document(), 0.3);
  d.frame(3);  // an empty scene
  d.open_dragon();
  CHECK(d.document().scheme.weighting.weights == deform::Weights::mean_value);
  CHECK(d.document().scheme.weighting.radius == 0.3);
  CHECK(d.viewer().deformer()->state().rows().form == deform::RowForm::positions);
}

TEST_CASE("a_cage_vertex_is_dragged_and_the_mesh_follows_in_the_same_frame") {
  Driver d(test::with_pixels);
  d.open_dragon();
  const auto rest = positions(d);
  CHECK(largest_distance(rest, d.document().model.surface->positions) < 1e-13 * diagonal(d));
  const auto picture_before = d.picture();

  const auto v = d.free_vertex();
  const glm::vec2 from = glm::round(d.vertex(v)), to = from + glm::vec2(60, -50);
  const glm::vec2 offset = d.vertex(v) - from;
  d.press_and_move(from, to);
  const auto during = positions(d);
  CHECK_MESSAGE(largest_distance(rest, during) > 0.005 * diagonal(d),
                "the mesh moved before the button was released");
  CHECK(glm::distance(d.vertex(v), to + offset) < 0.05f);
  d.button(0, false);
  d.frame(2);
  CHECK(finite(positions(d)));
  CHECK(test::edit_count(d.document().history) == 1);

  // Mesh pixels change around the projected positions of the vertex that moved farthest.
  const auto after = positions(d);
  std::size_t farthest = 0;
  const auto shift = [&](std::size_t i) {
    return std::hypot(after[i][0] - rest[i][0], after[i][1] - rest[i][1], after[i][2] - rest[i][2]);
  };
  for (std::size_t i = 0; i < after.size(); ++i) {
    if (shift(i) > shift(farthest)) farthest = i;
  }
  const scene::Projector project(d.document().space, d.workspace().camera, d.workspace().viewport);
  const glm::vec2 at(*project(after[farthest]));
  const auto picture = d.picture();
  int changed = 0;
  for (int dy = -12; dy <= 12; ++dy) {
    for (int dx = -12; dx <= 12; ++dx) {
      const int x = static_cast<int>(at.x) + dx, y = static_cast<int>(at.y) + dy;
      changed += picture.pixel(x, y) != picture_before.pixel(x, y);
    }
  }
  CHECK(changed > 20);
}

TEST_CASE("the_four_methods_are_clicked_and_agree") {
  Driver d(test::with_pixels);
  d.open_dragon();
  const auto v = d.free_vertex();
  d.drag(glm::round(d.vertex(v)), glm::round(d.vertex(v)) + glm::vec2(50, 40));
  d.move({700, 20});
  d.frame(3);
  d.click("method_fast");
  d.move({700, 20});
  d.frame(2);
  const auto reference = positions(d);
  const auto picture = d.picture();
  // Bounds: Diag is exact up to rounding, and Fast has compressed weights; SD loses up to 1e-4 for clustered
  // eigenvalues, which dominate near rest.
  const struct {
    const char* widget;
    sym3::Method method;
    double bound;
  } cases[] = {{"method_diag", sym3::Method::diag, 2e-5},
               {"method_sd", sym3::Method::sd, 2e-4},
               {"method_improved_sd", sym3::Method::improved_sd, 2e-4},
               {"method_fast", sym3::Method::fast, 0}};
  for (const auto& c : cases) {
    d.click(c.widget);
    CHECK(d.document().method == c.method);
    d.move({700, 20});
    d.settle();
    CHECK(d.viewer().deformer()->engine(c.method) ==
          (c.method == sym3::Method::fast ? deform::EngineKind::fused : deform::EngineKind::staged));
    const auto now = positions(d);
    CHECK(finite(now));
    CHECK_MESSAGE(largest_distance(now, reference) <= c.bound * diagonal(d), c.widget);
    int differing = 0;
    const auto now_picture = d.picture();
    for (int y = 40; y < 760; ++y) {
      for (int x = 400; x < 940; ++x) {  // the view only
        const auto a = picture.pixel(x, y), b = now_picture.pixel(x, y);
        for (int i = 0; i < 3; ++i) differing += std::abs(a[i] - b[i]) > 8;
      }
    }
    CHECK_MESSAGE(differing < 950, c.widget);
  }
}

TEST_CASE("undo_redo_and_cancel_by_keys_restore_exactly") {
  Driver d;
  d.open_dragon();
  const auto rest = d.document().pose.positions;
  const auto v = d.free_vertex();
  const glm::vec2 at = glm::round(d.vertex(v));
  d.drag(at, at + glm::vec2(40, 30));
  const auto moved = d.document().pose.positions;
  CHECK(moved != rest);
  d.press_key(scene::key('Z'), true);
  CHECK(d.document().pose.positions == rest);
  d.press_key(scene::key('Z'), true, true);
  CHECK(d.document().pose.positions == moved);
  const auto mesh_before = positions(d);
  const glm::vec2 again = glm::round(d.vertex(v));
  d.press_and_move(again, again + glm::vec2(-70, 20));
  d.press_key(scene::Key::escape);
  d.button(0, false);
  d.frame();
  CHECK(d.document().pose.positions == moved);
  CHECK(positions(d) == mesh_before);
  CHECK(test::edit_count(d.document().history) == 1);
  d.run("undo");
  CHECK(d.document().pose.positions == rest);
  d.run("redo");
  d.run("reset_pose");
  CHECK(d.document().pose.positions == rest);
}

TEST_CASE("a_broken_file_is_refused_through_the_file_panel_and_the_document_stays") {
  Driver d;
  d.open_dragon();
  const auto v = d.free_vertex();
  const glm::vec2 at = glm::round(d.vertex(v));
  d.drag(at, at + glm::vec2(20, 20));
  const auto pose = d.document().pose.positions;
  const auto mesh_before = positions(d);
  const auto broken = std::filesystem::temp_directory_path() / "viete-broken-program.obj";
  std::ofstream(broken) << "v 0 0 0\nv 1 0 0\nf 1 2 9\n";

  d.press_key(scene::key('O'), true);
  d.frame(2);
  REQUIRE(d.workspace().browser.open);
  d.click("file_path");
  d.press_key('A', true);
  d.type(broken.string());
  d.press_key(257);
  d.settle();
  CHECK(d.workspace().browser.open);
  CHECK(d.document().pose.positions == pose);
  CHECK(positions(d) == mesh_before);
  CHECK_MESSAGE(d.workspace().browser.problem.find("viete-broken-program.obj:3") != std::string::npos,
                d.workspace().browser.problem);
  std::filesystem::remove(broken);
}

TEST_CASE("a_path_typed_where_the_keyboard_is_opens_it") {
  Driver d;
  d.open_dragon();
  const auto cage = test::assets_dir() / "dragon" / "cage.obj";
  d.press_key(scene::key('O'), true);
  d.frame(2);
  REQUIRE(d.workspace().browser.open);
  d.type(cage.string());
  d.press_key(257);
  d.settle();
  CHECK_FALSE(d.workspace().browser.open);
  CHECK(d.document().model.path == cage);
}

TEST_CASE("the_first_enter_does_not_replace_a_file") {
  Driver d;
  d.open_dragon();
  const auto file = std::filesystem::temp_directory_path() / "viete-kept-program.obj";
  std::ofstream(file) << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  d.press_key(scene::key('E'), true);
  d.frame(2);
  REQUIRE(d.workspace().browser.open);
  d.press_key('A', true);
  d.type(file.string());
  d.press_key(257);
  d.frame(3);
  CHECK(d.workspace().browser.open);
  CHECK(std::filesystem::file_size(file) == 32);
  d.press_key(257);
  d.settle();
  CHECK_FALSE(d.workspace().browser.open);
  CHECK(std::filesystem::file_size(file) > 1000);
  std::filesystem::remove(file);
}

TEST_CASE("a_model_of_any_size_looks_the_same") {
  std::vector<render::Image> pictures;
  for (const double scale : {1.0, 1e30, 1e-30}) {
    auto cage = mesh::read(test::assets_dir() / "dragon" / "cage.obj").surface;
    for (auto& p : cage.positions) {
      for (double& x : p) x *= scale;
    }
    const auto file = std::filesystem::temp_directory_path() / "viete-sized-program.obj";
    mesh::write(file, cage);
    Driver d(test::with_pixels);
    d.workspace().view.panels = d.workspace().view.hints = d.workspace().view.grid = false;
    REQUIRE(d.open({file}));
    d.settle();
    pictures.push_back(d.picture());
    std::filesystem::remove(file);
  }
  CHECK(test::difference(pictures[0], pictures[1], 8) < 0.002);
  CHECK(test::difference(pictures[0], pictures[2], 8) < 0.002);
}

TEST_CASE("a_deformer_is_one_choice_with_its_parts_folded") {
  Driver d;
  d.open_dragon();
  const auto& scheme = d.document().scheme;
  CHECK(deform::way_of(scheme) == deform::Way::paper);  // default in these tests
  CHECK_FALSE(d.viewer().recorder().find("weights"));
  for (const auto& way : deform::all_ways()) {
    CAPTURE(way.name);
    d.choose("way", scene::choice_command_name(way.value));
    d.settle();
    CHECK(scheme == way.scheme);
    CHECK(d.viewer().deformer()->scheme() == scheme);
    CHECK(d.viewer().recorder().find("radius").has_value() == (way.value == deform::Way::local));
    CHECK_FALSE(d.viewer().recorder().find("weights"));
  }
  CHECK(test::edit_count(d.document().history) == deform::all_ways().size());
  d.click("section/Custom deformer");
  d.frame(2);
  d.choose("blend", "blend_linear");
  d.settle();
  CHECK_FALSE(deform::way_of(scheme));
  CHECK(scheme.weighting.weights == deform::Weights::cut_off);  // as in Local
}

TEST_CASE("mean_value_coordinates_are_chosen_and_the_method_says_not_used") {
  Driver d;
  d.open_dragon();
  d.choose("weights", "weights_mean_value");
  d.settle();
  REQUIRE(d.viewer().deformer());
  CHECK(d.viewer().deformer()->sample_matrices(10).empty());
  d.place_of("method_diag");
  CHECK_FALSE(d.viewer().recorder().find("method_diag")->enabled);
  CHECK(largest_distance(positions(d), d.document().model.surface->positions) < 1e-6 * diagonal(d));
  d.choose("blend", "blend_srl");
  d.settle();
  CHECK_FALSE(d.viewer().deformer()->sample_matrices(10).empty());
}

TEST_CASE("cut_off_weights_have_a_radius_and_others_have_none") {
  Driver d;
  d.open_dragon();
  d.choose("weights", "weights_cutoff");
  d.settle();
  d.click("radius");  // in its center
  d.settle();
  const deform::Weighting& weighting = d.document().scheme.weighting;
  CHECK(weighting.radius > 0.05);
  CHECK(weighting.radius < 0.25);
  const auto partly = followers(d);
  scene::set_radius(d.document(), 0.03);
  d.settle();
  CHECK(followers(d) < partly);
  CHECK(d.viewer().deformer()->scheme().weighting == weighting);
  d.choose("weights", "weights_biharmonic");
  d.settle();
  CHECK_FALSE(d.viewer().recorder().find("radius"));
}

TEST_CASE("turn_and_stretch_slide_and_the_model_follows_and_points_have_neither") {
  Driver d;
  d.open_dragon();
  d.document().changed_pose().positions[20][1] += 0.3 * diagonal(d);
  d.settle();
  const auto whole = positions(d);
  const auto low_end = [&](const char* slider) {
    const auto place = d.place_of(slider);
    d.click(glm::vec2(place.x - 40, place.y));
  };
  low_end("stretch");
  d.settle();
  const double stretch = d.document().scheme.amounts.stretch;
  CHECK(stretch < 1);
  CHECK(d.document().scheme.amounts.turn == 1);
  CHECK(largest_distance(positions(d), whole) > 1e-4 * diagonal(d));
  scene::undo(d.document());
  d.settle();
  CHECK(d.document().scheme.amounts.whole());
  CHECK(largest_distance(positions(d), whole) == 0);
  d.choose("weights", "weights_mean_value");
  d.settle();
  d.place_of("turn");
  CHECK_FALSE(d.viewer().recorder().find("turn")->enabled);
}

TEST_CASE("the_camera_answers_wheel_middle_drag_and_keys") {
  Driver d;
  d.open_dragon();
  const auto start = d.workspace().camera.pose();
  d.move({800, 400});
  d.wheel(2);
  CHECK(d.workspace().camera.pose().distance < start.distance);
  d.drag({800, 100}, {860, 130}, 2);
  CHECK(d.workspace().camera.pose().yaw != start.yaw);
  d.press_key(scene::Key::home);
  d.settle();
  for (std::uint32_t v = 0; v < d.document().pose.positions.size(); ++v) {
    const glm::vec2 at = d.vertex(v);
    CHECK_MESSAGE((at.x > 320 && at.x < 1280 && at.y > 0 && at.y < 774), "after Home all is in view");
  }
  d.press_key(scene::Key::pad3);
  d.settle();
  CHECK(d.workspace().camera.forward().x == doctest::Approx(-1));
}

TEST_CASE("the_wheel_over_the_panels_scrolls_them_and_not_the_camera") {
  Driver d;
  d.open_dragon();
  const auto start = d.workspace().camera.pose();
  d.move({160, 500});
  d.wheel(-3);
  d.drag({160, 300}, {160, 340}, 2);
  CHECK(d.workspace().camera.pose() == start);
}

TEST_CASE("the_methods_are_measured_in_the_background_and_shown") {
  auto options = Driver::default_options();
  options.probe = true;
  Driver d(options);
  d.open_dragon();
  REQUIRE(d.until([&] { return d.workspace().methods.matrices > 0; }));
  const auto& stats = d.workspace().methods;
  REQUIRE(stats.matrices == 2048);
  for (const auto& sample : stats.samples) CHECK(sample.ns_per_matrix > 0);
  CHECK(stats.samples[3].worst_error < 1e-14);
}

TEST_CASE("the_measured_error_is_of_the_frame_that_is_shown_whatever_it_blends") {
  auto options = Driver::default_options();
  options.probe = true;
  const test::TemporaryFolder folder;
  mesh::write(folder / "ball.ply",
              test::SmallModel::grid_ball(40));  // binding all schemes to the dragon takes long
  mesh::write(folder / "cage.obj", test::SmallModel::scaled(test::SmallModel::grid_ball(2), 1.4));
  Driver d(options);
  REQUIRE(d.open({folder / "ball.ply", folder / "cage.obj"}));
  for (const deform::Scheme& scheme : deform::valid_schemes()) {
    if (scheme.weighting.weights != deform::Weights::inverse) continue;  // half a second each
    CAPTURE(text(scheme));
    scene::set_scheme(d.document(), scheme);
    d.settle();
    const double error = d.viewer().deformer()->sampled_error();
    CHECK(error > 0);
    CHECK(d.until([&] { return d.workspace().fused_error == error; }));
  }
}
