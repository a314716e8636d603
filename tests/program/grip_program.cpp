// Pivot, axes, mirror and soft selection with real mouse and keyboard events.
#include <cmath>
#include <cstdlib>

#include "program/driver.h"
#include "scene/hand/shaping.h"
#include "scene/workspace/pointer.h"
#include "scene/workspace/saving.h"
#include "support/commands.h"
#include "support/edits.h"
#include "support/folder.h"

using namespace viete;
using test::Driver;

namespace {

struct Hand : Driver {
  explicit Hand(std::optional<test::WithPixels> pixels = pictures_wanted())
      : Driver(default_options(), pixels) {
    open_dragon();
  }
  explicit Hand(const std::filesystem::path& folder) {
    test::put_file(folder / "model.obj", box(1));
    test::put_file(folder / "cage.obj", box(1.5));
    REQUIRE(open({folder / "model.obj", folder / "cage.obj"}));
    settle();
  }
  static std::string box(double half) {
    std::string text;
    for (int i = 0; i < 8; ++i) {
      text += "v";
      for (int k = 0; k < 3; ++k) text += ' ' + std::to_string(i >> k & 1 ? half : -half);
      text += '\n';
    }
    return text + "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
  }

  std::vector<mesh::Point>& positions() { return document().pose.positions; }
  const std::vector<mesh::Point>& rest() { return document().cage->surface.positions; }
  std::vector<std::uint32_t> moved() {
    std::vector<std::uint32_t> all;
    for (std::uint32_t v = 0; v < positions().size(); ++v) {
      if (positions()[v] != rest()[v]) all.push_back(v);
    }
    return all;
  }
  // A paired vertex that is not covered by another one.
  std::uint32_t paired_vertex() {
    const scene::Mirror& mirror = *scene::mirror_of(workspace());
    for (std::uint32_t v = 0; v < positions().size(); ++v) {
      if (!mirror.is_paired(v)) continue;
      const auto pick = scene::pick_element(document(), workspace().camera, workspace().viewport, vertex(v));
      if (pick && pick->index == v) return v;
    }
    FAIL("no vertex is paired and to be seen");
    return 0;
  }
  // Starts a shape on the whole cage: by its button, then with the pointer in the view.
  void take_shape(const std::string& shape) {
    press_key('A');
    click(shape);
    move({700, 300});
    frame();
    REQUIRE(workspace().interaction.drag);
  }
  // Checks every vertex against the shape.
  void check_shaped(const scene::Shaping& shaping, double amount) {
    double farthest = 0;
    for (std::size_t v = 0; v < rest().size(); ++v)
      farthest = std::max(farthest, mesh::norm(positions()[v] - scene::shaped(shaping, amount, rest()[v])));
    CHECK(farthest < 1e-9 * document().space.diagonal());
  }
};

void keep_picture(Hand& d, const std::string& name) {
  if (const char* pictures = std::getenv("VIETE_PICTURES"))
    render::write_png(std::filesystem::path(pictures) / (name + ".png"), d.picture());
}

}  // namespace

TEST_CASE("a_mirrored_drag_moves_both_sides_in_one_edit") {
  const test::TemporaryFolder folder;
  Hand d(folder.path());
  d.choose("mirror", "mirror_x");
  d.frame(2);
  const scene::Mirror* mirror = scene::mirror_of(d.workspace());
  REQUIRE(mirror);
  const auto v = d.paired_vertex(), partner = mirror->partners[v];
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(35, -20));
  CHECK(d.moved() == std::vector<std::uint32_t>{std::min(v, partner), std::max(v, partner)});
  const auto way = d.positions()[v] - d.rest()[v];
  const auto image = scene::reflected_direction(mirror->plane, d.positions()[partner] - d.rest()[partner]);
  CHECK(mesh::norm(way - image) < 1e-9 * mesh::norm(way));
  CHECK(d.drawn_error() < 2e-5);
  CHECK(test::edit_count(d.document().history) == 1);
  d.press_key('Z', true);
  CHECK(d.moved().empty());
}

