// Cage generation in the window: offer, sliders, undo, posing and saving.
#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "mesh/winding_number.h"
#include "program/driver.h"
#include "scene/ball.h"
#include "scene/document/edit.h"
#include "scene/files/session.h"
#include "scene/hand/cursor_projection.h"
#include "scene/workspace/saving.h"
#include "support/edits.h"
#include "support/folder.h"

using namespace viete;
using test::Driver;

namespace {

// A ball of 642 vertices.
std::filesystem::path ball() {
  static const test::TemporaryFolder folder;
  const std::filesystem::path file = folder / "ball.obj";
  if (!std::filesystem::exists(file)) mesh::write(file, test::ball(1, 3));
  return file;
}

struct Maker : Driver {
  explicit Maker(const std::filesystem::path& model = ball()) {
    REQUIRE(open({model}));
    settle();
  }
  // Until the generated cage matches the settings and is bound.
  void finish() {
    frame();
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
  void check_encloses() {
    const auto& cage = document().cage->surface;
    CHECK(document().cage->closed);
    CHECK(mesh::points_outside(cage, document().model.surface->positions).empty());
  }
  void pull_vertex() {
    const auto v = free_vertex();
    drag(vertex(v), vertex(v) + glm::vec2(40, -30));
    frame(2);
  }
};

}  // namespace

TEST_CASE("a_model_without_a_cage_is_framed_above_the_cage_offer") {
  Maker d(test::bundled_dragon);
  const auto lowest = [&] {
    const scene::Projector project(d.document().space, d.workspace().camera, d.workspace().viewport);
    float y = 0;
    for (const auto& p : d.document().model.surface->positions) y = std::max(y, project(p)->y);
    return y;
  };
  if (const char* pictures = std::getenv("VIETE_PICTURES"))
    render::write_png(std::filesystem::path(pictures) / "framed_above_offer.png", d.picture());
  const auto& v = d.workspace().viewport;
  const float bottom = v.origin.y + v.size.y, offer = bottom - scene::offer_height(d.workspace());
  const auto beside = d.viewer().recorder().find("open_cage_beside");
  REQUIRE(beside);
  CHECK(beside->y0 - 94 < offer);  // three lines are above that button
  CHECK(offer < beside->y0 - 60);
  const float above = lowest();
  CHECK(above < offer);
  d.click("hide_cage_offer");
  d.run("frame_all");
  d.settle();
  CHECK(scene::offer_height(d.workspace()) == 0);
  CHECK(lowest() > above + 80);
  CHECK(lowest() < bottom);
}

TEST_CASE("a_new_model_is_framed_above_the_cage_offer_in_a_low_window") {
  auto options = Driver::default_options();
  options.size = {1280, 560};
  Driver d(options);
  REQUIRE(d.open({test::bundled_dragon}));
  d.settle();
  const auto& v = d.workspace().viewport;
  const float offer = v.origin.y + v.size.y - scene::offer_height(d.workspace());
  const scene::Projector project(d.document().space, d.workspace().camera, v);
  float highest = 1e9f, lowest = 0;
  for (const auto& p : d.document().model.surface->positions) {
    const float y = project(p)->y;
    highest = std::min(highest, y), lowest = std::max(lowest, y);
  }
  CHECK(highest > v.origin.y);
  CHECK(lowest < offer);
  CHECK(lowest - highest > 0.6f * (offer - v.origin.y));
}

TEST_CASE("one_button_generates_a_cage_and_one_undo_removes_it") {
  Maker d;
  d.make();
  d.check_encloses();
  CHECK(d.document().cage->element_count() == 200);
  CHECK(test::edit_count(d.document().history) == 1);
  CHECK_FALSE(d.viewer().recorder().find("hide_cage_offer"));
  d.click("finish_cage");
  CHECK_FALSE(d.workspace().making.open);
  d.pull_vertex();
  CHECK(d.drawn_error() < 2e-5);
  const auto posed = d.document().pose.positions;
  const auto cage = d.document().cage;
  d.press_key('Z', true);
  d.press_key('Z', true);
  CHECK_FALSE(d.document().has_cage());
  d.frame(2);
  CHECK(d.viewer().recorder().find("hide_cage_offer"));
  d.press_key('Z', true, true);
  d.press_key('Z', true, true);
  d.frame(2);
  d.viewer().finish_binding();
  d.frame(2);
  CHECK(d.document().cage == cage);
  CHECK(d.document().pose.positions == posed);
  CHECK(d.drawn_error() < 2e-5);
}

TEST_CASE("cage_sliders_change_the_same_edit_and_cancel_undoes_it") {
  Maker d;
  d.make();
  d.workspace().making.wish.triangles = 60;
  d.finish();
  CHECK(d.document().cage->element_count() <= 60);
  d.check_encloses();
  d.choose("cage_kind", "cage_kind_box");
  d.finish();
  CHECK(d.document().cage->surface.positions.size() == 8);
  d.check_encloses();
  CHECK(test::edit_count(d.document().history) == 1);
  d.click("cancel_cage");
  d.frame(2);
  CHECK_FALSE(d.document().has_cage());
  CHECK_FALSE(d.document().history.can_undo());
}

TEST_CASE("done_replaces_a_preview_by_the_full_quality_cage") {
  Maker d(test::bundled_dragon);
  d.click("make_cage");
  while (!d.document().has_cage()) d.frame();
  const auto preview = d.document().cage;
  d.click("finish_cage");
  CHECK_FALSE(d.viewer().recorder().find("finish_cage"));
  d.finish_making();
  d.frame(2);
  CHECK_FALSE(d.workspace().making.open);
  CHECK(d.document().cage != preview);
  CHECK(test::edit_count(d.document().history) == 1);
  d.pull_vertex();
  CHECK(d.drawn_error() < 2e-5);
}

TEST_CASE("a_stopped_or_posed_preview_stays_and_is_labelled_as_preview") {
  Maker d(test::bundled_dragon);
  d.click("make_cage");
  while (!d.document().has_cage()) d.frame();
  const auto preview = d.document().cage;
  d.click("finish_cage");
  SUBCASE("stopped") {
    d.press_key(scene::Key::escape);
  }
  SUBCASE("posed") {
    d.pull_vertex();
  }
  d.finish_making();
  d.frame(2);
  CHECK_FALSE(d.workspace().making.open);
  CHECK(d.document().cage == preview);
  CHECK(d.workspace().messages.all().back().text.find("The preview of the cage was kept") !=
        std::string::npos);
}

TEST_CASE("undo_after_generating_a_new_cage_restores_cage_and_pose") {
  Driver plain;
  plain.open_dragon("pose_alert");
  const auto cage = plain.document().cage;
  const auto pose = plain.document().pose.positions;
  scene::find_command("set_key")->run(plain.workspace());
  plain.click("make_cage");
  plain.frame();
  plain.finish_making();
  plain.frame(3);
  CHECK(plain.document().cage != cage);
  CHECK(plain.document().cage_file.path.empty());
  CHECK(plain.viewer().recorder().find("making_lost"));  // the key is gone
  plain.press_key('Z', true);
  plain.frame(2);
  CHECK(plain.document().timeline.keys.size() == 1);
  CHECK_FALSE(plain.viewer().recorder().find("making_lost"));
  plain.press_key('Y', true);
  plain.frame(2);
  CHECK(plain.viewer().recorder().find("making_lost"));
  plain.click("finish_cage");
  plain.press_key('Z', true);
  plain.frame(2);
  CHECK(plain.document().cage == cage);
  CHECK(plain.document().pose.positions == pose);
  CHECK_FALSE(plain.document().cage_file.path.empty());
}

TEST_CASE("a_generated_cage_is_unsaved_until_a_session_or_cage_file_stores_it") {
  const test::TemporaryFolder folder;
  Maker d;
  d.make();
  d.click("finish_cage");
  d.pull_vertex();
  CHECK(scene::has_unsaved_edits(d.workspace()));
  REQUIRE(scene::save_session(d.workspace(), folder / "a.viete"));
  CHECK_FALSE(scene::has_unsaved_edits(d.workspace()));
  const auto rest = d.document().cage->surface;
  const auto pose = d.document().pose.positions;
  REQUIRE(scene::save_cage(d.workspace(), folder / "cage.obj"));
  CHECK(mesh::read(folder / "cage.obj").surface.positions == rest.positions);
  REQUIRE(scene::save_session(d.workspace(), folder / "b.viete"));
  for (const char* name : {"a.viete", "b.viete"}) {
    CAPTURE(name);
    REQUIRE(d.open({folder / name}));
    d.settle();
    CHECK(d.document().cage->surface.positions == rest.positions);
    CHECK(d.document().cage->surface.corners == rest.corners);
    CHECK(d.document().pose.positions == pose);
    CHECK_FALSE(scene::has_unsaved_edits(d.workspace()));
    CHECK(d.document().cage_file.path.empty() == (std::string(name) == "a.viete"));
    CHECK(d.workspace().messages.all().empty() == false);
    CHECK(d.drawn_error() < 2e-5);
  }
}

TEST_CASE("failed_cage_generation_shows_an_error_and_changes_nothing") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "point.obj", "v 1 2 3\nv 1 2 3\nv 1 2 3\nf 1 2 3\n");
  Maker d(folder / "point.obj");
  d.click("make_cage");
  d.frame();
  d.finish_making();
  d.frame(3);
  CHECK_FALSE(d.document().has_cage());
  CHECK(d.workspace().messages.all().back().text.find("single point") != std::string::npos);
}

