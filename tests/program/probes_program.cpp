// Probes with real events: added by a key, moved and rotated by the gizmo, set in the panel, saved and
// exported; with and without a cage.
#include <algorithm>
#include <cmath>

#include "mesh/formats/read.h"
#include "program/driver.h"
#include "scene/document/edit.h"
#include "scene/document/pose_edit.h"
#include "scene/document/probes.h"
#include "scene/files/session.h"
#include "scene/hand/cursor_projection.h"
#include "scene/hand/picking.h"
#include "scene/workspace/pointer.h"
#include "scene/workspace/saving.h"
#include "support/edits.h"
#include "support/folder.h"
#include "support/pictures.h"

using namespace viete;
using test::Driver;

namespace {

struct ProbeHand : Driver {
  explicit ProbeHand(bool cage, std::optional<test::WithPixels> pixels = {})
      : Driver(default_options(), pixels) {
    if (cage) {
      open_dragon();
    } else {
      REQUIRE(open({test::dragon}));
      settle();
    }
  }
  // Under the cursor, at the head.
  void place_probe() {
    move(head());
    press_key('P');
    frame(2);
    settle();
    REQUIRE(document().probes.all.size() == 1);
  }
  glm::vec2 head() {
    const scene::Projector project(document().space, workspace().camera, workspace().viewport);
    return glm::floor(glm::vec2(*project({0.75, 1.35, 0})));
  }
  const scene::Probe& probe() { return document().probes.all.front(); }
  scene::Gizmo gizmo() {
    const auto gizmo = scene::gizmo_of(workspace());
    REQUIRE(gizmo);
    return *gizmo;
  }
};

}  // namespace

TEST_CASE("a_probe_is_placed_dragged_turned_and_taken_back_by_hand") {
  for (const bool cage : {true, false}) {
    INFO(cage);
    ProbeHand d(cage, test::with_pixels);
    const auto rest = d.document().model.surface->positions;
    d.place_probe();
    // It is on the model, under the cursor.
    const auto at = scene::probe_center(d.document(), 0);
    double nearest = 1e9;
    for (const auto& x : rest) nearest = std::min(nearest, mesh::norm(x - at));
    CHECK(nearest < 0.05);
    const scene::Projector project(d.document().space, d.workspace().camera, d.workspace().viewport);
    CHECK(glm::distance(glm::vec2(*project(at)), d.head()) < 1.5f);
    CHECK_FALSE(scene::differs_from_rest(d.document()));
    const auto before = d.picture();
    const auto unmoved = d.exact_positions();
    // Up, with the green arrow.
    d.press_key('W');
    d.frame(2);
    const auto arm = d.gizmo().arms[1];
    d.drag(glm::floor(arm.tip), glm::floor(arm.tip) + glm::vec2(0, -60));
    d.settle();
    const auto moved = d.probe().pose.move;
    CHECK(moved[1] > 0.1);
    CHECK(moved[0] == 0);
    CHECK(moved[2] == 0);
    CHECK(test::difference(before, d.picture(), 8) > 0.003);
    CHECK(d.drawn_error() < 2e-5);
    // By typed numbers, during a rotation.
    d.press_key('E');
    d.frame(2);
    const auto ring = d.gizmo();
    d.press_and_move(ring.center + glm::vec2(scene::gizmo_view_ring, 0),
                     ring.center + glm::vec2(scene::gizmo_view_ring, 30));
    d.type("y");
    d.type("90");
    d.press_key(scene::Key::enter);
    d.button(0, false);
    d.settle();
    CHECK(d.probe().pose.turn[1] == doctest::Approx(std::acos(-1.0) / 2).epsilon(1e-12));
    CHECK(d.drawn_error() < 2e-5);
    // Distant vertices are unchanged, bit for bit.
    const auto exact = d.exact_positions();
    std::size_t still = 0;
    for (std::size_t v = 0; v < rest.size(); ++v) still += exact[v] == rest[v];
    if (!cage) CHECK(still > rest.size() / 4);
    for (int i = 0; i < 2; ++i) d.press_key('Z', true);
    d.settle();
    CHECK(d.probe().pose == scene::ProbePose{});
    CHECK(d.exact_positions() == unmoved);
    CHECK(d.drawn_error() < 2e-5);
    d.press_key('Z', true);
    CHECK(d.document().probes.empty());
    CHECK_FALSE(scene::has_unsaved_edits(d.workspace()));
  }
}

