// Maps on the mesh, split views, and times of methods.
#include <cmath>
#include <set>

#include "document/edit.h"
#include "document/pose_edit.h"
#include "document/probes.h"
#include "formats/write.h"
#include "pose/deformer.h"
#include "pose/pose_file.h"
#include "program/small_scene.h"
#include "support/folder.h"
#include "support/pictures.h"
#include "workspace/workspace.h"

using namespace viete;
using analysis::Field;
using test::Dragon, test::Driver;

namespace {

void choose_map(Driver& d, const char* word) {
  if (!d.recorder().find("map")) d.click("section/Map");
  d.choose("map", std::string("map_") + word);
  d.settle();
}

// Returns the vertices of the active view.
std::vector<mesh::Point> shown(Driver& d) {
  std::vector<mesh::Point> points;
  for (std::size_t v = 0; v < d.document().model().surface->positions.size(); ++v)
    points.push_back(d.workspace().frame.posed.at(*d.document().model().surface, v));
  return points;
}

// Returns the largest distance between corresponding points, in diagonals of the model.
double apart(Driver& d, const std::vector<mesh::Point>& a, const std::vector<mesh::Point>& b) {
  return test::largest_distance(a, b) / d.document().model().bounds.diagonal();
}

// Returns the largest error of a view's vertices against double precision, in diagonals of the model.
double error_of_side(Driver& d, std::size_t side) {
  const auto& view = d.workspace().view.split.sides()[side];
  base::WorkerPool pool;
  const auto exact = deform::deform_exactly(*d.document().model().surface, d.document().cage(), view.deformer,
                                            d.document().pose(), view.method, pool)
                         .positions;
  workspace::enter_view(d.workspace(), side + 1);
  d.frame();
  return apart(d, shown(d), exact);
}

}  // namespace

TEST_CASE("each_map_colours_the_mesh_and_says_what_its_colours_mean") {
  Dragon d("pose_alert", test::with_pixels);
  d.press_key(workspace::key('C'));  // hides the cage
  d.settle();
  const auto plain = d.picture();
  d.document().changed_selection().apply(std::vector<std::uint32_t>{d.free_vertex()},
                                         document::SelectMode::replace);
  std::set<std::vector<float>> seen;
  for (const base::Choice& choice : choices(Field::none)) {
    if (choice.word == "none") continue;
    INFO(choice.word);
    std::string word(choice.word);
    std::ranges::replace(word, '-', '_');
    choose_map(d, word.c_str());
    const auto& map = d.workspace().view.split.views[0].shown;
    REQUIRE(map.values);
    CHECK(map.values->size() == d.document().model().surface->positions.size());
    CHECK(map.stats.field == d.workspace().view.options.field);
    CHECK(test::difference(plain, d.picture(), 12) > 0.02);
    seen.insert(*map.values);
  }
  // All maps differ, except both difference maps: these are empty without a second view.
  CHECK(seen.size() >= choices(Field::none).size() - 2);
  choose_map(d, "none");
  d.move({1, 1});
  d.settle();
  CHECK(d.workspace().view.split.views[0].shown.values == nullptr);
}

TEST_CASE("a_map_follows_a_drag_and_its_range_can_be_fixed") {
  Dragon d;
  choose_map(d, "displacement");
  auto& view = d.workspace().view;
  CHECK(view.split.views[0].shown.stats.most < 1e-6);
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.press_and_move(at, at + glm::vec2(120, 40));
  const double dragged = view.split.views[0].shown.stats.most;  // during the drag
  CHECK(dragged > 0.01);
  d.button(0, false);
  d.settle();
  const auto stats = view.split.views[0].shown.stats;
  d.click("hold_map_range");
  d.press_key('Z', true);
  d.settle();
  CHECK(view.split.views[0].shown.stats.most < 1e-6);
  CHECK(view.split.views[0].shown.stats.high == stats.high);
  d.click("hold_map_range");
  d.press_key('Z', true, true);
  d.settle();
  CHECK(view.split.views[0].shown.stats.high == stats.high);
  // The worst vertex is in the center of the view.
  d.click("frame_worst");
  d.settle();
  const auto place = d.workspace().frame.posed.at(*d.document().model().surface, stats.worst);
  CHECK(glm::distance(d.on_screen(place), view.camera.viewport.middle()) < 3);
}

