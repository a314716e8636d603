// Compares pictures of the program with reviewed references (tests/program/pictures).
//
// Tolerance: at most 2 levels per channel for 99.9 % of pixels. Panels are masked or hidden, because versions
// of ImGui move text; cases that test panels are skipped for other versions. A missing reference, or
// VIETE_UPDATE_PICTURES=1, writes the picture instead: review it before committing.
#include <cstdlib>

#include "mesh/formats/write.h"
#include "mesh/triangulation.h"
#include "program/open_cage.h"
#include "render/image.h"
#include "scene/document/edit.h"
#include "scene/document/pose_edit.h"
#include "scene/document/probes.h"
#include "support/commands.h"
#include "support/folder.h"
#include "support/pictures.h"

using namespace viete;
using test::Driver;
namespace fs = std::filesystem;

namespace {

void mask_panels(render::Image& image, float scale) {
  const int strip = static_cast<int>(60 * scale), bar = static_cast<int>(26 * scale);
  const int column = image.width - static_cast<int>(322 * scale);
  for (int y = 0; y < image.height; ++y) {
    const bool in_bar = y < bar || y >= image.height - bar;
    const auto row = image.rgba.begin() + 4 * std::ptrdiff_t(y) * image.width;
    std::fill_n(row, 4 * (in_bar ? image.width : strip), std::uint8_t{0});
    std::fill_n(row + 4 * std::ptrdiff_t(column), 4 * (image.width - column), std::uint8_t{0});
  }
}

struct Tolerance {
  int levels = 2;        // per channel
  double share = 0.001;  // fraction of pixels that may exceed it
};

void compare(const std::string& name, render::Image picture, bool panels, float scale,
             Tolerance tolerance = {}) {
  if (panels) mask_panels(picture, scale);
  const fs::path reference = test::source_dir() / "tests" / "program" / "pictures" / (name + ".png");
  if (std::getenv("VIETE_UPDATE_PICTURES")) {
    fs::create_directories(reference.parent_path());
    render::write_png(reference, picture);
    MESSAGE("wrote " << reference.string());
    return;
  }
  REQUIRE_MESSAGE(fs::exists(reference), reference.string());
  const double differing = test::difference(picture, test::read_png(reference), tolerance.levels);
  if (differing > tolerance.share) render::write_png(test::build_dir() / (name + "-now.png"), picture);
  CHECK_MESSAGE(differing <= tolerance.share, name, ": compare with ", name, "-now.png in the build folder");
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
    Driver d(options, test::with_pixels);
    d.workspace().has_user = false;  // versions of ImGui move text
    d.workspace().view.panels = s.panels;
    d.workspace().view.dark = s.dark;
    d.workspace().view.hints = false;
    d.workspace().view.axes = false;
    d.open_dragon("", test::bundled_dragon);
    if (*s.pose) REQUIRE(d.open({test::dragon_cage.parent_path() / s.pose}, Driver::What::pose));
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
    Driver d(options, test::with_pixels);
    d.workspace().has_user = false;  // versions of ImGui move text
    auto& w = d.workspace();
    w.view.dark = h.dark;
    w.view.hints = w.view.model = w.view.grid = false;
    d.open_dragon("", test::bundled_dragon);
    test::run_command(w, h.kind);
    test::run_command(w, h.tool);
    w.document.selection.apply(std::array<std::uint32_t, 3>{40, 41, 99}, scene::SelectMode::replace);
    d.frame(2);
    compare(h.name, d.picture(), true, h.scale);
  }
}

namespace {

// Small, without panels or text: the files to open, and the commands to run.
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
    {"normals", "pose_alert", {"shading_normals", "toggle_cage"}},
    {"model_alone", "pose_alert", {"toggle_cage", "toggle_grid"}},
    {"posed_light", "pose_alert", {"toggle_theme"}},
    {"ghost", "pose_alert", {"toggle_ghost", "toggle_model"}},
    {"posed_linear", "pose_alert", {"blend_linear", "toggle_cage"}},
    {"posed_biharmonic", "pose_alert", {"weights_biharmonic", "toggle_cage"}},
    {"posed_mean_value", "pose_alert", {"weights_mean_value", "toggle_cage"}},
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
    Driver d(options, test::with_pixels);
    d.workspace().has_user = false;  // versions of ImGui move text
    auto& view = d.workspace().view;
    view.hints = view.axes = view.panels = false;
    d.open_dragon(v.pose, test::bundled_dragon);
    for (const char* command : v.commands) CHECK_MESSAGE(test::run_command(d.workspace(), command), command);
    d.settle();
    compare(v.name, d.picture(), false, 1);
  }
}

