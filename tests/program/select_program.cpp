// Selecting over a dense cage with real events: box, lasso and brush.
#include <cmath>

#include "mesh/formats/write.h"
#include "program/driver.h"
#include "scene/ball.h"
#include "scene/document/edit.h"
#include "scene/hand/cursor_projection.h"
#include "support/folder.h"
#include "support/pictures.h"

using namespace viete;
using test::Driver;

namespace {

struct Selecting : Driver {
  explicit Selecting(std::optional<test::WithPixels> pixels = {}) : Driver(default_options(), pixels) {
    mesh::write(folder / "ball.obj", test::ball(1));
    mesh::write(folder / "cage.obj", test::ball(1.15));
    REQUIRE(open({folder / "ball.obj", folder / "cage.obj"}));
    settle();
    REQUIRE(document().pose.positions.size() == 2562);
  }

  test::TemporaryFolder folder;

  std::uint32_t front() {
    const scene::Projector project(document().space, workspace().camera, workspace().viewport);
    const auto& points = document().pose.positions;
    std::uint32_t best = 0;
    for (std::uint32_t v = 0; v < points.size(); ++v) {
      if (project(points[v])->z < project(points[best])->z) best = v;
    }
    return best;
  }
  std::size_t selected() { return document().selection.size(); }
  // Pixels of the view in the amber of selected vertices.
  int amber() {
    const render::Image picture = this->picture();
    int count = 0;
    for (int y = 0; y < picture.height - 30; ++y) {
      for (int x = 330; x < picture.width; ++x) {
        const auto p = picture.pixel(x, y);
        count += p[0] > 200 && p[1] > 130 && p[1] < 210 && p[2] < 90;
      }
    }
    return count;
  }
};

}  // namespace

TEST_CASE("a_box_over_a_dense_cage_selects_and_moves_nothing_with_and_without_shift") {
  Selecting d(test::with_pixels);
  const glm::vec2 at = glm::round(d.vertex(d.front()));
  CHECK(d.amber() == 0);
  d.drag(at, at + glm::vec2(80, 60));
  CHECK(d.selected() > 10);
  CHECK_FALSE(scene::differs_from_rest(d.document()));
  const std::size_t before = d.selected();
  d.move({700, 20});
  CHECK(d.amber() > 200);
  d.key(Driver::left_shift, true);
  d.drag(at, at - glm::vec2(80, 60));
  d.key(Driver::left_shift, false);
  CHECK(d.selected() > before + 10);
  CHECK_FALSE(scene::differs_from_rest(d.document()));
}

TEST_CASE("at_the_start_every_vertex_of_the_dragons_cage_can_be_dragged_at_once") {
  Driver d;
  d.open_dragon();
  for (std::uint32_t v = 0; v < d.document().pose.positions.size(); ++v)
    CHECK_FALSE(is_crowded(d.document(), d.workspace().camera, d.workspace().viewport, d.vertex(v)));
}

TEST_CASE("b_arms_a_box_that_begins_on_the_gizmo_and_the_keys_of_lasso_and_brush_work") {
  Selecting d;
  d.press_key('A');
  REQUIRE(d.selected() == 2562);
  const glm::vec2 middle = glm::round(scene::gizmo_of(d.workspace())->center);
  d.press_key('B');
  CHECK(d.workspace().interaction.armed == scene::SelectShape::box);
  d.press_key(scene::Key::escape);
  CHECK_FALSE(d.workspace().interaction.armed);
  d.press_key('B');
  d.drag(middle, middle + glm::vec2(60, 60));
  CHECK(d.selected() > 0);
  CHECK(d.selected() < 400);
  CHECK_FALSE(scene::differs_from_rest(d.document()));

  d.press_key('B', false, true);
  d.move(middle + glm::vec2(90, 0));
  d.button(0, true);
  for (int i = 1; i <= 24; ++i) {
    const float a = 6.2f * static_cast<float>(i) / 24;
    d.move(glm::floor(middle + 90.0f * glm::vec2(std::cos(a), std::sin(a))));
  }
  REQUIRE(d.workspace().interaction.lasso);
  d.button(0, false);
  d.frame();
  CHECK(d.selected() > 60);

  d.press_key('C', false, true);
  const float radius = d.workspace().interaction.select_radius;
  d.move(middle);
  d.wheel(2);
  CHECK(d.workspace().interaction.select_radius > radius);
  d.key(Driver::left_ctrl, true);
  d.drag(middle - glm::vec2(100, 0), middle + glm::vec2(100, 0));
  d.key(Driver::left_ctrl, false);
  const std::size_t left = d.selected();
  d.drag(middle - glm::vec2(100, 0), middle + glm::vec2(100, 0));
  CHECK(d.selected() > left);
  d.press_key(scene::Key::escape);
  CHECK_FALSE(d.workspace().interaction.armed);
  CHECK_FALSE(scene::differs_from_rest(d.document()));
}

TEST_CASE("z_makes_the_mouse_select_only_what_is_seen") {
  Selecting d;
  const glm::vec2 corner(330, 760), opposite(955, 40);
  d.drag(corner, opposite);
  CHECK(d.selected() == 2562);
  d.press_key('Z');
  d.drag(corner, opposite);
  CHECK(d.selected() < 1400);
  CHECK(d.selected() > 800);
}

TEST_CASE("selecting_is_undone_hidden_and_kept_as_a_set_by_keys_and_buttons") {
  Selecting d(test::with_pixels);
  d.press_key('A');
  d.press_key('Z', true);
  CHECK(d.selected() == 0);
  d.press_key('Z', true, true);
  CHECK(d.selected() == 2562);
  const glm::vec2 at = glm::round(d.vertex(d.front()));
  d.press_key('B');
  d.drag(at, at + glm::vec2(80, 60));
  const std::size_t few = d.selected();
  CHECK(few > 10);
  CHECK(few < 100);
  d.click("save_set");
  d.press_key(scene::Key::up, true);
  CHECK(d.selected() > few);
  d.press_key('A', false, true);
  CHECK(d.selected() == 0);
  d.click("set/0/select");
  CHECK(d.selected() == few);
  CHECK(d.amber() > 100);
  d.press_key('H', false, true);
  d.move({700, 20});
  d.frame(2);
  CHECK(d.amber() == 0);
  d.press_key('A');
  CHECK(d.selected() == 2562 - few);
  d.press_key('H', true);
  CHECK(d.document().groups.hidden.empty());
  d.click("set/0/remove");
  CHECK(d.document().groups.sets.empty());
  d.press_key('Z', true);
  CHECK(d.document().groups.sets.size() == 1);
  CHECK_FALSE(scene::differs_from_rest(d.document()));
}
