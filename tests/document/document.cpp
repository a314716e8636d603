#include "document/document.h"

#include "support/files.h"
#include "support/shapes.h"

using namespace viete;
using namespace viete::document;
using namespace viete::files;
using namespace viete::workspace;
namespace fs = std::filesystem;

namespace {

DocumentState at(double x) {
  DocumentState state;
  state.pose.positions = {{x, 0, 0}};
  return state;
}
double x_of(const DocumentState& s) {
  return s.pose.positions[0][0];
}

}  // namespace

TEST_CASE("sizes_that_float_can_draw_and_double_can_deform_are_told_from_those_that_they_cannot") {
  const test::CubeFiles files;
  const fs::path model = files / "sized.obj", cage = files / "sized_cage.obj";
  for (const double size : {1e-61, 1e-59, 1e-33, 1e-30, 1.0, 1e30, 1e33, 1e59, 1e61}) {
    CAPTURE(size);
    formats::write(model, test::cube(size));
    formats::write(cage, test::cube(1.5 * size));
    auto document = open_document(model, cage);
    const auto refused = doctest::Contains("sized.obj: a size of");
    if (size > 1e-31 && size < 1e31) {
      CHECK_NOTHROW(check_drawable(document));
    } else {
      CHECK_THROWS_WITH_AS(check_drawable(document), refused, base::Error);
      Workspace w;
      CHECK_FALSE(test::load_model(w, model, {}));
      CHECK_FALSE(w.document.model().surface);
    }
    if (size > 1e-60 && size < 1e60) {
      CHECK_NOTHROW(check_deformable(document));
      document.changed_pose().positions[0][1] = 1e61;
      CHECK_THROWS_WITH_AS(check_deformable(document), doctest::Contains("sized_cage.obj: a size"),
                           base::Error);
    } else {
      CHECK_THROWS_WITH_AS(check_deformable(document), refused, base::Error);
    }
  }
  auto point = test::cube(0);
  for (auto& p : point.positions) p[2] = 1e70;
  formats::write(model, point);
  CHECK_THROWS_AS(check_deformable(open_document(model, {})), base::Error);
}

TEST_CASE("a_broken_file_leaves_the_open_document_as_it_was_and_says_why") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  const auto* surface = w.document.model().surface.get();
  w.document.changed_pose().positions[0][0] += 1;
  const auto pose = w.document.pose().positions;
  const auto topology = w.document.revisions().surfaces;
  CHECK_FALSE(test::load_model(w, files.broken, {}));
  CHECK_FALSE(test::load_model(w, files.model, files.broken));
  CHECK_FALSE(test::load_cage(w, files.broken));
  CHECK_FALSE(test::load_cage(w, files / "missing.obj"));
  CHECK_FALSE(test::load_pose(w, files.broken));
  formats::write(files / "far.obj", test::cube(1e40));
  CHECK_FALSE(test::load_pose(w, files / "far.obj"));
  CHECK(w.document.model().surface.get() == surface);
  CHECK(w.document.pose().positions == pose);
  CHECK(w.document.revisions().surfaces == topology);
  CHECK(w.messages.all().back().severity == Severity::error);
  for (const char* name : {"broken.obj", "missing.obj", "cannot be drawn"})
    CHECK(std::ranges::any_of(w.messages.all(),
                              [&](const Message& m) { return m.text.find(name) != std::string::npos; }));
}

TEST_CASE("a_pose_or_a_cage_without_a_document_is_refused_with_advice") {
  const test::CubeFiles files;
  Workspace w;
  CHECK_FALSE(test::load_cage(w, files.cage));
  CHECK_FALSE(test::load_pose(w, files.pose));
  CHECK(w.messages.all().back().text.find("open the cage first") != std::string::npos);
}