namespace {

// A textured sheet in a glTF, in a box whose right end was pulled forward.
void open_bent_sheet(Driver& d, const fs::path& folder) {
  render::Image image{64, 64, {}};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool stripe = (x / 8 + y / 16) % 2 == 0;
      const std::uint8_t pixel[] = {std::uint8_t(stripe ? 225 : 60), std::uint8_t(stripe ? 120 : 90 + y),
                                    std::uint8_t(stripe ? 50 : 170), 255};
      image.rgba.insert(image.rgba.end(), pixel, pixel + 4);
    }
  }
  mesh::Surface sheet;
  mesh::Attributes attributes;
  constexpr std::uint32_t n = 24;
  for (std::uint32_t j = 0; j <= n; ++j) {
    for (std::uint32_t i = 0; i <= n; ++i) {
      sheet.positions.push_back({2.0 * i / n, 1 - 1.0 * j / n, 0.05});
      attributes.texture_points.push_back({1.0 * i / n, 1 - 1.0 * j / n});
    }
  }
  std::vector<mesh::Triangle> triangles;
  for (std::uint32_t j = 0; j < n; ++j) {
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1;
      triangles.insert(triangles.end(), {{a, c, b}, {b, c, c + 1}});
    }
  }
  sheet = mesh::from_triangles(sheet.positions, triangles);
  attributes.corner_texture = sheet.corners;
  render::write_png(folder / "print.png", image);
  const fs::path file = folder / "sheet.gltf";
  mesh::write(file, mesh::Content{sheet, sheet.positions, {}, &attributes}, nullptr, {});
  std::string text = test::file_bytes(file);
  text.insert(text.find("\"attributes\""), "\"material\": 0, ");
  text.insert(1, R"("images": [{"uri": "print.png"}], "textures": [{"source": 0}], )"
                 R"("materials": [{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],)");
  test::put_file(file, text);
  mesh::Surface box;
  for (int i = 0; i < 12; ++i)
    box.positions.push_back({-0.2 + 1.2 * (i % 3), i < 6 ? 1.2 : -0.2, i / 3 % 2 ? 0.5 : -0.4});
  box.corners = {0, 3, 4, 1, 1, 4, 5,  2, 6, 7,  10, 9, 7, 8, 11, 10, 0, 1, 7,  6,
                 1, 2, 8, 7, 3, 9, 10, 4, 4, 10, 11, 5, 0, 6, 9,  3,  2, 5, 11, 8};
  for (std::uint32_t i = 0; i <= 10; ++i) box.polygon_starts.push_back(4 * i);
  mesh::triangulate(box);
  mesh::write(folder / "box.obj", box);
  for (const std::size_t v : {2, 5, 8, 11}) box.positions[v][0] -= 0.3, box.positions[v][2] += 0.9;
  mesh::write(folder / "bent.obj", box);
  REQUIRE(d.open({file, folder / "box.obj", folder / "bent.obj"}));
}

}  // namespace

TEST_CASE("textures_are_drawn_as_they_were_when_someone_looked_at_them") {
  const struct {
    const char* name;
    const char* command;
  } looks[] = {
      {"textured", "shading_file"}, {"checker", "shading_checker"}, {"textured_clay", "shading_clay"}};
  for (const auto& look : looks) {
    CAPTURE(look.name);
    const test::TemporaryFolder folder;
    auto options = Driver::default_options();
    options.size = {320, 220};
    Driver d(options, test::with_pixels);
    d.workspace().has_user = false;  // versions of ImGui move text
    auto& view = d.workspace().view;
    view.hints = view.axes = view.panels = view.cage = false;
    open_bent_sheet(d, folder.path());
    CHECK(test::run_command(d.workspace(), look.command));
    d.settle();
    compare(look.name, d.picture(), false, 1);
  }
}

