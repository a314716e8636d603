// Probes, pins and shapes with simulated events, with and without a cage.
#include "document/pose_edit.h"
#include "document/probes.h"
#include "formats/read.h"
#include "formats/write.h"
#include "interact/transform_drag.h"
#include "program/small_scene.h"
#include "support/pictures.h"
#include "workspace/open_save.h"

using namespace viete;
using test::Driver;

namespace {

struct ProbeHand : Driver {
  explicit ProbeHand(bool cage) {
    REQUIRE(cage ? open({test::dragon, test::dragon_cage}) : open({test::dragon}));
    settle();
  }
  // Adds a probe at the head with the key P.
  void place_probe() {
    move(head());
    press_key('P');
    settle();
    REQUIRE(document().probes().all.size() == 1);
  }
  glm::vec2 head() { return glm::floor(on_screen({0.75, 1.35, 0})); }
  const document::Probe& probe() { return document().probes().all.front(); }
};

}  // namespace

TEST_CASE("a_probe_is_placed_dragged_turned_and_undone_by_mouse_and_keys") {
  for (const bool cage : {true, false}) {
    INFO(cage);
    ProbeHand d(cage);
    const auto rest = d.document().model().surface->positions;
    d.place_probe();
    CHECK(glm::distance(d.on_screen(document::probe_center(d.document(), 0)), d.head()) < 1.5f);
    CHECK_FALSE(document::differs_from_rest(d.document()));
    const auto unmoved = d.exact_positions();
    // Drags the green arrow upward.
    d.press_key('W');
    const glm::vec2 tip = glm::floor(workspace::gizmo_of(d.workspace())->arms[1].tip);
    d.drag(tip, tip + glm::vec2(0, -60));
    d.settle();
    const auto moved = d.probe().pose.move;
    CHECK(moved[1] > 0.1);
    CHECK(moved[0] == 0);
    CHECK(moved[2] == 0);
    CHECK(d.drawn_error() < 2e-5);
    // Types a number during a rotation.
    d.press_key('E');
    const glm::vec2 ring =
        workspace::gizmo_of(d.workspace())->center + glm::vec2(interact::gizmo_view_ring, 0);
    d.press_and_move(ring, ring + glm::vec2(0, 30));
    d.type("y");
    d.type("90");
    d.press_key(workspace::Key::enter);
    d.button(0, false);
    d.settle();
    CHECK(d.probe().pose.turn[1] == doctest::Approx(std::numbers::pi / 2).epsilon(1e-12));
    CHECK(d.drawn_error() < 2e-5);
    // Distant vertices keep their exact positions.
    const auto exact = d.exact_positions();
    std::size_t still = 0;
    for (std::size_t v = 0; v < rest.size(); ++v) still += exact[v] == rest[v];
    if (!cage) CHECK(still > rest.size() / 4);
    for (int i = 0; i < 2; ++i) d.press_key('Z', true);
    d.settle();
    CHECK(d.probe().pose == document::ProbePose{});
    CHECK(d.exact_positions() == unmoved);
    d.press_key('Z', true);
    CHECK(d.document().probes().empty());
    CHECK_FALSE(workspace::has_unsaved_edits(d.workspace()));
  }
}

TEST_CASE("probes_are_set_in_their_panel_and_stay_when_a_cage_is_opened") {
  ProbeHand d(false);
  d.place_probe();
  d.click("section/Probes");
  d.choose("probe_turn", "probe_turn_sharp");
  CHECK(d.probe().turn.falloff == document::Falloff::sharp);
  const double radius = d.probe().move.radius;
  d.click(d.place_of("probe_move_radius") + glm::vec2(30, 0));  // beside the knob, which is in the middle
  CHECK(d.probe().move.radius != radius);
  CHECK(d.probe().turn.radius == radius);
  d.choose("probe_mix", "probe_mix_softmax");
  CHECK(d.document().probes().mix == pose::ProbeMix::softmax);
  d.click("toggle_locked");
  CHECK(d.probe().locked);
  d.click("toggle_locked");
  d.click(d.on_screen(document::probe_center(d.document(), 0)));
  CHECK(d.document().selection().contains(0));
  d.click(d.on_screen(document::probe_center(d.document(), 0)), 1);
  d.frame(2);
  d.click("menu/remove_probe");
  CHECK(d.document().probes().empty());
  d.press_key('Z', true);
  d.document().changed_probes().all[0].pose.move = {0.1, 0.25, 0};
  const auto probes = d.document().probes();
  workspace::mark_saved(d.workspace());
  REQUIRE(d.open({test::dragon_cage}, Driver::What::cage));
  d.settle();
  CHECK(d.document().has_cage());
  CHECK(d.document().probes() == probes);
  CHECK(workspace::has_unsaved_edits(d.workspace()));
  CHECK(d.drawn_error() < 2e-5);
}