TEST_CASE("the_wheel_changes_the_soft_radius_during_a_drag") {
  Hand d;
  d.press_key('S');
  REQUIRE(d.workspace().handling.soft.on);
  const auto v = d.free_vertex();
  const double before = d.workspace().handling.soft.radius;
  d.press_and_move(d.vertex(v), d.vertex(v) + glm::vec2(30, -20));
  const auto few = d.moved();
  for (int i = 0; i < 8; ++i) d.wheel(1);
  const auto more = d.moved();
  CHECK(d.workspace().handling.soft.radius == doctest::Approx(before * std::pow(1.1, 8)));
  CHECK(few.size() >= 1);
  CHECK(more.size() > few.size());
  CHECK(d.drawn_error() < 2e-5);
  for (int i = 0; i < 60; ++i) d.wheel(-1);
  CHECK(d.moved() == std::vector<std::uint32_t>{v});
  CHECK(d.drawn_error() < 2e-5);
  d.button(0, false);
  d.frame(2);
  CHECK(test::edit_count(d.document().history) == 1);
  CHECK(d.drawn_error() < 2e-5);
  d.press_key('Z', true);
  CHECK(d.moved().empty());
}

TEST_CASE("a_click_places_the_pivot_snapped_to_a_vertex") {
  Hand d;
  const auto v = d.free_vertex();
  d.press_key('J');
  CHECK(d.workspace().interaction.placing_pivot);
  d.click(d.vertex(v) + glm::vec2(3, 2));
  CHECK_FALSE(d.workspace().interaction.placing_pivot);
  CHECK(d.workspace().handling.pivot == scene::Pivot::point);
  REQUIRE(d.workspace().handling.point);
  CHECK(*d.workspace().handling.point == d.positions()[v]);
  CHECK(d.document().selection.empty());
  d.press_key('A');
  d.press_key('E');
  d.frame(2);
  d.click("transform_y");
  d.type("90");
  d.press_key(scene::Key::enter);
  d.frame(3);
  CHECK(d.positions()[v] == d.rest()[v]);
  CHECK(d.moved().size() + 1 == d.positions().size());
}

TEST_CASE("esc_cancels_placing_a_pivot") {
  Hand d;
  d.press_key('J');
  d.press_key(scene::Key::escape);
  CHECK_FALSE(d.workspace().interaction.placing_pivot);
  const auto v = d.free_vertex();
  d.click(d.vertex(v));
  CHECK(d.document().selection.contains(v));
  CHECK(d.workspace().handling.pivot == scene::Pivot::median);
}