TEST_CASE("influence_is_one_where_all_goes_along_and_of_a_pin_it_is_its_reach") {
  Dragon d("", test::bundled_dragon);
  choose_map(d, "influence");
  CHECK(d.workspace().view.split.views[0].shown.stats.most == 0);
  d.press_key('A');
  d.settle();
  CHECK(d.workspace().view.split.views[0].shown.stats.least == doctest::Approx(1).epsilon(1e-3));
  CHECK(d.workspace().view.split.views[0].shown.stats.most == doctest::Approx(1).epsilon(1e-3));
  // There are two pins. The influence of the second pin is 1 at this pin, and 0 at the first pin.
  document::add_pin(d.document(), d.workspace().frame.posed, d.document().model().surface->positions[100]);
  document::add_pin(d.document(), d.workspace().frame.posed, d.document().model().surface->positions[40000]);
  d.settle();
  const auto& values = *d.workspace().view.split.views[0].shown.values;
  CHECK(double(values[40000]) == doctest::Approx(1).epsilon(1e-3));
  CHECK(std::abs(values[100]) < 1e-3);
  CHECK(d.workspace().view.split.views[0].shown.stats.least > -0.5);
}

TEST_CASE("a_map_has_a_legend_in_small_views") {
  for (const auto& [size, views] : {std::pair(glm::ivec2(1100, 720), std::vector{0, 1, 2, 3}),
                                    std::pair(glm::ivec2(900, 600), std::vector{1, 3})}) {
    test::SmallScene s(test::small_options(size));
    s.d.run("map_area");
    s.d.run("views_4");
    s.d.settle();
    for (const int view : views) {
      const auto rect = s.d.viewer().recorder().find("legend/" + std::to_string(view));
      REQUIRE_MESSAGE(rect, size.x, " ", view);
      CHECK(rect->x0 > s.d.workspace().view.camera.viewport.origin.x + 60);  // beside the tools
    }
  }
}

TEST_CASE("views_side_by_side_are_each_as_exact_as_one_alone") {
  Dragon d("pose_alert");
  d.document().put_deformer(pose::deformer_of(pose::Preset::smooth));
  d.settle();
  d.click("section/Views");
  d.click("views_4");
  d.settle();
  auto& split = d.workspace().view.split;
  REQUIRE(split.sides().size() == 3);
  std::set<std::string_view> presets;
  for (const auto& side : split.sides()) {
    CHECK(side.problem.empty());
    const auto preset = pose::preset_of(side.deformer);
    REQUIRE(preset);
    presets.insert(base::entry_of(*preset).word);
  }
  CHECK(presets.size() == 3);
  d.choose("side/1/deformer", "side/1/deformer_rigid");
  d.choose("side/2/deformer", "side/2/deformer_paper");
  d.choose("side/2/method", "side/2/method_SD");
  d.settle();
  CHECK(pose::preset_of(split.sides()[0].deformer) == pose::Preset::rigid);
  CHECK(split.sides()[1].method == sym3::Method::sd);
  for (std::size_t i = 0; i < 3; ++i) CHECK_MESSAGE(error_of_side(d, i) < 2e-5, i);
  workspace::enter_view(d.workspace(), 0);
  // Drags the cage in another view. Errors stay small.
  const glm::vec2 first = glm::round(d.vertex(d.free_vertex()));
  const auto& v = d.workspace().view.camera.viewport;
  const glm::vec2 second = first + glm::vec2(0.5f * v.size.x, 0.5f * v.size.y);
  d.press_and_move(second, second + glm::vec2(40, -30));
  CHECK(d.document().selection().size() == 1);
  CHECK(split.active == 3);
  d.button(0, false);
  d.settle();
  CHECK(d.document().history().undo_label() == "move a vertex");
  d.move({1, 1});  // the pointer is outside all views
  CHECK(d.drawn_error() < 2e-5);
  for (std::size_t i = 0; i < 3; ++i) CHECK_MESSAGE(error_of_side(d, i) < 2e-5, i);
  d.click("views_1");
  d.settle();
  CHECK(split.sides().empty());
  CHECK(d.workspace().view.camera.viewport.pane_size == glm::vec2(1, 1));
}

TEST_CASE("closing_views_brings_back_the_camera_and_the_colour_range") {
  test::SmallScene s;
  Driver& d = s.d;
  for (auto& p : d.document().changed_pose().positions) p[0] *= 1.1;
  d.run("map_displacement");
  d.settle();
  auto& split = d.workspace().view.split;
  const auto camera = d.workspace().view.camera.pose();
  const auto stats = split.views[0].shown.stats;
  workspace::split_view(d.workspace(), 2);
  d.settle();
  split.views[0].shown.stats.high = 3 * stats.high;  // as a view with larger values does
  d.run("frame_all");
  d.settle();
  workspace::split_view(d.workspace(), 1);
  d.settle();
  CHECK(d.workspace().view.camera.pose() == camera);
  CHECK(split.views[0].shown.stats.high == stats.high);
}

