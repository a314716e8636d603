#include "document/probes.h"

#include "interact/transform_drag.h"
#include "support/commands.h"
#include "support/edits.h"
#include "support/files.h"
#include "support/grips.h"
#include "workspace/open_save.h"
#include "workspace/pointer.h"

using namespace viete;
using namespace viete::document;
using namespace viete::files;
using namespace viete::interact;
using namespace viete::workspace;

namespace {

struct Probed {
  test::CubeFiles files;
  Workspace w;

  explicit Probed(bool cage = true) {
    REQUIRE(test::load_model(w, files.model, cage ? files.cage : std::filesystem::path()));
  }
  Document& document() { return w.document; }
  Probe& probe(std::size_t i = 0) { return w.document.changed_probes().all[i]; }
  void add(const mesh::Point& at) { REQUIRE(add_probe(w.document, {}, at)); }
  void select(std::vector<std::uint32_t> which) {
    w.document.changed_selection() = Selection(ElementKind::probe, which);
  }
  bool transform(Tool tool, const Transform& by) {
    return transform_selection(w.document, tool, test::plain_grip(w.document), by);
  }
  void frame() {
    w.view.camera.viewport = {{1000, 800}, {0, 0}, {1000, 800}};
    frame_all(w, false);
  }
};

Transform quarter(const glm::dvec3& pivot) {
  return {.pivot = pivot, .axis = {0, 0, 1}, .degrees = 90};
}

}  // namespace

TEST_CASE("a_probe_is_added_where_the_model_is_drawn_and_selected") {
  Probed p;
  const mesh::Point at{1, 0.5, 0.25};
  p.add(at);
  CHECK(p.probe().place == at);
  CHECK(p.probe().pose == ProbePose{});
  CHECK(p.document().selection().kind() == ElementKind::probe);
  CHECK(p.document().selection().contains(0));
  CHECK(test::edit_count(p.document().history()) == 1);
  // The model is posed. The probe is added at the corresponding point at rest.
  std::vector<pose::FrameVertex> posed;
  for (const auto& x : p.document().model().surface->positions)
    posed.push_back({{float(x[0]) + 7, float(x[1]), float(x[2])}, {}});
  REQUIRE(add_probe(p.document(), {posed, {0, 0, 0}}, at + mesh::Point{7, 0, 0}));
  CHECK(mesh::norm(p.probe(1).place - at) < 1e-6);
  undo(p.document());
  undo(p.document());
  CHECK(p.document().probes().empty());
  redo(p.document());
  CHECK(p.document().probes().all.size() == 1);
}

TEST_CASE("there_is_a_largest_number_of_probes") {
  Probed p;
  for (std::size_t i = 0; i < most_probes; ++i) p.add({0, 0, 0});
  CHECK_FALSE(add_probe(p.document(), {}, {0, 0, 0}));
  CHECK_FALSE(mirror_probes(p.document(), 0));
  CHECK_FALSE(test::run_command(p.w, "add_probe"));
  CHECK(p.document().probes().all.size() == most_probes);
}

TEST_CASE("probes_move_turn_and_scale_about_the_middle_of_what_is_selected") {
  Probed p;
  p.add({1, 0, 0});
  p.add({-1, 0, 0});
  p.select({0, 1});
  CHECK(test::selection_center(p.document()) == glm::dvec3(0, 0, 0));
  REQUIRE(p.transform(Tool::rotate, quarter({0, 0, 0})));
  CHECK(mesh::norm(probe_center(p.document(), 0) - mesh::Point{0, 1, 0}) < 1e-15);
  CHECK(mesh::norm(p.probe().pose.turn - mesh::Point{0, 0, std::acos(-1.0) / 2}) < 1e-15);
  CHECK(p.probe().place == mesh::Point{1, 0, 0});
  REQUIRE(p.transform(Tool::move, {.factors = {2, 1, 1}, .shift = {0.5, 0, 0}}));
  const auto m = linear_part(p.probe().pose);
  CHECK(m[1] == doctest::Approx(-2).epsilon(1e-12));
  CHECK(m[3] == doctest::Approx(1).epsilon(1e-12));
  CHECK(mesh::norm(probe_center(p.document(), 0) - mesh::Point{0.5, 1, 0}) < 1e-15);
  CHECK(p.document().history().undo_label() == "move 2 probes");
  undo(p.document());
  undo(p.document());
  CHECK(p.probe().pose == ProbePose{});
  CHECK_FALSE(differs_from_rest(p.document()));
  CHECK(p.document().pose().positions == p.document().cage()->surface.positions);
  // The probe rotates about its position on the cage after the cage moved.
  p.document().put_carried({{{1, 5, 0}}, {{-1, 5, 0}}});
  CHECK(test::selection_center(p.document()) == glm::dvec3(0, 5, 0));
  REQUIRE(p.transform(Tool::rotate, quarter({0, 5, 0})));
  CHECK(mesh::norm(p.probe().pose.move - mesh::Point{-1, 1, 0}) < 1e-14);
}