TEST_CASE("a_session_stores_handling_and_another_model_resets_the_pivot") {
  const test::TemporaryFolder folder;
  Hand d;
  scene::Handling& hand = d.workspace().handling;
  hand = {scene::Pivot::point,
          mesh::Point{0.25, 1, -3},
          scene::Axes::view,
          scene::MirrorPlane::x,
          {true, 0.4, scene::SoftCurve::sharp, scene::SoftDistance::space}};
  const scene::Handling chosen = hand;
  REQUIRE(scene::save_session(d.workspace(), folder / "a.viete"));
  hand = {};
  REQUIRE(d.open({folder / "a.viete"}));
  CHECK(hand == chosen);
  test::put_file(folder / "other.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  REQUIRE(d.open({folder / "other.obj"}));
  CHECK(hand.pivot == scene::Pivot::median);
  CHECK_FALSE(hand.point);
  CHECK(hand.mirror == scene::MirrorPlane::none);
}

TEST_CASE(
    "with Blender's keys G follows the cursor without a button, X and digits say how far, a click keeps it") {
  Hand d;
  scene::find_command("keys_blender")->run(d.workspace());
  const auto v = d.free_vertex();
  d.click(d.vertex(v));
  d.move(d.vertex(v) + glm::vec2(60, 60));
  d.press_key('G');
  REQUIRE(d.workspace().interaction.drag);
  d.move(d.vertex(v) + glm::vec2(90, 50));
  CHECK(d.moved() == std::vector<std::uint32_t>{v});
  d.type("x");
  d.type("2");
  d.frame();
  CHECK(d.positions()[v][0] == doctest::Approx(d.rest()[v][0] + 2));
  CHECK(d.positions()[v][1] == d.rest()[v][1]);
  d.button(0, true);
  d.button(0, false);
  d.frame();
  CHECK_FALSE(d.workspace().interaction.drag);
  CHECK(d.positions()[v][0] == doctest::Approx(d.rest()[v][0] + 2));
  CHECK(test::edit_count(d.document().history) == 1);
  d.press_key('R');
  d.move({700, 200});
  d.press_key(scene::Key::escape);
  CHECK_FALSE(d.workspace().interaction.drag);
  CHECK(test::edit_count(d.document().history) == 1);
  d.press_key('G');
  d.move({800, 300});
  d.button(1, true);
  d.button(1, false);
  CHECK_FALSE(d.workspace().interaction.drag);
  CHECK(d.positions()[v][0] == doctest::Approx(d.rest()[v][0] + 2));
}

TEST_CASE("the_twist_button_starts_when_the_pointer_enters_the_view") {
  Hand d;
  d.press_key('A');
  d.click("twist");
  CHECK_FALSE(d.workspace().interaction.drag);
  d.move({700, 300});
  d.frame();
  REQUIRE(d.workspace().interaction.drag);
  d.move({760, 300});
  CHECK_FALSE(d.moved().empty());
  d.type("90");
  d.press_key(scene::Key::enter);
  CHECK_FALSE(d.workspace().interaction.drag);
  CHECK_FALSE(d.moved().empty());
  d.press_key('Z', true);
  CHECK(d.moved().empty());
  d.click("bend");
  d.press_key(scene::Key::escape);
  d.move({700, 300});
  d.frame();
  CHECK_FALSE(d.workspace().interaction.drag);
}

TEST_CASE("an_axis_key_sets_the_bending_axis_and_pressing_it_again_uses_the_view_plane") {
  Hand d;
  d.take_shape("bend");
  const scene::Shaping seen = d.workspace().interaction.drag->grip().shaping;
  d.move({760, 300});
  d.type("y");
  d.frame();
  const scene::Shaping about = d.workspace().interaction.drag->grip().shaping;
  CHECK(about.hinge == *scene::hinge_near(seen, {0, 1, 0}));
  CHECK(about.hinge != seen.hinge);
  CHECK(d.workspace().interaction.drag->readout() == "Bend Y 30.0\u00b0");
  d.check_shaped(about, 30);
  keep_picture(d, "bend_about_y");
  d.type("60");
  d.check_shaped(about, 60);
  d.type("y");
  d.frame();
  CHECK(d.workspace().interaction.drag->grip().shaping.hinge == seen.hinge);
  d.check_shaped(seen, 60);
  d.type("Z");
  d.press_key(scene::Key::enter);
  CHECK_FALSE(d.workspace().interaction.drag);
  scene::Shaping about_z = seen;
  about_z.hinge = *scene::hinge_near(seen, {0, 0, 1});
  d.check_shaped(about_z, 60);
  CHECK(test::edit_count(d.document().history) == 1);
  d.press_key('Z', true);
  CHECK(d.moved().empty());
}

TEST_CASE("the_viewer_preset_orbits_with_the_left_button_on_empty_space") {
  Hand d;
  scene::find_command("keys_viewer")->run(d.workspace());
  const auto before = d.workspace().camera.pose();
  d.drag({400, 740}, {460, 720});
  CHECK(d.workspace().camera.pose().yaw != before.yaw);
  CHECK(d.document().selection.empty());
  const auto v = d.free_vertex();
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(20, 20));
  CHECK(d.moved() == std::vector<std::uint32_t>{v});
}

TEST_CASE("a_double_click_centers_the_orbit_target") {
  Hand d;
  const auto v = d.free_vertex();
  const glm::vec2 at = d.vertex(v);
  d.click(at);
  d.click(at);
  d.settle();
  d.frame(30);
  const auto& port = d.workspace().viewport;
  const glm::vec2 middle = port.origin + 0.5f * port.size;
  CHECK(glm::distance(d.vertex(v), middle) < 1.5f);
  d.drag({400, 740}, {480, 700}, 2);
  CHECK(glm::distance(d.vertex(v), middle) < 1.5f);
}