TEST_CASE("views_share_a_camera_or_have_their_own_and_stay_with_another_document") {
  Dragon d;
  workspace::split_view(d.workspace(), 2);
  d.settle();
  const auto& v = d.workspace().view.camera.viewport;
  const glm::vec2 in_first = v.origin + glm::vec2(0.1f, 0.8f) * v.size;
  const glm::vec2 in_second = in_first + glm::vec2(0.5f * v.size.x, 0);
  d.drag(in_second, in_second + glm::vec2(60, 0), 1);
  CHECK(workspace::camera_of(d.workspace(), 0) == workspace::camera_of(d.workspace(), 1));
  workspace::find_command("toggle_linked_cameras")->run(d.workspace());
  d.drag(in_second, in_second + glm::vec2(60, 0), 1);
  const auto second = d.workspace().view.camera.pose();
  CHECK(workspace::camera_of(d.workspace(), 0) != second);
  d.move(in_first);
  d.frame(2);
  CHECK(d.workspace().view.camera.pose() != second);
  CHECK(workspace::camera_of(d.workspace(), 1) == second);
  for (auto& side : d.workspace().view.split.sides()) side.field = Field::signed_difference;
  REQUIRE(d.open({test::dragon}));
  d.settle();
  REQUIRE(d.workspace().view.split.sides().size() == 1);
  CHECK(d.workspace().view.split.sides()[0].shown.values);
  d.open_dragon("pose_coil");
  CHECK(d.workspace().view.split.sides()[0].shown.stats.most > 1e-4);
}

TEST_CASE("the_sum_at_a_vertex_is_what_the_frame_exponentiates_there") {
  Dragon d("pose_alert", test::with_pixels);
  d.move(d.workspace().view.camera.viewport.origin + glm::vec2(200, 12));
  d.press_key('Y', false, false, true);  // no vertex is under the pointer
  CHECK_FALSE(d.workspace().view.vertex.vertex);
  workspace::find_command("map_exp_error")->run(d.workspace());
  d.settle();
  workspace::find_command("pick_worst")->run(d.workspace());
  d.settle();
  const auto& view = d.workspace().view.vertex;
  REQUIRE(view.vertex == d.workspace().view.split.views[0].shown.stats.worst);
  REQUIRE(view.has_logs);
  double sum = 0;
  for (const auto& term : view.terms) sum += term.weight;
  CHECK(sum == doctest::Approx(1).epsilon(1e-9));
  CHECK(
      std::ranges::is_sorted(view.terms, std::greater<>(), [](const auto& t) { return std::abs(t.weight); }));
  // The determinant of the vertex's map is the exponential of the sum of eigenvalues.
  const auto& last = view.terms.back().eigenvalues;
  const double volume = glm::determinant(view.map);
  CHECK(volume == doctest::Approx(std::exp(last[0] + last[1] + last[2])).epsilon(1e-9));
  REQUIRE(view.evaluations.size() == 4);
  for (const auto& row : view.evaluations) CHECK(row.error < 1e-12);
  CHECK(view.evaluations[3].error ==
        doctest::Approx(std::pow(10, d.workspace().view.split.views[0].shown.stats.most)).epsilon(0.2));
  CHECK(view.evaluations[3].route.starts_with("degree 21"));
  const auto before = d.picture();
  d.click("drop_vertex");
  d.settle();
  CHECK_FALSE(d.workspace().view.vertex.vertex);
  CHECK(test::difference(before, d.picture(), 8) > 0.001);
  // The key inspects the vertex under the pointer, and opens the section. The numbers follow the pose.
  d.workspace().preferences.layout.sections.clear();
  d.workspace().preferences.layout.folded[static_cast<std::size_t>(workspace::Column::methods)] = true;
  d.frame(3);
  d.move(d.workspace().view.camera.viewport.middle());
  d.press_key('Y', false, false, true);
  d.settle();
  REQUIRE(d.workspace().view.vertex.vertex);
  REQUIRE(d.recorder().find("drop_vertex"));
  CHECK(d.recorder().find("drop_vertex")->visible);
  const double degrees = d.workspace().view.vertex.degrees;
  d.press_key(workspace::key('R'), true);  // resets the pose
  document::reset_pose(d.document());
  d.settle();
  CHECK(d.workspace().view.vertex.degrees == 0);
  CHECK(degrees > 0);
}