namespace {

// The actions before the picture.
struct Picture {
  const char* name;
  glm::ivec2 size;
  void (*act)(Driver&);
  Tolerance tolerance{};
};

// A kernel with fused multiply-add rounds differently and gives other errors; a line of text has few pixels.
const Tolerance of_errors{.levels = 24}, of_text{.share = 0.0001};

void compare_after(const Picture& p, bool panels, bool dark) {
  auto options = Driver::default_options();
  options.size = p.size;
  Driver d(options, test::with_pixels);
  d.workspace().has_user = false;  // versions of ImGui move text
  auto& view = d.workspace().view;
  view.hints = view.axes = false;
  view.panels = panels;
  view.dark = dark;
  p.act(d);
  compare(p.name, d.picture(), false, 1, p.tolerance);
}

void hover_a_vertex(Driver& d) {
  d.open_dragon("", test::bundled_dragon);
  d.move(d.vertex(d.free_vertex()));
}

void begin_a_box(Driver& d) {
  d.open_dragon("", test::bundled_dragon);
  d.press_and_move({20, 20}, {180, 140});
}

void paint_a_stroke(Driver& d) {
  d.open_dragon("", test::bundled_dragon);
  d.press_key('D');
  d.workspace().brush.radius = 20;
  d.drag({140, 100}, {180, 115});
  d.settle();
}

void open_model_alone(Driver& d) {
  REQUIRE(d.open({test::bundled_dragon}));
  d.settle();
}

// At the head, rotating it.
void turn_a_probe(Driver& d) {
  d.open_dragon("", test::bundled_dragon);
  CHECK(test::run_command(d.workspace(), "view_right"));
  d.settle();
  scene::Document& document = d.document();
  REQUIRE(scene::add_probe(document, {}, {0.75, 1.35, 0}));
  document.changed_probes().all[0].pose = {{0.3, 0, 0.8}, {}, {0.1, 0.1, 0}};
  CHECK(test::run_command(d.workspace(), "tool_select"));
  d.settle();
}

const Picture gestures[] = {{"hovered_vertex", {320, 220}, hover_a_vertex},
                            {"box_begun", {320, 220}, begin_a_box},
                            {"painted", {320, 220}, paint_a_stroke},
                            {"probe", {320, 220}, turn_a_probe},
                            {"model_without_cage", {320, 220}, open_model_alone}};

}  // namespace

TEST_CASE("gestures_are_drawn_as_they_were_when_someone_looked_at_them") {
  for (const auto& p : gestures) compare_after(p, false, true);
}

