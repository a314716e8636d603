// Tests the cached view. The program must draw the view again when the content of the view changes.

#include "interact/cursor_projection.h"
#include "program/small_scene.h"
#include "support/commands.h"
#include "support/pictures.h"

using namespace viete;
using test::Driver, test::small_options, test::SmallScene;

namespace {

app::ViewerOptions coarse_options(std::size_t moving_triangles) {
  auto options = small_options();
  options.may_be_coarse = true;
  options.moving_triangles = moving_triangles;
  return options;
}

glm::vec2 bare_place(Driver& d) {
  const auto& v = d.workspace().view.camera.viewport;
  return v.origin + glm::vec2(0.5f * v.size.x, v.size.y - 40);
}

// Makes random clicks, drags and commands.
class RandomInput {
public:
  RandomInput(Driver& driver, unsigned seed) : d(driver), random_(seed) {}

  void act() {
    switch (below(8)) {
      case 0: return d.move(near_vertex());
      case 1: return d.click(near_vertex());
      case 2: return drag(near_vertex(), 0);
      case 3: return drag(anywhere(), 1 + below(2));
      case 4: return d.wheel(static_cast<float>(below(5) - 2));
      case 5: return d.move(anywhere());
      default: return run_any_command();
    }
  }

  // Drags near a vertex, and leaves the button down.
  void drag_vertex() { press_and_move(near_vertex(), 0); }

private:
  int below(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)); }
  glm::vec2 anywhere() { return {below(700), below(420)}; }
  glm::vec2 near_vertex() {
    const auto count = static_cast<int>(d.document().pose().positions.size());
    const interact::Projector project(d.document().space(), d.workspace().view.camera);
    const auto at = project(d.document().pose().positions[static_cast<std::size_t>(below(count))]);
    return at ? glm::round(glm::vec2(*at)) : anywhere();
  }
  void press_and_move(glm::vec2 from, int button) {
    d.move(from);
    d.button(button, true);
    for (int i = 1; i <= 4; ++i) d.move(from + glm::vec2(9 * i, 5 * i - 12));
  }
  void drag(glm::vec2 from, int button) {
    press_and_move(from, button);
    if (below(2) == 0) d.button(button, false);
  }
  // Runs a random command that is not in the File menu. Drops wishes, and leaves full screen.
  void run_any_command() {
    const auto all = workspace::commands();
    const workspace::Command& command = all[static_cast<std::size_t>(below(static_cast<int>(all.size())))];
    auto& w = d.workspace();
    if (command.enabled(w) && command.group != "File") command.run(w);
    w.jobs.wishes = {};
    w.files.browser.open = w.view.full_screen = false;
    w.files.question.reset();
    d.frame();
  }

  Driver& d;
  std::mt19937 random_;
};

// The error of the whole model after a rest.
double error_at_rest(Driver& d) {
  std::this_thread::sleep_for(std::chrono::milliseconds(300));
  d.frame(8);
  return d.drawn_error();
}

double differs_from_a_fresh_one(Driver& d) {
  const render::Image kept = d.picture();
  d.viewer().redraw();
  return test::difference(kept, d.picture(), 0);
}

}  // namespace

TEST_CASE("the_cached_view_always_equals_a_fresh_drawing" * doctest::test_suite(test::longer)) {
  unsigned long kept = 0, drawn = 0;
  const int actions = test::rounds(12, 300);
  for (unsigned seed = 1; seed <= 4; ++seed) {
    auto options = small_options();
    options.may_be_coarse = seed % 2 == 0;
    if (seed == 4) options.moving_triangles = 300;
    options.samples = seed == 3 ? 4 : 0;
    SmallScene scene(options, test::with_pixels);
    scene.d.workspace().preferences.coarse_motion = true;
    RandomInput hand(scene.d, seed);
    for (int i = 0; i < actions; ++i) {
      CAPTURE(seed);
      CAPTURE(i);
      const auto before = scene.d.viewer().views_drawn();
      hand.act();
      ++(before == scene.d.viewer().views_drawn() ? kept : drawn);
      REQUIRE(differs_from_a_fresh_one(scene.d) == 0);
      scene.d.frame(i % 3);
      REQUIRE(differs_from_a_fresh_one(scene.d) == 0);
    }
  }
  CHECK(kept > 3);
  CHECK(drawn > 10);
}

