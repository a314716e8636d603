#include "scene/hand/gizmo.h"

#include <doctest/doctest.h>

#include "scene/cube.h"
#include "scene/hand/grip.h"
#include "support/grips.h"

using namespace viete;
using namespace viete::scene;
using Kind = Constraint::Kind;

namespace {

DragGuides guides(Tool tool, Constraint constraint, const char* typed) {
  Workspace w = test::cube_workspace();
  w.document.selection.select_all(8);
  TransformDrag drag(w.document, test::plain_grip(w.document), tool, constraint, 1, {700, 390}, w.camera);
  for (; *typed; ++typed) drag.type(*typed);
  drag.update(w.document, {{710, 390}}, w.camera, w.viewport);
  return drag_guides(drag, w.document.space, w.camera, w.viewport);
}

}  // namespace

TEST_CASE("moves_and_scales_show_the_axes_they_go_along") {
  CHECK(guides(Tool::move, {Kind::axis, 1}, "").axes == std::vector<int>{1});
  CHECK(guides(Tool::scale, {Kind::plane, 1}, "").axes == std::vector<int>{0, 2});
  CHECK(guides(Tool::move, {}, "").axes.empty());
  CHECK(guides(Tool::move, {}, "").arc.empty());
  for (const auto& d : guides(Tool::move, {Kind::plane, 0}, "").axis_directions)
    CHECK(glm::length(d) == doctest::Approx(1));
}

TEST_CASE("turns_show_the_sector_they_sweep_and_count_whole_turns") {
  const DragGuides some = guides(Tool::rotate, {Kind::axis, 1}, "60");
  CHECK(some.whole_turns == 0);
  CHECK(some.circle.empty());
  CHECK(some.arc.size() > 10);
  const DragGuides many = guides(Tool::rotate, {Kind::axis, 1}, "780");
  CHECK(many.whole_turns == 2);
  CHECK(glm::distance(many.arc.back(), some.arc.back()) < 0.01f);
  CHECK(glm::distance(many.circle.front(), many.circle.back()) < 0.01f);
}