namespace {

// Replaces measured numbers and machine names, which differ in each run.
void put_numbers(Driver& d) {
  auto& w = d.workspace();
  d.settle();
  w.about = {"1.2.3", "Release, GCC 12", "avx2", "a graphics card"};
  w.methods = {.samples = {{{120, 3e-15, 2e-16}, {40, 2e-9, 4e-14}, {30, 6e-14, 7e-16}, {6, 8e-16, 1e-16}}},
               .matrices = 2048};
  w.method_times = {.links = {{{{0.01, 0.02, 20, 19.4, 1.2, 0, 0, 0, 0, 0, 0.1}},
                               {{0.01, 0.02, 20, 18.1, 1.2, 0, 0, 0, 0, 0, 0.1}},
                               {{0.01, 0.02, 20, 5.6, 1.2, 0, 0, 0, 0, 0, 0.1}},
                               {{0.01, 0.02, 0, 0, 0, 0.05, 0.2, 0, 0, 0, 0.1}}}},
                    .measured = true};
  w.stats.clear();
  w.stats.add({.links = {{0.01, 0.02, 0.03, 0.04, 0.05, 0.2, 0.1}},
               .upload = 0.3,
               .draw = 2,
               .panels = 0.4,
               .frame = 3.5});
  d.frame(2);
}

void show_panels(Driver& d) {
  d.open_dragon("pose_alert", test::bundled_dragon);
  put_numbers(d);
}

void show_checks(Driver& d) {
  const test::TemporaryFolder folder;
  REQUIRE(d.open({test::bundled_dragon, test::open_cage(folder.path())}));
  d.settle();
  d.click("section/Model");
  d.click("section/Cage");
  d.click("finding/0");
  d.move({1, 1});
  put_numbers(d);
}

// Nearly uniform stretch on one side, where SD loses digits.
void show_error_map(Driver& d) {
  d.open_dragon("", test::bundled_dragon);
  deform::Pose pose = d.document().pose;
  for (auto& p : pose.positions) {
    if (p[0] > 0) p = {1.2 * p[0], (1.2 - 1e-5) * p[1], (1.2 + 1e-5) * p[2]};
  }
  scene::set_pose(d.document(), pose);
  for (const char* command : {"method_sd", "toggle_error_map", "toggle_cage"})
    CHECK(test::run_command(d.workspace(), command));
  put_numbers(d);
}

void show_keys(Driver& d) {
  d.workspace().view.panels = false;
  d.press_key(scene::Key::f1);
  put_numbers(d);
}

void show_browser(Driver& d) {
  d.frame();
  auto& browser = d.workspace().browser;
  browser.open = true;
  browser.path = browser.folder = "/home/ada/models";
  browser.entries = {{"cages", true}, {"armadillo.ply", false, 7'200'000}, {"bunny.obj", false, 812'000}};
  browser.highlighted = 0;
  put_numbers(d);
}

void show_choice(Driver& d, const char* chooser, const char* entry) {
  d.frame(3);
  for (const char* title : {"Model", "Cage"}) d.click(std::string("section/") + title);
  put_numbers(d);
  d.click(chooser);
  d.frame(2);
  d.move(d.place_of(entry));
  d.frame(3);
}
void show_ways(Driver& d) {
  show_choice(d, "way", "way_arap");
}
void show_weights(Driver& d) {
  show_choice(d, "weights", "weights_cutoff");
}
void show_blend(Driver& d) {
  show_choice(d, "blend", "blend_linear");
}

void show_cage_offer(Driver& d) {
  REQUIRE(d.open({test::bundled_dragon}));
  put_numbers(d);
}

void show_making(Driver& d) {
  REQUIRE(d.open({test::bundled_dragon}));
  d.settle();
  d.workspace().making.wish.kind = scene::CageKind::box;
  d.workspace().making.wish.cells = {3, 2, 2};
  d.click("make_cage");
  d.frame();
  d.finish_making();
  d.frame(3);
  d.move({1, 1});
  put_numbers(d);
}

// Cage editing, with the outside vertices of the model shown.
void show_outside(Driver& d) {
  const test::TemporaryFolder folder;
  mesh::Surface small = mesh::read(test::dragon_cage).surface;
  for (auto& p : small.positions) p = {0.85 * p[0], 0.85 * p[1], 0.85 * p[2]};
  mesh::write(folder / "small.obj", small);
  REQUIRE(d.open({test::bundled_dragon, folder / "small.obj"}));
  d.settle();
  d.viewer().finish_checks();
  d.frame(3);
  for (const char* command : {"strip/edit_cage", "show_outside"}) d.click(command);
  d.settle();
  d.click("section/Model");
  d.move({1, 1});
  put_numbers(d);
}

const Picture texts[] = {
    {"panels", {560, 1140}, show_panels},
    {"checks", {640, 640}, show_checks},
    {"error_map", {860, 480}, show_error_map, of_errors},
    {"keys", {1400, 800}, show_keys, of_text},
    {"browser", {960, 520}, show_browser, of_text},
    {"choice_way", {640, 480}, show_ways},
    {"choice_blend", {640, 560}, show_blend},
    {"cage_offer", {860, 520}, show_cage_offer},
    {"cage_making", {860, 560}, show_making},
    {"cage_outside", {860, 800}, show_outside},
};

const Picture light_texts[] = {
    {"checks_light", {640, 640}, show_checks},
    {"choice_weights_light", {640, 480}, show_weights},
    {"error_map_light", {860, 480}, show_error_map, of_errors},
};

}  // namespace

// Reference made with ImGui 1.86; other versions move text.
TEST_CASE("panels_are_drawn_as_they_were_when_someone_looked_at_them" *
          doctest::test_suite(test::if_present)) {
  if (IMGUI_VERSION_NUM != 18600)
    return test::skip("pictures of text are of ImGui 1.86, this is " IMGUI_VERSION);
  for (const auto& p : texts) compare_after(p, true, true);
  for (const auto& p : light_texts) compare_after(p, true, false);
}