TEST_CASE("whole_turns_of_a_probe_count_and_what_leaves_its_range_moves_nothing") {
  Probed p;
  p.add({0, 0, 0});
  REQUIRE(p.transform(Tool::rotate, {.degrees = 540}));
  CHECK(p.probe().pose.turn[2] == doctest::Approx(3 * std::acos(-1.0)).epsilon(1e-13));
  const Probe before = p.probe();
  CHECK_FALSE(p.transform(Tool::move, {.shift = {1e30, 0, 0}}));
  CHECK(p.probe() == before);
  CHECK(p.transform(Tool::scale, {.factors = {1e12, 1, 1}}));
  CHECK(is_probe_stretch(p.probe().pose.stretch));
}

TEST_CASE("locked_probes_stay_whatever_is_done_to_them") {
  Probed p;
  p.add({1, 0, 0});
  p.add({0, 1, 0});
  p.select({0});
  p.frame();
  p.probe().pose.move = {0, 0.3, 0};
  CHECK(gizmo_of(p.w));
  CHECK(differs_from_rest(p.document()));
  CHECK(test::run_command(p.w, "toggle_locked"));
  CHECK(p.probe().locked);
  CHECK_FALSE(gizmo_of(p.w));
  CHECK_FALSE(differs_from_rest(p.document()));
  reset_pose(p.document());
  CHECK(p.probe().pose.move == mesh::Point{0, 0.3, 0});
  p.select({0, 1});
  const Probe locked = p.probe();
  p.transform(Tool::move, {.shift = {1, 0, 0}});
  CHECK(p.probe() == locked);
  CHECK(p.probe(1).pose.move == mesh::Point{1, 0, 0});
  CHECK(test::run_command(p.w, "remove_probe"));
  REQUIRE(p.document().probes().all.size() == 1);
  CHECK(p.probe() == locked);
  CHECK_FALSE(test::run_command(p.w, "remove_probe"));
}

TEST_CASE("a_mirrored_probe_is_a_copy_on_the_other_side_of_the_models_middle") {
  Probed p;
  p.add({0.7, 0.2, 0.1});
  p.probe().pose.turn = {0.1, 0.2, 0.3};
  CHECK(test::run_command(p.w, "mirror_probe"));
  REQUIRE(p.document().probes().all.size() == 2);
  CHECK(mesh::norm(p.probe(1).place - mesh::Point{-0.7, 0.2, 0.1}) < 1e-15);
  CHECK(p.probe(1).pose.turn == mesh::Point{0.1, -0.2, -0.3});
  CHECK(p.document().selection().indices() == std::vector<std::uint32_t>{1});
}

TEST_CASE("the_axis_of_symmetry_is_found") {
  // If a cube is deformed along two axes, it is symmetric only across the third axis.
  for (std::size_t kept = 0; kept < 3; ++kept) {
    mesh::Surface surface = test::CubeFiles::subdivided_cube();
    for (auto& p : surface.positions)
      for (std::size_t axis = 0; axis < 3; ++axis)
        if (axis != kept && p[axis] > 0) p[axis] *= 1 + 0.5 * std::abs(p[(axis + 1) % 3] + p[(axis + 2) % 3]);
    const Document document(test::surface_without_file(std::move(surface)));
    CHECK(symmetry_axis(document) == int(kept));
  }
}

TEST_CASE("influences_are_set_for_all_that_are_selected_and_radii_slide_as_one_edit") {
  Probed p;
  p.add({1, 0, 0});
  p.add({0, 1, 0});
  p.add({0, 0, 1});
  const double usual = p.probe().turn.radius;
  p.select({2});
  set_locked(p.document(), true);
  p.select({0, 1, 2});
  const auto edits = test::edit_count(p.document().history());
  for (const double radius : {0.1, 0.2, 0.3}) set_radius(p.document(), &Probe::turn, radius);
  CHECK(test::edit_count(p.document().history()) == edits + 1);
  CHECK(p.probe(0).turn == Influence{Falloff::smooth, 0.3});
  CHECK(p.probe(1).turn == Influence{Falloff::smooth, 0.3});
  CHECK(p.probe(2).turn == Influence{Falloff::smooth, usual});  // the probe is locked
  // A change of other probes, or of another part, is another edit. A new falloff keeps the radii.
  p.select({1});
  set_radius(p.document(), &Probe::turn, 0.5);
  set_radius(p.document(), &Probe::move, 0.6);
  CHECK(test::edit_count(p.document().history()) == edits + 3);
  p.select({0, 1});
  set_falloff(p.document(), &Probe::turn, Falloff::sharp);
  CHECK(test::edit_count(p.document().history()) == edits + 4);
  CHECK(p.probe(0).turn == Influence{Falloff::sharp, 0.3});
  CHECK(p.probe(1).turn == Influence{Falloff::sharp, 0.5});
  set_mix(p.document(), pose::ProbeMix::softmax);
  set_mix(p.document(), pose::ProbeMix::softmax);
  CHECK(test::edit_count(p.document().history()) == edits + 5);
  undo(p.document());
  CHECK(p.document().probes().mix == pose::ProbeMix::added);
  for (int i = 0; i < 3; ++i) undo(p.document());
  CHECK(p.probe(0).turn.radius == 0.3);
  CHECK(p.probe(1).turn.radius == 0.3);
}