TEST_CASE("a_drag_right_after_a_click_is_not_a_double_click") {
  Hand d;
  const auto v = d.free_vertex();
  const auto before = d.workspace().camera.destination();
  d.click(d.vertex(v));
  d.click("strip/tool_select");  // without a gizmo
  d.click(d.vertex(v));
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(20, 20));
  CHECK(d.moved() == std::vector<std::uint32_t>{v});
  CHECK(d.workspace().camera.destination() == before);
}

TEST_CASE("soft_selection_fades_the_colour_of_cage_edges") {
  Hand d(test::with_pixels);
  const auto v = d.free_vertex();
  d.click(d.vertex(v));
  d.move({1270, 780});
  d.settle();
  const auto plain = d.picture();
  scene::find_command("toggle_soft")->run(d.workspace());
  d.settle();
  const auto soft = d.picture();
  if (const char* pictures = std::getenv("VIETE_PICTURES"))
    render::write_png(std::filesystem::path(pictures) / "soft_edges.png", soft);
  std::size_t changed = 0;
  for (const auto& [a, b] : d.document().cage->edges) {
    if (a != v && b != v) continue;
    const glm::ivec2 middle(glm::round(0.5f * (d.vertex(a) + d.vertex(b))));
    changed += plain.pixel(middle.x, middle.y) != soft.pixel(middle.x, middle.y);
  }
  CHECK(changed >= 3);
}

TEST_CASE("the_mirror_plane_is_shown_while_its_list_is_hovered_and_during_drags") {
  Hand d(test::with_pixels);
  scene::find_command("mirror_fit")->run(d.workspace());
  d.frame(3);
  if (!scene::mirror_of(d.workspace())) scene::find_command("mirror_x")->run(d.workspace());
  d.move({1270, 780});
  d.settle();
  const auto without = d.picture();
  d.move(d.place_of("mirror"));
  d.frame(3);
  d.settle();
  const auto with = d.picture();
  const auto differing = [](const render::Image& a, const render::Image& b) {
    std::size_t count = 0;
    for (int y = 60; y < 760; ++y) {
      for (int x = 330; x < 950; ++x) count += a.pixel(x, y) != b.pixel(x, y);
    }
    return count;
  };
  CHECK(differing(without, with) > 20000);  // a whole plane, not only lines between partners
  const auto v = d.paired_vertex();
  d.press_and_move(d.vertex(v), d.vertex(v) + glm::vec2(12, 0));
  d.settle();
  const auto dragged = d.picture();
  d.press_key(scene::Key::escape);
  d.button(0, false);
  CHECK(differing(without, dragged) > 20000);
  if (const char* pictures = std::getenv("VIETE_PICTURES")) {
    render::write_png(std::filesystem::path(pictures) / "mirror_plane.png", with);
    render::write_png(std::filesystem::path(pictures) / "mirror_plane_drag.png", dragged);
  }
}

TEST_CASE("a_right_click_in_the_palette_changes_a_key_persistently") {
  Hand d;
  scene::find_command("command_palette")->run(d.workspace());
  d.frame(2);
  d.type("undo");
  d.click(d.place_of("palette/undo"), 1);
  d.frame(2);
  REQUIRE(d.workspace().interaction.setting_key == "undo");
  d.press_key('U', true);
  CHECK(d.workspace().interaction.setting_key.empty());
  const auto v = d.free_vertex();
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(20, 20));
  REQUIRE(d.moved().size() == 1);
  d.press_key('Z', true);
  CHECK(d.moved().size() == 1);
  d.press_key('U', true);
  CHECK(d.moved().empty());
  const test::TemporaryFolder folder;
  scene::find_command("keys_blender")->run(d.workspace());
  scene::write_preferences(folder / "remembered.json", d.workspace().preferences);
  const auto read = scene::read_preferences(folder / "remembered.json");
  CHECK(read.keymap == d.workspace().preferences.keymap);
  CHECK(scene::text(read.keymap.of(*scene::find_command("undo")).first) == "Ctrl+U");
  CHECK(scene::text(read.keymap.of(*scene::find_command("grab")).first) == "G");
}