TEST_CASE(
    "in the mode that edits the cage a drag changes its rest, the model stays, and the binding follows") {
  Driver d;
  d.open_dragon();
  const auto before = d.document().cage->surface.positions;
  d.press_key(scene::Key::tab);
  d.frame(3);
  const auto v = d.free_vertex();
  d.press_and_move(d.vertex(v), d.vertex(v) + glm::vec2(40, -30));
  d.frame(2);
  const auto& rest = d.document().model.surface->positions;
  const auto is_at_rest = [&] {
    double largest = 0;
    const auto shown = d.viewer().deformer()->positions();
    for (std::size_t i = 0; i < rest.size(); ++i) largest = std::max(largest, mesh::norm(rest[i] - shown[i]));
    return largest < 2e-5 * d.document().model.bounds.diagonal();
  };
  CHECK(is_at_rest());
  d.button(0, false);
  d.frame(2);
  d.viewer().finish_binding();
  d.frame(3);
  CHECK(is_at_rest());
  CHECK(d.document().cage->surface.positions[v] != before[v]);
  CHECK(d.document().pose.positions == d.document().cage->surface.positions);
  d.press_key(scene::Key::tab);
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(30, 20));
  d.frame(2);
  CHECK(d.drawn_error() < 2e-5);
  while (d.document().history.can_undo()) d.press_key('Z', true);
  d.frame(2);
  CHECK(d.document().cage->surface.positions == before);
}

