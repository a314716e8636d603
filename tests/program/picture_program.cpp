// Pictures of the program against pictures that someone looked at (tests/program/pictures).
//
// Tolerance: at most 2 levels per channel for 99.9 % of pixels, panels masked or hidden, because versions of
// ImGui move text. A missing reference, or VIETE_UPDATE_PICTURES=1, writes the picture instead: look at it
// before you commit it.
#include <cstdlib>

#include "program/driver.h"
#include "render/image.h"

using namespace viete;
using test::Driver;
namespace fs = std::filesystem;

namespace {

void mask_panels(render::Image& image, float scale) {
  const int column = static_cast<int>(320 * scale), status = static_cast<int>(26 * scale);
  for (int y = 0; y < image.height; ++y) {
    const int end = y >= image.height - status ? image.width : column;
    std::fill_n(image.rgba.begin() + 4 * std::ptrdiff_t(y) * image.width, 4 * end, std::uint8_t{0});
  }
}

void compare(const std::string& name, render::Image picture, bool panels, float scale) {
  if (panels) mask_panels(picture, scale);
  const fs::path reference = test::source_dir() / "tests" / "program" / "pictures" / (name + ".png");
  if (std::getenv("VIETE_UPDATE_PICTURES")) {
    fs::create_directories(reference.parent_path());
    render::write_png(reference, picture);
    MESSAGE("wrote " << reference.string());
    return;
  }
  REQUIRE_MESSAGE(fs::exists(reference), reference.string());
  const double differing = render::difference(picture, render::read_png(reference), 2);
  if (differing > 0.001) render::write_png(test::build_dir() / (name + "-now.png"), picture);
  CHECK_MESSAGE(differing <= 0.001, name, ": compare with ", name, "-now.png in the build folder");
}

struct Scene {
  const char* name;
  const char* pose;
  bool panels, dark;
  float scale;
};

}  // namespace

TEST_CASE("pictures_are_as_they_were_when_someone_looked_at_them") {
  const Scene scenes[] = {{"rest_dark", "", true, true, 1},
                          {"rest_light_2x", "", true, false, 2},
                          {"posed_dark", "pose_alert.obj", false, true, 1}};
  for (const auto& s : scenes) {
    CAPTURE(s.name);
    auto options = Driver::default_options();
    options.size = {720, 480};
    options.scale = s.scale;
    Driver d(options);
    d.workspace().view.panels = s.panels;
    d.workspace().view.dark = s.dark;
    d.workspace().view.hints = false;
    d.workspace().view.axes = false;
    d.open_dragon();
    if (*s.pose) REQUIRE(d.open({test::dragon.parent_path() / s.pose}, Driver::What::pose));
    d.settle();
    compare(s.name, d.picture(), s.panels, s.scale);
  }
}

TEST_CASE("the_hand_is_drawn_as_it_was_when_someone_looked_at_it") {
  const struct {
    const char* name;
    const char* tool;
    const char* kind;
    bool dark;
    float scale;
  } hands[] = {{"hand_move_dark", "tool_move", "select_faces", true, 1},
               {"hand_rotate_light_2x", "tool_rotate", "select_edges", false, 2}};
  for (const auto& h : hands) {
    CAPTURE(h.name);
    auto options = Driver::default_options();
    options.size = {720, 400};
    options.scale = h.scale;
    Driver d(options);
    auto& w = d.workspace();
    w.view.dark = h.dark;
    w.view.hints = w.view.model = w.view.grid = false;
    d.open_dragon();
    scene::run_command(w, h.kind);
    scene::run_command(w, h.tool);
    w.document.selection.apply(std::array<std::uint32_t, 3>{40, 41, 99}, scene::SelectMode::replace);
    d.frame(2);
    compare(h.name, d.picture(), true, h.scale);
  }
}

namespace {

// Small and without panels or text: what is open, and the commands that follow.
struct ViewPicture {
  const char* name;
  const char* pose;
  std::vector<const char*> commands;
};

const ViewPicture views[] = {
    {"view_front", "", {"view_front"}},
    {"view_top_orthographic", "", {"view_top", "toggle_orthographic"}},
    {"view_left_light", "", {"view_left", "toggle_theme"}},
    {"wireframe", "", {"toggle_wireframe", "toggle_cage"}},
    {"model_alone", "pose_alert", {"toggle_cage", "toggle_grid"}},
    {"posed_light", "pose_alert", {"toggle_theme"}},
    {"ghost", "pose_alert", {"toggle_ghost", "toggle_model"}},
    {"posed_linear", "pose_alert", {"scheme_linear", "toggle_cage"}},
    {"posed_mean_value", "pose_alert", {"scheme_mvc", "toggle_cage"}},
    {"vertices_light", "", {"select_vertices", "tool_select", "select_all", "toggle_theme"}},
    {"edges", "", {"select_edges", "tool_select", "select_all"}},
    {"faces", "", {"select_faces", "tool_select", "select_all"}},
    {"tool_move_light", "", {"select_all", "tool_move", "toggle_theme"}},
    {"tool_rotate", "", {"select_all", "tool_rotate"}},
    {"tool_scale_light", "", {"select_all", "tool_scale", "toggle_theme", "toggle_model"}},
};

}  // namespace

TEST_CASE("views_and_tools_are_drawn_as_they_were_when_someone_looked_at_them") {
  for (const auto& v : views) {
    CAPTURE(v.name);
    auto options = Driver::default_options();
    options.size = {320, 220};
    Driver d(options);
    auto& view = d.workspace().view;
    view.hints = view.axes = view.panels = false;
    d.open_dragon(v.pose);
    for (const char* command : v.commands) CHECK_MESSAGE(scene::run_command(d.workspace(), command), command);
    d.settle();
    compare(v.name, d.picture(), false, 1);
  }
}