TEST_CASE("the_model_is_shown_at_rest_on_request_and_follows_again") {
  test::SmallScene small(Driver::default_options({400, 300}), test::with_pixels);
  Driver& d = small.d;
  d.workspace().view.options.panels = d.workspace().view.options.cage = false;
  const auto picture = [&] {
    d.settle();
    return d.picture();
  };
  const auto rest = picture();
  pose::Pose pose = d.document().pose();
  for (auto& p : pose.positions) p[1] *= 1.5;
  document::set_pose(d.document(), pose);
  const auto posed = picture();
  CHECK(test::difference(rest, posed, 8) > 0.01);
  d.press_key('N');
  CHECK(test::difference(rest, picture(), 8) < 0.01);
  CHECK(d.workspace().frame.posed.vertices.empty());
  // Sets another pose while the model is shown at rest. The pose appears after the next N.
  for (auto& p : pose.positions) p[0] += 0.3;
  document::set_pose(d.document(), pose);
  CHECK(test::difference(rest, picture(), 8) < 0.01);
  d.press_key('N');
  CHECK(test::difference(posed, picture(), 8) > 0.01);
  CHECK(d.drawn_error() < 2e-5);
}

namespace {

// The dragon and files of two shapes. In the shapes, the upper half is rotated to the left or to the right.
struct ShapeHand : Driver {
  test::TemporaryFolder folder;
  std::filesystem::path left = folder / "left.ply", right = folder / "right.ply";

  explicit ShapeHand(bool cage) {
    if (cage) {
      open_dragon();
    } else {
      REQUIRE(open({test::dragon}));
      settle();
    }
    write(left, 1.2);
    write(right, -1.2);
    workspace().jobs.wishes.open({What::dropped, {right, left}});
    frame();
    REQUIRE(until([&] { return document().library().poses.size() == 2; }));
    settle();
    frame(2);
  }
  void write(const std::filesystem::path& file, double angle) {
    mesh::Surface surface = *document().model().surface;
    const mesh::Bounds box = mesh::bounds(surface.positions);
    for (mesh::Point& p : surface.positions) {
      const double share = std::clamp((p[1] - box.low[1]) / (box.high[1] - box.low[1]), 0.0, 1.0);
      const double a = angle * share, x = p[0] - box.center()[0], z = p[2] - box.center()[2];
      p = {box.center()[0] + std::cos(a) * x + std::sin(a) * z, p[1],
           box.center()[2] - std::sin(a) * x + std::cos(a) * z};
    }
    formats::write(file, surface);
  }
  const document::NamedPose& pose(std::size_t i) { return document().library().poses[i]; }
};

}  // namespace

TEST_CASE("a_slider_turns_the_model_and_what_is_drawn_is_what_is_written") {
  for (const bool cage : {false, true}) {
    INFO(cage);
    ShapeHand d(cage);
    CHECK(d.pose(0).name == "left");
    d.click("pose_weight/1");  // a click in the center sets 50 %
    if (cage) d.document().changed_pose().positions[d.free_vertex()][1] += 0.4;
    d.settle();
    CHECK(d.pose(1).weight == doctest::Approx(0.5).epsilon(0.03));
    REQUIRE(d.document().shape());
    CHECK(d.drawn_error() < 2e-5);
    CHECK(workspace::has_unsaved_edits(d.workspace()));
    const auto file = d.folder / "out.ply";
    d.save(workspace::SaveFile::Content::model, file);
    const double off = test::largest_distance(formats::read(file).surface.positions, d.exact_positions());
    CHECK(off < 1e-6 * d.document().model().bounds.diagonal());
  }
}