TEST_CASE("one_button_makes_a_cage_enclose_its_model") {
  const test::TemporaryFolder folder;
  mesh::Surface small = mesh::read(test::dragon_cage).surface;
  for (auto& p : small.positions) {
    for (double& x : p) x *= 0.85;
  }
  REQUIRE_FALSE(mesh::points_outside(small, mesh::read(test::dragon).surface.positions).empty());
  mesh::write(folder / "small.obj", small);
  Driver d;
  REQUIRE(d.open({test::dragon, folder / "small.obj"}));
  d.settle();
  d.viewer().finish_checks();
  d.frame(3);
  d.click("enclose_model");
  d.frame(2);
  d.viewer().finish_binding();
  d.viewer().finish_checks();
  d.frame(3);
  CHECK(mesh::points_outside(d.document().cage->surface, d.document().model.surface->positions).empty());
  CHECK_FALSE(d.viewer().recorder().find("enclose_model"));
  d.press_key('Z', true);
  CHECK(d.document().cage->surface.positions == small.positions);
}

TEST_CASE("a_rotated_cage_offers_a_rotated_fit_and_shows_outside_vertices") {
  const test::TemporaryFolder folder;
  mesh::Surface turned = mesh::read(test::dragon_cage).surface;
  for (auto& p : turned.positions) p = {3 * p[1], 3 * p[2], 3 * p[0] + 1};
  mesh::write(folder / "turned.obj", turned);
  Driver d;
  REQUIRE(d.open({test::dragon, folder / "turned.obj"}));
  d.settle();
  d.viewer().finish_checks();
  d.frame(3);
  d.click("show_outside");
  REQUIRE(d.workspace().checks.shown);
  CHECK(d.workspace().checks.findings[*d.workspace().checks.shown].defect == scene::Defect::vertices_outside);
  d.click("show_outside");
  CHECK_FALSE(d.workspace().checks.shown);
  d.click("fit_cage_turned");
  d.frame(2);
  const auto cage = mesh::read(test::dragon_cage).surface.positions,
             &now = d.document().cage->surface.positions;
  double sum = 0;
  for (std::size_t v = 0; v < cage.size(); ++v) sum += mesh::squared_norm(now[v] - cage[v]);
  const double size = d.document().model.bounds.diagonal();
  CHECK(std::sqrt(sum / static_cast<double>(cage.size())) < 0.1 * size);
  d.press_key('Z', true);
  CHECK(d.document().cage->surface.positions == turned.positions);
}

TEST_CASE("cage_editing_buttons_edit_the_selection") {
  Driver d;
  d.open_dragon();
  const std::size_t faces = d.document().cage->element_count();
  d.press_key(scene::Key::tab);
  d.press_key('3');
  d.press_key('A');
  d.frame(2);
  d.click("cut_faces");
  d.viewer().finish_binding();
  d.frame(2);
  CHECK(d.document().cage->element_count() == 3 * faces);
  d.click("subdivide_cage");
  d.viewer().finish_binding();
  d.frame(2);
  CHECK(d.document().cage->element_count() == 12 * faces);
  d.press_key('1');
  d.press_key('A');
  d.click("merge_vertices");
  CHECK(d.document().cage->element_count() == 12 * faces);
  CHECK(d.workspace().messages.all().back().severity == scene::Severity::error);
}

TEST_CASE("an_undone_preview_is_not_replaced_by_its_full_quality_cage") {
  Maker d(test::bundled_dragon);
  d.click("make_cage");
  REQUIRE(d.until([&] { return d.document().has_cage(); }));  // the preview
  d.press_key('Z', true);
  CHECK_FALSE(d.document().has_cage());
  d.finish();
  CHECK_FALSE(d.document().has_cage());
  CHECK(d.document().history.can_redo());
}