TEST_CASE("probes_are_set_in_their_panel") {
  ProbeHand d(false);
  d.place_probe();
  d.click("section/Probes");
  d.frame(2);
  d.choose("probe_turn", "probe_turn_sharp");
  CHECK(d.probe().turn.falloff == scene::Falloff::sharp);
  const double radius = d.probe().move.radius;
  d.click("probe_move_radius");  // in its center
  CHECK(d.probe().move.radius != radius);
  CHECK(d.probe().turn.radius == radius);
  d.choose("probe_mix", "probe_mix_softmax");
  CHECK(d.document().probes.mix == deform::ProbeMix::softmax);
  d.click("toggle_locked");
  CHECK(d.probe().locked);
  d.click("toggle_locked");
  CHECK_FALSE(d.probe().locked);
  d.click("mirror_probe");
  CHECK(d.document().probes.all.size() == 2);
  d.click("remove_probe");
  CHECK(d.document().probes.all.size() == 1);
  CHECK(d.document().selection.empty());
  const scene::Projector project(d.document().space, d.workspace().camera, d.workspace().viewport);
  d.click(glm::vec2(*project(scene::probe_center(d.document(), 0))));
  CHECK(d.document().selection.contains(0));
  d.press_key(scene::Key::delete_key, false, true);
  CHECK(d.document().probes.empty());
}

namespace {

// Saves and exports; returns the positions in double.
std::vector<mesh::Point> save_and_write(ProbeHand& d, const std::filesystem::path& folder) {
  d.place_probe();
  d.press_key('W');
  d.frame(2);
  const auto arm = d.gizmo().arms[0];
  d.drag(glm::floor(arm.tip), glm::floor(arm.tip) + glm::vec2(50, 10));
  d.settle();
  auto shown = d.exact_positions();
  CHECK(shown != d.document().model.surface->positions);
  d.workspace().requests.save_session = folder / "a.viete";
  d.workspace().requests.save_model = folder / "out.obj";
  d.frame(2);
  d.viewer().finish_exports();
  CHECK_FALSE(scene::has_unsaved_edits(d.workspace()));
  return shown;
}

}  // namespace

TEST_CASE("a_model_without_a_cage_is_saved_written_and_opened_again_with_its_probes") {
  const test::TemporaryFolder folder;
  std::vector<mesh::Point> shown;
  scene::Session saved;
  {
    ProbeHand d(false);
    shown = save_and_write(d, folder.path());
    saved = scene::session_of(d.workspace());
  }
  const auto written = mesh::read(folder / "out.obj").surface.positions;
  REQUIRE(written.size() == shown.size());
  for (std::size_t v = 0; v < shown.size(); ++v) CHECK(mesh::norm(written[v] - shown[v]) < 1e-12);
  Driver again;
  REQUIRE(again.open({folder / "a.viete"}));
  again.settle();
  CHECK(again.document().probes == saved.probes);
  CHECK(again.exact_positions() == shown);
}

TEST_CASE("a_cage_that_is_opened_leaves_the_probes_and_they_are_placed_on_what_others_have_moved") {
  ProbeHand d(false);
  d.place_probe();
  d.document().changed_probes().all[0].pose.move = {0.1, 0.25, 0};
  d.settle();
  const auto probes = d.document().probes;
  // The drawn position of the head.
  const scene::Projector project(d.document().space, d.workspace().camera, d.workspace().viewport);
  const glm::vec2 at =
      glm::floor(glm::vec2(*project(scene::probe_center(d.document(), 0)))) + glm::vec2(3, 0);
  d.move(at);
  d.press_key('P');
  d.settle();
  REQUIRE(d.document().probes.all.size() == 2);
  CHECK(glm::distance(glm::vec2(*project(scene::probe_center(d.document(), 1))), at) < 6);
  d.press_key('Z', true);
  CHECK(d.document().probes == probes);
  scene::mark_saved(d.workspace());
  REQUIRE(d.open({test::dragon_cage}, Driver::What::cage));
  d.settle();
  CHECK(d.document().has_cage());
  CHECK(d.document().probes == probes);
  CHECK(scene::has_unsaved_edits(d.workspace()));
  CHECK(d.drawn_error() < 2e-5);
}

TEST_CASE("the_model_is_seen_at_rest_whatever_moves_it_and_follows_again") {
  ProbeHand d(true, test::with_pixels);
  d.press_key('C');  // hides the cage
  d.settle();
  const auto rest = d.picture();
  deform::Pose pose = d.document().pose;
  for (auto& p : pose.positions) p[1] *= 1.5;
  scene::set_pose(d.document(), pose);
  d.settle();
  const auto posed = d.picture();
  CHECK(test::difference(rest, posed, 8) > 0.01);
  d.press_key('N');
  d.settle();
  CHECK(d.workspace().posed.vertices.empty());
  const auto off = d.picture();
  CHECK(test::difference(rest, off, 8) < 0.02);  // except for the panels
  CHECK(test::difference(posed, off, 8) > 0.01);
  // A pose made in the meantime is kept.
  for (auto& p : pose.positions) p[0] += 0.3;
  scene::set_pose(d.document(), pose);
  d.settle();
  CHECK(test::difference(off, d.picture(), 8) < 0.01);
  d.press_key('N');
  d.settle();
  CHECK(test::difference(posed, d.picture(), 8) > 0.01);
  CHECK(d.drawn_error() < 2e-5);
}