TEST_CASE("a_model_of_one_point_can_have_probes") {
  test::CubeFiles files;
  test::put_file(files.model, "v 1 2 3\n");
  Workspace w;
  REQUIRE(test::load_model(w, files.model, {}));
  REQUIRE(add_probe(w.document, {}, {1, 2, 3}));
  CHECK(w.document.probes().all[0].turn.radius > 0);
  CHECK(least_probe_radius(w.document) > 0);
  REQUIRE(save_session(w, files / "a.viete"));
  Workspace back = test::opened({files / "a.viete"});
  CHECK(back.document.probes() == w.document.probes());
}

TEST_CASE("removing_the_last_probe_is_an_unsaved_edit") {
  Probed p(false);
  p.add({1, 0, 0});
  REQUIRE(save_session(p.w, p.files / "a.viete"));
  set_mask(p.document(), inverted(p.document()), "invert mask");
  CHECK(test::run_command(p.w, "remove_probe"));
  CHECK(has_unsaved_edits(p.w));
  undo(p.document());
  undo(p.document());
  CHECK_FALSE(has_unsaved_edits(p.w));
  CHECK(test::run_command(p.w, "remove_probe"));
  CHECK(has_unsaved_edits(p.w));
}

TEST_CASE("probes_are_picked_and_boxed_where_they_are_seen") {
  Probed p(false);
  p.frame();
  CHECK_FALSE(shows_selectable(p.w));
  p.add({0.9, 0.9, 0.9});
  p.add({-0.9, -0.9, 0.9});
  CHECK(shows_selectable(p.w));
  p.probe().pose.move = {0.2, 0, 0};
  const Projector project(p.document().space(), p.w.view.camera);
  const glm::vec2 at(*project(probe_center(p.document(), 0)));
  const auto pick = pick_element(p.document(), p.w.view.camera, at);
  REQUIRE(pick);
  CHECK(pick->index == 0);
  CHECK_FALSE(pick_element(p.document(), p.w.view.camera, at + glm::vec2(30, 0)));
  CHECK(pick_elements_in_box(p.document(), p.w.view.camera, {0, 0}, {1000, 800}) ==
        std::vector<std::uint32_t>{0, 1});
  CHECK(test::run_command(p.w, "select_all"));
  CHECK(p.document().selection().size() == 2);
  CHECK(test::run_command(p.w, "select_vertices"));
  CHECK(p.document().selection().empty());
  CHECK_FALSE(test::run_command(p.w, "select_all"));  // the document has no cage
}

TEST_CASE("probes_and_mask_are_unsaved_until_their_session_is_and_stay_with_another_cage_only") {
  for (const bool cage : {true, false}) {
    Probed p(cage);
    const auto change = [&](auto act) {
      CHECK_FALSE(has_unsaved_edits(p.w));
      act();
      CHECK(has_unsaved_edits(p.w));
      REQUIRE(save_session(p.w, p.files / "a.viete"));
    };
    change([&] { p.add({0.3, 1.0 / 3, -0.7}); });
    change([&] { set_mask(p.document(), inverted(p.document()), "invert mask"); });
    Workspace back = test::opened({p.files / "a.viete"});
    const auto is_kept = [&] {
      return back.document.probes() == p.document().probes() &&
             same_mask(back.document.mask(), p.document().mask());
    };
    CHECK(is_kept());
    CHECK_FALSE(has_unsaved_edits(back));
    REQUIRE(test::open_now(back, {OpenRequest::What::cage, {p.files.cage}}));
    CHECK(is_kept());
    CHECK(has_unsaved_edits(back));  // no session file has both the probes and this cage
    REQUIRE(test::open_now(back, {OpenRequest::What::model, {p.files.model, p.files.cage}}));
    CHECK(back.document.probes().empty());
    CHECK_FALSE(back.document.mask());
    CHECK_FALSE(has_unsaved_edits(back));
  }
}
