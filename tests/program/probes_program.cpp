// Probes with simulated events, with and without a cage.

#include "document/pose_edit.h"
#include "document/probes.h"
#include "program/small_scene.h"
#include "support/pictures.h"
#include "workspace/saving.h"

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
