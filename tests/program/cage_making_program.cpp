// Makes a cage in the window: button, sliders, undo, posing and saving.
#include "formats/write.h"
#include "mesh/triangle_tree.h"
#include "program/driver.h"
#include "support/ball.h"
#include "support/edits.h"
#include "support/text.h"
#include "workspace/open_save.h"

using namespace viete;
using test::Dragon, test::Driver;

namespace {

// Writes a file with a ball of 642 vertices.
std::filesystem::path ball() {
  static const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "ball.obj";
  if (!std::filesystem::exists(file)) formats::write(file, test::ball(1, 3));
  return file;
}

struct Maker : Driver {
  explicit Maker(const std::filesystem::path& model = ball()) {
    REQUIRE(open({model}));
    settle();
  }
  // Runs frames until the cage follows the current settings and is bound.
  void finish() {
    finish_making();
    frame(2);
    viewer().finish_binding();
    frame(3);
  }
  void make() {
    click("make_cage");
    finish();
    REQUIRE(document().has_cage());
  }
  // Starts to make a cage. Returns the preview.
  std::shared_ptr<const pose::Cage> preview() {
    click("make_cage");
    REQUIRE(until([&] { return document().has_cage(); }));
    return document().cage();
  }
  void check_encloses() {
    const auto& cage = document().cage()->surface;
    CHECK(document().cage()->closed);
    CHECK(mesh::points_outside(cage, document().model().surface->positions).empty());
  }
  void pull_vertex() {
    const auto v = free_vertex();
    drag(vertex(v), vertex(v) + glm::vec2(40, -30));
  }
};

}  // namespace

TEST_CASE("a_model_without_a_cage_is_framed_above_the_cage_offer") {
  for (const int height : {800, 560}) {
    CAPTURE(height);
    Driver d(Driver::default_options({1280, height}));
    REQUIRE(d.open({test::bundled_dragon}));
    d.settle();
    const auto& v = d.workspace().view.camera.viewport;
    const auto lowest = [&] {
      const interact::Projector project(d.document().space(), d.workspace().view.camera);
      float y = 0;
      for (const auto& p : d.document().model().surface->positions) y = std::max(y, project(p)->y);
      return y;
    };
    const float bottom = v.origin.y + v.size.y, offer = bottom - workspace::offer_height(d.workspace());
    const auto beside = d.recorder().find("open_cage_beside");
    REQUIRE(beside);
    CHECK(beside->y0 - 94 < offer);  // three lines of text are above the button
    CHECK(offer < beside->y0 - 60);
    const float above = lowest();
    CHECK(above < offer);
    CHECK(above > v.origin.y + 0.6f * (offer - v.origin.y));
    d.click("hide_cage_offer");
    d.run("frame_all");
    d.settle();
    CHECK(workspace::offer_height(d.workspace()) == 0);
    CHECK(lowest() > above + 80);
    CHECK(lowest() < bottom);
  }
}

TEST_CASE("one_button_generates_a_cage_and_one_undo_removes_it") {
  Maker d;
  d.make();
  d.check_encloses();
  CHECK(d.document().cage()->element_count() == 200);
  CHECK(test::edit_count(d.document().history()) == 1);
  CHECK_FALSE(d.recorder().find("hide_cage_offer"));
  d.click("finish_cage");
  CHECK_FALSE(d.workspace().making.open);
  d.pull_vertex();
  CHECK(d.drawn_error() < 2e-5);
  const auto posed = d.document().pose().positions;
  const auto cage = d.document().cage();
  d.press_key('Z', true);
  d.press_key('Z', true);
  CHECK_FALSE(d.document().has_cage());
  d.frame(2);
  CHECK(d.recorder().find("hide_cage_offer"));
  d.press_key('Z', true, true);
  d.press_key('Z', true, true);
  d.viewer().finish_binding();
  d.frame(2);
  CHECK(d.document().cage() == cage);
  CHECK(d.document().pose().positions == posed);
  CHECK(d.drawn_error() < 2e-5);
}

TEST_CASE("cage_sliders_change_the_same_edit_and_cancel_undoes_it") {
  Maker d;
  d.make();
  d.workspace().making.wish.triangles = 60;
  d.finish();
  CHECK(d.document().cage()->element_count() <= 60);
  d.check_encloses();
  d.choose("cage_kind", "cage_kind_box");
  d.finish();
  CHECK(d.document().cage()->surface.positions.size() == 8);
  d.check_encloses();
  CHECK(test::edit_count(d.document().history()) == 1);
  d.click("cancel_cage");
  CHECK_FALSE(d.document().has_cage());
  CHECK_FALSE(d.document().history().can_undo());
}