TEST_CASE("a_view_has_in_straight_lines_what_the_first_has_in_log_space") {
  Dragon d;
  std::vector<std::string> warnings;
  const auto coil =
      pose::read_pose(test::dragon_cage.parent_path() / "pose_coil.obj", *d.document().cage(), warnings);
  document::add_poses(
      d.document(),
      {{"coil", std::make_shared<const document::WholePose>(document::WholePose{coil, {}, {}})}});
  d.settle();
  REQUIRE(document::set_weight(d.document(), d.workspace().playback.vectors, 0, 0.5));
  d.settle();
  workspace::split_view(d.workspace(), 2);
  auto& side = d.workspace().view.split.sides()[0];
  side.deformer = d.document().deformer();
  side.other_blending = true;
  d.settle();
  const auto first = d.viewer().deformer()->positions();
  workspace::enter_view(d.workspace(), 1);
  d.frame(2);
  const auto straight = shown(d);
  CHECK(apart(d, straight, first) > 0.02);
  // The second view equals the first view with linear blending.
  workspace::enter_view(d.workspace(), 0);
  workspace::find_command("toggle_linear")->run(d.workspace());
  d.settle();
  CHECK(apart(d, straight, d.viewer().deformer()->positions()) < 1e-5);
}

TEST_CASE("influence_of_no_probe_is_none_and_a_map_that_cannot_be_made_says_why") {
  Dragon d;
  d.workspace().view.options.field = Field::influence;
  d.document().changed_selection() = document::Selection(document::ElementKind::probe);
  d.settle();
  CHECK(d.workspace().view.split.views[0].shown.stats.most == 0);
  CHECK(d.workspace().view.split.views[0].shown.problem.empty());
  // A pin is at a vertex that has no triangle.
  document::Document& document = d.document();
  mesh::Surface loose = *document.model().surface;
  loose.positions.push_back({0, 0, 0});
  const test::TemporaryFolder folder;
  formats::write(folder / "loose.ply", loose);
  REQUIRE(d.open({folder / "loose.ply"}));
  document::add_pin(document, d.workspace().frame.posed, {0, 0, 0});
  document.changed_probes().all[0].pin = pose::Pin{static_cast<std::uint32_t>(loose.positions.size() - 1)};
  d.settle();
  CHECK_FALSE(d.workspace().view.split.views[0].shown.problem.empty());
  CHECK(d.workspace().view.split.views[0].shown.values == nullptr);
}

TEST_CASE("while_the_cage_itself_is_changed_all_views_stay_at_rest") {
  Dragon d;
  workspace::split_view(d.workspace(), 2);
  d.settle();
  workspace::find_command("edit_cage")->run(d.workspace());
  d.settle();
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.press_and_move(at, at + glm::vec2(30, 20));
  workspace::enter_view(d.workspace(), 1);
  CHECK(apart(d, shown(d), d.document().model().surface->positions) < 1e-4);
  d.button(0, false);
  d.settle();
}

TEST_CASE("every_method_is_timed_in_the_background_when_the_pose_rests_and_none_during_a_drag") {
  auto options = Driver::default_options({1440, 900});
  options.probe = true;
  Driver d(options);
  d.open_dragon("pose_alert");
  const auto& times = d.workspace().frame.method_times;
  REQUIRE(d.until([&] { return times.measured; }));
  constexpr std::size_t fused = workspace::MethodTimes::fused;
  for (std::size_t method = 0; method < fused; ++method) {
    CHECK(times.stages[method][pose::Stage::exp] > 0);
    CHECK(times.stages[method][pose::Stage::fused] == 0);
  }
  CHECK(times.stages[fused][pose::Stage::fused] > 0);
  CHECK(times.fused_error > 0);
  CHECK(times.fused_error < 1e-4);
  CHECK(d.recorder().find("timings/fused"));
  // If the method changes, no new binding is needed.
  d.click("method_diag");
  REQUIRE(d.until([&] { return d.viewer().deformer()->ran() == pose::EngineKind::staged; }));

  d.workspace().frame.method_times = {};
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.press_and_move(at, at + glm::vec2(40, 20));
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(1);
  while (std::chrono::steady_clock::now() < end) {
    d.frame();
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  CHECK_FALSE(times.measured);
  d.button(0, false);
  CHECK(d.until([&] { return times.measured; }));

  d.run("deformer_mean_value");  // without exponentials: only the fused engine is timed
  CHECK(d.until(
      [&] { return times.measured && times.stages[fused].total() > 0 && times.stages[0].total() == 0; }));
}