TEST_CASE("every_model_has_diagonal_two_in_view_wherever_it_is_and_however_large") {
  for (const double size : {1e-30, 1.0, 1e30})
    for (const double offset : {0.0, 1e7}) {
      const mesh::Bounds box{{offset * size, 0, 0}, {(offset + 3) * size, 4 * size, 0}};
      const auto space = document::space_for(box);
      const glm::vec3 a = space.to_view(box.low), b = space.to_view(box.high);
      CHECK(glm::distance(a, b) == doctest::Approx(2).epsilon(1e-6));
      CHECK(glm::length(a + b) < 1e-6f);
    }
  CHECK(document::space_for({{1, 2, 3}, {1, 2, 3}}).to_view({1, 2, 3}) == glm::vec3(0));
}

TEST_CASE("a_binding_names_the_triangles_that_the_panel_counts") {
  Document document = test::cube_document();
  test::put_cage(document, test::cube());
  const std::string plan = binding_plan(document, pose::default_deformer().weighting);
  CHECK(plan.starts_with("Binding 8 vertices to 12 triangles, "));
}

TEST_CASE("grid_cell_is_a_round_number_that_suits_the_model") {
  CHECK(document::grid_cell(20) == doctest::Approx(1));
  CHECK(document::grid_cell(2.9) == doctest::Approx(0.1));
  CHECK(document::grid_cell(90) == doctest::Approx(5));
  CHECK(document::grid_cell(1e-6) == doctest::Approx(5e-8));
  CHECK(document::grid_cell(0) == 1);
}

TEST_CASE("undo_and_redo_walk_the_same_path_among_the_listed_edits_until_a_new_edit_ends_redo") {
  History h;
  CHECK_FALSE(h.can_undo());
  for (int i = 0; i < 4; ++i) h.record("edit " + std::to_string(i), at(i));
  const std::vector<std::string> all = {"edit 0", "edit 1", "edit 2", "edit 3"};
  CHECK(h.labels() == all);
  CHECK(h.undo_label() == "edit 3");
  for (int i = 3; i >= 0; --i) CHECK(x_of(h.undo(at(i + 1))) == i);
  CHECK_FALSE(h.can_undo());
  for (int i = 1; i <= 2; ++i) CHECK(x_of(h.redo(at(i - 1))) == i);
  CHECK(h.labels() == all);
  CHECK(h.position() == 2);
  CHECK(h.redo_label() == "edit 2");
  h.record("other", at(2));
  CHECK_FALSE(h.can_redo());
}

TEST_CASE("a_cancelled_edit_keeps_redo") {
  History h;
  h.record("one", at(0));
  h.undo(at(1));
  const unsigned long before = h.recorded();
  h.record("slide", at(0));
  CHECK(h.recorded() == before + 1);
  CHECK_FALSE(h.can_redo());
  CHECK(x_of(h.drop_last()) == 0);
  CHECK(h.recorded() == before);
  CHECK_FALSE(h.can_undo());
  CHECK(x_of(h.redo(at(0))) == 1);
}

TEST_CASE("no_number_of_clicks_takes_an_edit_out_of_reach") {
  History h;
  const auto mask = std::make_shared<const std::vector<float>>(5u << 20, 1.0f);  // 20 MB, so few states fit
  const auto state = [&](double x) {
    DocumentState s = at(x);
    s.mask = mask;
    return s;
  };
  h.record("one", state(0));
  h.record("two", state(1));
  for (int i = 0; i < 100; ++i) h.record_selection(state(2));
  int steps = 0;
  DocumentState now = state(2);
  while (h.can_undo() && h.undo_label() == "select") {
    now = h.undo(now);
    ++steps;
  }
  CHECK(steps < 20);
  REQUIRE(h.undo_label() == "two");
  now = h.undo(now);
  CHECK(x_of(now) == 1);
  REQUIRE(h.undo_label() == "one");
  now = h.undo(now);
  CHECK(x_of(now) == 0);
  while (h.can_redo()) now = h.redo(now);
  CHECK(x_of(now) == 2);
}
