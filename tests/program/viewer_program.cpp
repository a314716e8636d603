// The viewer with simulated events: drags, methods, deformers, files and the camera.

#include "document/edit.h"
#include "document/pose_edit.h"
#include "formats/read.h"
#include "formats/write.h"
#include "program/kept_work.h"
#include "program/small_scene.h"
#include "support/commands.h"
#include "support/edits.h"
#include "support/pictures.h"
#include "workspace/command_tables.h"

using namespace viete;
using test::Dragon, test::Driver, test::largest_distance;

namespace {

double diagonal(Driver& d) {
  return 2 / d.document().space().scale;
}

const std::vector<mesh::Point>& rest_of(Driver& d) {
  return d.document().model().surface->positions;
}

glm::vec2 empty_place(Driver& d) {
  const auto& v = d.workspace().view.camera.viewport;
  return v.origin + glm::vec2(0.5f * v.size.x, v.size.y - 70);
}

}  // namespace

TEST_CASE("the_viewer_rests_with_a_cage_without_one_and_with_nothing_open") {
  Driver d;
  const auto rests = [&] {
    d.settle();
    d.frame(5);
    return !d.viewer().wants_frame();
  };
  CHECK(rests());
  REQUIRE(d.open({test::dragon}));
  CHECK(rests());
  d.open_dragon();
  CHECK(rests());
}

TEST_CASE("settings_made_before_anything_is_open_apply_to_the_next_model") {
  Driver d;
  test::run_command(d.workspace(), "weights_mean_value");
  document::set_radius(d.document(), 0.3);
  d.frame(3);  // the scene is empty
  d.open_dragon();
  CHECK(d.document().deformer().weighting.weights == pose::Weights::mean_value);
  CHECK(d.document().deformer().weighting.radius == 0.3);
  CHECK(d.viewer().deformer()->state().rows().form == pose::RowForm::positions);
}

TEST_CASE("a_cage_vertex_is_dragged_and_the_mesh_follows_in_the_same_frame") {
  Dragon d("", test::with_pixels);
  const auto rest = d.checked_positions();
  CHECK(largest_distance(rest, rest_of(d)) < 1e-13 * diagonal(d));
  const auto picture_before = d.picture();

  const auto v = d.free_vertex();
  const glm::vec2 from = glm::round(d.vertex(v)), to = from + glm::vec2(60, -50);
  const glm::vec2 offset = d.vertex(v) - from;
  d.press_and_move(from, to);
  CHECK_MESSAGE(largest_distance(rest, d.checked_positions()) > 0.005 * diagonal(d),
                "the mesh moved before the button was released");
  CHECK(glm::distance(d.vertex(v), to + offset) < 0.05f);
  d.button(0, false);
  d.frame(2);
  CHECK(test::edit_count(d.document().history()) == 1);
  CHECK_FALSE(d.workspace().view.options.hints);

  // Pixels have changed around the vertex that moved farthest.
  const auto after = d.checked_positions();
  std::size_t farthest = 0;
  const auto shift = [&](std::size_t i) { return mesh::norm(after[i] - rest[i]); };
  for (std::size_t i = 0; i < after.size(); ++i)
    if (shift(i) > shift(farthest)) farthest = i;
  const glm::ivec2 at(d.on_screen(after[farthest]));
  const auto picture = d.picture();
  int changed = 0;
  for (int y = at.y - 12; y <= at.y + 12; ++y)
    for (int x = at.x - 12; x <= at.x + 12; ++x) changed += picture.pixel(x, y) != picture_before.pixel(x, y);
  CHECK(changed > 20);
}

TEST_CASE("the_four_methods_are_clicked_and_agree") {
  Dragon d;
  const auto v = d.free_vertex();
  d.drag(glm::round(d.vertex(v)), glm::round(d.vertex(v)) + glm::vec2(50, 40));
  const auto reference = d.checked_positions();
  // If eigenvalues are close, SD has errors up to 1e-4. Close eigenvalues are common near the rest pose.
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
    CHECK(d.document().method() == c.method);
    d.settle();
    CHECK(d.viewer().deformer()->engine(c.method) ==
          (c.method == sym3::Method::fast ? pose::EngineKind::fused : pose::EngineKind::staged));
    CHECK_MESSAGE(largest_distance(d.checked_positions(), reference) <= c.bound * diagonal(d), c.widget);
  }
}

TEST_CASE("a_model_of_any_size_looks_the_same") {
  const test::TemporaryFolder folder;
  std::vector<render::Image> pictures;
  for (const double scale : {1.0, 1e30, 1e-30}) {
    auto cage = formats::read(test::dragon_cage).surface;
    for (auto& p : cage.positions) p = {scale * p[0], scale * p[1], scale * p[2]};
    formats::write(folder / "cage.obj", cage);
    Driver d(Driver::default_options({400, 300}), test::with_pixels);
    d.workspace().view.options.panels = d.workspace().view.options.hints = d.workspace().view.options.grid =
        false;
    REQUIRE(d.open({folder / "cage.obj"}));
    d.settle();
    pictures.push_back(d.picture());
  }
  CHECK(test::difference(pictures[0], pictures[1], 8) < 0.002);
  CHECK(test::difference(pictures[0], pictures[2], 8) < 0.002);
}