TEST_CASE("a_hover_and_a_letter_change_panels_alone") {
  SmallScene scene(small_options(), test::with_pixels);
  Driver& d = scene.d;
  const auto views = d.viewer().views_drawn();
  const render::Image before = d.picture();
  d.move(d.place_of("method_diag"));
  d.move(d.place_of("method_sd"));
  d.frame(3);
  CHECK(test::difference(before, d.picture(), 0) > 0);
  d.press_key(workspace::key('K'), true);
  d.type("wire");
  CHECK(d.recorder().find("palette/toggle_wireframe"));
  CHECK(d.viewer().views_drawn() == views);
  d.press_key(workspace::Key::enter);
  CHECK(d.viewer().views_drawn() > views);
  d.viewer().resize({690, 420}, 1);
  d.frame();
  CHECK(d.viewer().has_drawn());
}

TEST_CASE("large_models_move_with_fewer_triangles_and_rest_with_all") {
  const auto pictures = [](std::size_t moving_triangles, document::Shading shading) {
    SmallScene scene(coarse_options(moving_triangles), test::with_pixels);
    Driver& d = scene.d;
    d.workspace().preferences.coarse_motion = true;
    d.workspace().view.options.panels = false;
    d.workspace().view.options.shading = shading;
    std::vector<render::Image> pictures;
    for (int step = 0; step < 3; ++step) {
      auto pose = d.workspace().view.camera.pose();
      pose.yaw += 0.1F;
      d.workspace().view.camera.set_pose(pose);
      auto& corner = d.workspace().document.changed_pose().positions[0];
      corner = corner + mesh::Vec3{0.2, 0, 0};
      d.frame();
    }
    CHECK(d.viewer().view_fineness() == app::Fineness::coarse);
    pictures.push_back(d.picture());
    const auto in_motion = d.viewer().deformer()->positions();
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
    d.frame(6);
    CHECK(d.viewer().view_fineness() == app::Fineness::plain);
    CHECK((d.viewer().deformer()->positions() != in_motion) ==
          (moving_triangles < 2000 && d.workspace().about.software));  // only the draft was deformed
    pictures.push_back(d.picture());
    return pictures;
  };
  const bool software = SmallScene(small_options()).d.workspace().about.software;
  for (const auto shading : {document::Shading::file, document::Shading::normals}) {
    const auto few = pictures(1200, shading), all = pictures(2'000'000, shading);
    if (software) CHECK(test::difference(few[0], all[0], 8) > 0.0005);
    CHECK(test::difference(few[0], all[0], 60) < 0.1);
    CHECK(test::difference(few[1], all[1], 10) == 0);  // the shadow is always that of the draft
  }
}

TEST_CASE("after_any_drags_of_a_draft_the_model_has_the_current_pose") {
  SmallScene scene(coarse_options(300));
  Driver& d = scene.d;
  RandomInput hand(d, 1);
  for (int i = 0; i < 6; ++i) {
    CAPTURE(i);
    hand.drag_vertex();
    if (i % 2 == 0) CHECK(d.viewer().view_fineness() == app::Fineness::coarse);
    CHECK(error_at_rest(d) < 1e-5);  // the button is still down
    d.button(0, false);
    if (i % 3 > 0) CHECK(error_at_rest(d) < 1e-5);
  }
}

TEST_CASE("software_rendering_draws_motion_coarsely_and_refines_at_rest") {
  auto options = coarse_options(2'000'000);
  options.still_samples = 4;
  SmallScene scene(options);
  Driver& d = scene.d;
  const auto orbit = [&] { d.press_and_move(bare_place(d), bare_place(d) + glm::vec2(60, 0), 2); };
  const auto rest = [&] {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(2);
    while (d.viewer().view_fineness() != app::Fineness::smooth && std::chrono::steady_clock::now() < end) {
      if (d.viewer().wants_frame()) d.frame();
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    return d.viewer().view_fineness() == app::Fineness::smooth;
  };
  d.workspace().preferences.coarse_motion = true;
  orbit();
  CHECK(d.viewer().view_fineness() == app::Fineness::coarse);
  CHECK(rest());  // the mouse button is still down
  d.button(2, false);
  d.workspace().preferences.coarse_motion = false;
  orbit();
  CHECK(d.viewer().view_fineness() == app::Fineness::plain);
  d.button(2, false);
  d.workspace().preferences.coarse_motion.reset();
  orbit();
  CHECK((d.viewer().view_fineness() == app::Fineness::coarse) == d.workspace().about.software);
}