TEST_CASE("a_preview_is_replaced_by_the_full_quality_cage_unless_it_is_stopped_posed_or_undone") {
  Maker d(test::bundled_dragon);
  const auto preview = d.preview();
  bool stays = true;
  SUBCASE("done") {
    d.click("finish_cage");
    CHECK_FALSE(d.recorder().find("finish_cage"));
    stays = false;
  }
  SUBCASE("stopped") {
    d.click("finish_cage");
    d.press_key(workspace::Key::escape);
  }
  SUBCASE("posed") {
    d.click("finish_cage");
    d.pull_vertex();
  }
  SUBCASE("undone") {
    d.press_key('Z', true);
    d.finish();
    CHECK_FALSE(d.document().has_cage());
    CHECK(d.document().history().can_redo());
    return;
  }
  d.finish_making();
  d.frame(2);
  CHECK_FALSE(d.workspace().making.open);
  CHECK((d.document().cage() == preview) == stays);
  if (stays) CHECK(test::mentions(d.last_message(), "The preview of the cage was kept"));
}

TEST_CASE("undo_after_generating_a_new_cage_restores_cage_and_pose") {
  Dragon d("pose_alert");
  const auto cage = d.document().cage();
  const auto pose = d.document().pose().positions;
  workspace::find_command("set_key")->run(d.workspace());
  d.click("make_cage");
  d.finish_making();
  d.frame(3);
  CHECK(d.document().cage() != cage);
  CHECK(d.document().cage_file().path.empty());
  CHECK(d.recorder().find("making_lost"));  // the key no longer exists
  d.press_key('Z', true);
  CHECK(d.document().timeline().keys.size() == 1);
  CHECK_FALSE(d.recorder().find("making_lost"));
  CHECK(d.document().cage() == cage);
  CHECK(d.document().pose().positions == pose);
  CHECK_FALSE(d.document().cage_file().path.empty());
}

TEST_CASE("a_generated_cage_is_unsaved_until_a_session_stores_it") {
  const test::TemporaryFolder folder;
  Maker d;
  d.make();
  d.click("finish_cage");
  d.pull_vertex();
  CHECK(workspace::has_unsaved_edits(d.workspace()));
  REQUIRE(workspace::save_session(d.workspace(), folder / "a.viete"));
  CHECK_FALSE(workspace::has_unsaved_edits(d.workspace()));
  const auto rest = d.document().cage()->surface;
  const auto pose = d.document().pose().positions;
  REQUIRE(workspace::save_cage(d.workspace(), folder / "cage.obj"));
  CHECK(formats::read(folder / "cage.obj").surface.positions == rest.positions);
  REQUIRE(d.open({folder / "a.viete"}));
  d.settle();
  CHECK(d.document().cage()->surface.positions == rest.positions);
  CHECK(d.document().cage()->surface.corners == rest.corners);
  CHECK(d.document().pose().positions == pose);
  CHECK_FALSE(workspace::has_unsaved_edits(d.workspace()));
  CHECK(d.drawn_error() < 2e-5);
}

TEST_CASE("failed_cage_generation_shows_an_error_and_changes_nothing") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n");
  Maker d(folder / "point.obj");
  d.click("make_cage");
  d.finish_making();
  d.frame(3);
  CHECK_FALSE(d.document().has_cage());
  CHECK(test::mentions(d.last_message(), "single point"));
}

TEST_CASE("a_drag_while_editing_the_cage_changes_its_rest_shape_and_the_model_stays") {
  Dragon d;
  const auto before = d.document().cage()->surface.positions;
  d.press_key(workspace::Key::tab);
  const auto v = d.free_vertex();
  d.press_and_move(d.vertex(v), d.vertex(v) + glm::vec2(40, -30));
  d.frame(2);
  const auto& rest = d.document().model().surface->positions;
  const auto is_at_rest = [&] {
    return test::largest_distance(rest, d.viewer().deformer()->positions()) <
           2e-5 * d.document().model().bounds.diagonal();
  };
  CHECK(is_at_rest());
  d.button(0, false);
  d.viewer().finish_binding();
  d.frame(3);
  CHECK(is_at_rest());
  CHECK(d.document().cage()->surface.positions[v] != before[v]);
  d.press_key(workspace::Key::tab);
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(30, 20));
  CHECK(d.drawn_error() < 2e-5);
  while (d.document().history().can_undo()) d.press_key('Z', true);
  CHECK(d.document().cage()->surface.positions == before);
}

TEST_CASE("a_cage_with_unpaired_vertices_offers_a_symmetric_one") {
  const test::TemporaryFolder folder;
  mesh::Surface cage = test::ball(1.2, 1);
  cage.positions[5][0] += 0.3;  // the mirror partner of this vertex is now missing
  formats::write(folder / "cage.obj", cage);
  Driver d;
  REQUIRE(d.open({ball(), folder / "cage.obj"}));
  d.settle();
  const auto before = d.document().cage();
  d.workspace().view.handling.mirror = document::MirrorPlane::x;
  d.frame(2);
  REQUIRE(workspace::mirror_of(d.workspace())->unpaired() > 0);
  d.click("make_symmetric_cage");
  d.finish_making();
  d.frame(2);
  CHECK(workspace::mirror_of(d.workspace())->unpaired() == 0);
  CHECK_FALSE(workspace::find_command("make_symmetric_cage")->enabled(d.workspace()));
  d.run("cancel_cage");
  CHECK(d.document().cage() == before);
}