TEST_CASE("a_deformer_is_one_choice_with_its_parts_folded") {
  test::SmallScene small(Driver::default_options());
  Driver& d = small.d;
  const auto shows = [&](const char* widget) { return d.recorder().find(widget).has_value(); };
  const auto& deformer = d.document().deformer();
  for (const auto preset : base::all_values<pose::Preset>()) {
    CAPTURE(base::entry_of(preset).word);
    d.choose("deformer", workspace::choice_command_name(preset));
    d.settle();
    CHECK(deformer == pose::deformer_of(preset));
    CHECK(d.viewer().deformer()->deformer() == deformer);
    CHECK(shows("radius") == (preset == pose::Preset::local));
    CHECK_FALSE(shows("weights"));
  }
  CHECK(test::edit_count(d.document().history()) == choices(pose::Preset{}).size());
  d.click("section/Custom deformer");
  d.choose("blend", "blend_linear");
  d.settle();
  CHECK_FALSE(pose::preset_of(deformer));
  CHECK(deformer.weighting.weights == pose::Weights::cut_off);  // as in the deformer Local
}

TEST_CASE("weights_enable_the_settings_that_apply_to_them") {
  test::SmallScene small(Driver::default_options());
  Driver& d = small.d;
  const auto is_enabled = [&](const char* widget) {
    d.place_of(widget);
    return d.recorder().find(widget)->enabled;
  };
  d.choose("weights", "weights_mean_value");
  d.settle();
  CHECK(d.viewer().deformer()->sample_matrices(10).empty());
  CHECK_FALSE(is_enabled("method_diag"));
  CHECK_FALSE(is_enabled("rotation"));
  CHECK(largest_distance(d.checked_positions(), rest_of(d)) < 1e-6 * diagonal(d));
  d.choose("blend", "blend_srl");
  d.settle();
  CHECK(is_enabled("method_diag"));
  d.choose("weights", "weights_cutoff");
  d.settle();
  d.click("radius");  // a click in the center sets the middle value
  d.settle();
  const pose::Weighting& weighting = d.document().deformer().weighting;
  CHECK(weighting.radius > 0.05);
  CHECK(weighting.radius < 0.25);
  d.choose("weights", "weights_biharmonic");
  d.settle();
  CHECK_FALSE(d.recorder().find("radius"));
}

TEST_CASE("the_camera_follows_wheel_middle_drag_and_keys_and_panels_keep_their_own") {
  Dragon d;
  const auto start = d.workspace().view.camera.pose();
  d.move({160, 500});  // the pointer is over a panel
  d.wheel(-3);
  d.drag({160, 300}, {160, 340}, 2);
  CHECK(d.workspace().view.camera.pose() == start);
  d.move({800, 400});
  d.wheel(2);
  CHECK(d.workspace().view.camera.pose().distance < start.distance);
  d.drag({800, 100}, {860, 130}, 2);
  CHECK(d.workspace().view.camera.pose().yaw != start.yaw);
  d.press_key(workspace::Key::home);
  d.settle();
  for (std::uint32_t v = 0; v < d.document().pose().positions.size(); ++v) {
    const glm::vec2 at = d.vertex(v);
    CHECK_MESSAGE((at.x > 320 && at.x < 1280 && at.y > 0 && at.y < 774), "after Home all is in view");
  }
}

TEST_CASE("methods_and_the_error_of_the_frame_are_measured_in_the_background") {
  auto options = Driver::default_options();
  options.probe = true;
  test::SmallScene small(options);
  Driver& d = small.d;
  REQUIRE(d.until([&] { return d.workspace().frame.methods.matrices > 0; }));
  const auto& stats = d.workspace().frame.methods;
  for (const auto& sample : stats.samples) CHECK(sample.ns_per_matrix > 0);
  CHECK(stats.samples[3].worst_error < 1e-14);
  for (const auto preset : base::all_values<pose::Preset>()) {
    CAPTURE(base::entry_of(preset).word);
    document::set_deformer(d.document(), pose::deformer_of(preset));
    d.settle();
    const double error = d.viewer().deformer()->sampled_error();
    CHECK(error > 0);
    CHECK(d.until([&] { return d.workspace().view.split.views[0].fused_error == error; }));
  }
}

TEST_CASE("a_new_model_starts_with_the_first_view_and_without_mirror_and_pivot_of_the_last_one") {
  const test::TemporaryFolder folder;
  Dragon d;
  d.drag(empty_place(d), empty_place(d) + glm::vec2(150, 60), 2);
  document::Handling& hand = d.workspace().view.handling;
  hand.mirror = document::MirrorPlane::x;
  hand.pivot = document::Pivot::point;
  hand.point = mesh::Point{0.25, 1, -3};
  d.workspace().messages.warn("The cage is open", {.scope = workspace::Scope::cage});
  d.frame();
  REQUIRE(d.open({test::dragon_cage}, Driver::What::cage));
  d.frame(2);
  for (const auto& m : d.workspace().messages.all()) CHECK(m.text != "The cage is open");
  CHECK(hand.mirror == document::MirrorPlane::x);
  formats::write(folder / "cube.obj", formats::read(test::dragon_cage).surface);
  REQUIRE(d.open({folder / "cube.obj"}));
  d.frame(3);
  const document::CameraPose home, now = d.workspace().view.camera.pose();
  CHECK(now.yaw == doctest::Approx(home.yaw));
  CHECK(now.pitch == doctest::Approx(home.pitch));
  CHECK(hand.mirror == document::MirrorPlane::none);
  CHECK(hand.pivot == document::Pivot::median);
  CHECK_FALSE(hand.point);
}