TEST_CASE("a_pin_is_placed_by_a_key_dragged_by_the_mouse_and_the_sliders_move_with_it") {
  ShapeHand d(false);
  const auto& rest = d.document().model().surface->positions;
  // Adds a pin at the feet and a pin on the head.
  for (const mesh::Point& at : {mesh::Point{0.05, 0.1, 0.2}, mesh::Point{0.75, 1.35, 0}}) {
    d.move(glm::floor(d.on_screen(at)));
    d.press_key('P', false, false, true);
  }
  d.settle();
  REQUIRE(d.document().probes().all.size() == 2);
  const pose::Probe& pin = d.document().probes().all[1];
  REQUIRE(pin.pin);
  CHECK(pin.place == rest[pin.pin->vertex]);
  CHECK_FALSE(d.document().shape());
  d.press_key('Q');
  const glm::vec2 from = glm::floor(d.on_screen(document::probe_center(d.document(), 1)));
  d.press_and_move(from, from + glm::vec2(-50, 10));
  REQUIRE(d.document().shape());
  CHECK(std::abs(d.pose(0).weight) + std::abs(d.pose(1).weight) > 0.05);
  d.button(0, false);
  d.settle();
  CHECK_FALSE(d.workspace().frame.pins.is_due());
  const auto& shape = *d.document().shape();
  CHECK(mesh::norm(shape[pin.pin->vertex] - (pin.place + pin.pose.move)) < 1e-6);
  CHECK(glm::distance(d.on_screen(shape[pin.pin->vertex]), from + glm::vec2(-50, 10)) < 4);
  const std::uint32_t foot = d.document().probes().all[0].pin->vertex;
  CHECK(mesh::norm(shape[foot] - rest[foot]) < 1e-6);
  CHECK(d.drawn_error() < 2e-5);
  const auto posed = d.document().shape();
  const auto weight = d.pose(0).weight;
  const glm::vec2 now = glm::floor(d.on_screen(document::probe_center(d.document(), 1)));
  d.press_and_move(now, now + glm::vec2(60, 0));
  CHECK(d.document().shape() != posed);
  d.press_key(workspace::Key::escape);
  d.button(0, false);
  d.settle();
  CHECK(d.document().shape() == posed);
  CHECK(d.pose(0).weight == weight);
}

TEST_CASE("a_pin_under_a_rotated_cage_follows_the_cursor") {
  ShapeHand d(true);
  auto& cage = d.document().changed_pose().positions;
  for (mesh::Point& p : cage) p = {p[0], -p[2], p[1]};  // rotates the cage by 90 degrees about x
  d.settle();
  const mesh::Point head{0.75, 0, 1.35};
  d.move(glm::floor(d.on_screen(head)));
  d.press_key('P', false, false, true);
  d.settle();
  REQUIRE(d.document().probes().all.size() == 1);
  const pose::Probe& pin = d.document().probes().all[0];
  const mesh::Point before = document::pinned_vertex(d.document(), 0);
  CHECK(glm::distance(d.on_screen(before), d.on_screen(head)) < 12);
  interact::Transform up;
  up.shift = {0, 0.2, 0};
  REQUIRE(interact::place(d.document(), d.document().state(), {}, up, 0));
  d.settle();
  const auto moved = document::pinned_vertex(d.document(), 0) - before;
  CHECK(mesh::norm(moved - mesh::Point{0, 0.2, 0}) < 0.02);
  CHECK(std::abs(pin.pose.move[2] + 0.2) < 0.02);  // relative to the shape
  CHECK(mesh::norm(document::pinned_vertex(d.document(), 0) - document::probe_center(d.document(), 0)) <
        1e-3);
}
