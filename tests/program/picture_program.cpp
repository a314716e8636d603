// Compares pictures of the program with reviewed references (tests/program/pictures).
// In 99.9 % of the pixels, each channel may differ by at most 2 levels. Panels are masked or hidden, because
// each version of ImGui places text differently. Pictures of panels are references of version 1.86; with
// other versions, the mean colours of cells are compared. If VIETE_UPDATE_PICTURES is set, writes the
// pictures as new references: review these before committing.

#include "document/pose_edit.h"
#include "document/probes.h"
#include "program/open_cage.h"
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
  int levels = 2;        // the largest difference of a channel
  double share = 0.001;  // the fraction of pixels that may differ more
  int cell = 1;          // side of the cells whose mean colours are compared
};

const Tolerance of_text{.share = 0.0001};  // smaller, because a line of text has few pixels
// Other versions of ImGui shift text by a few pixels.
const Tolerance of_shifted_text{.levels = 24, .share = 0.01, .cell = 16};

struct Picture {
  const char* name;
  std::function<void(Driver&)> act;
  glm::ivec2 size{320, 220};
  bool panels = false, masked = false, dark = true;
  float scale = 1;
  Tolerance tolerance{};
};

void compare(const Picture& p) {
  auto options = Driver::default_options(p.size);
  options.scale = p.scale;
  Driver d(options, test::with_pixels);
  d.workspace().panels.has_user = false;  // hides messages
  auto& view = d.workspace().view.options;
  view.hints = view.axes = false;
  view.panels = p.panels;
  view.dark = p.dark;
  p.act(d);
  render::Image picture = d.picture();
  if (p.masked) mask_panels(picture, p.scale);
  const std::string name = p.name;
  const fs::path reference = test::source_dir() / "tests" / "program" / "pictures" / (name + ".png");
  if (std::getenv("VIETE_UPDATE_PICTURES")) {
    fs::create_directories(reference.parent_path());
    render::write_png(reference, picture);
    MESSAGE("wrote " << reference.string());
    return;
  }
  REQUIRE_MESSAGE(fs::exists(reference), reference.string());
  const int cell = p.tolerance.cell;
  const double differing = test::difference(
      test::shrunk(picture, cell), test::shrunk(test::read_png(reference), cell), p.tolerance.levels);
  if (differing > p.tolerance.share) render::write_png(test::build_dir() / (name + "-now.png"), picture);
  CHECK_MESSAGE(differing <= p.tolerance.share, name, ": compare with ", name,
                "-now.png in the build folder");
}

// Opens the dragon, and runs the commands.
std::function<void(Driver&)> dragon(const char* pose, std::vector<const char*> commands = {}) {
  return [=](Driver& d) {
    d.open_dragon(pose, test::bundled_dragon);
    for (const char* command : commands) CHECK_MESSAGE(test::run_command(d.workspace(), command), command);
    d.settle();
  };
}

// Selects three elements, and hides the model.
std::function<void(Driver&)> handles(const char* kind, const char* tool) {
  return [=](Driver& d) {
    auto& w = d.workspace();
    w.view.options.axes = true;
    w.view.options.model = w.view.options.grid = false;
    d.open_dragon("", test::bundled_dragon);
    test::run_command(w, kind);
    test::run_command(w, tool);
    w.document.changed_selection().apply(std::array<std::uint32_t, 3>{40, 41, 99},
                                         document::SelectMode::replace);
    d.frame(2);
  };
}

// Opens a textured sheet (glTF) in a box. The right end of the box is pulled forward.
void open_bent_sheet(Driver& d, const fs::path& folder) {
  render::Image image{64, 64, {}};
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) {
      const bool stripe = (x / 8 + y / 16) % 2 == 0;
      const std::uint8_t pixel[] = {std::uint8_t(stripe ? 225 : 60), std::uint8_t(stripe ? 120 : 90 + y),
                                    std::uint8_t(stripe ? 50 : 170), 255};
      image.rgba.insert(image.rgba.end(), pixel, pixel + 4);
    }
  mesh::Surface sheet;
  formats::Attributes attributes;
  constexpr std::uint32_t n = 24;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i) {
      sheet.positions.push_back({2.0 * i / n, 1 - 1.0 * j / n, 0.05});
      attributes.texture_points.push_back({1.0 * i / n, 1 - 1.0 * j / n});
    }
  std::vector<mesh::Triangle> triangles;
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t a = j * (n + 1) + i, b = a + 1, c = a + n + 1;
      triangles.insert(triangles.end(), {{a, c, b}, {b, c, c + 1}});
    }
  sheet = mesh::from_triangles(sheet.positions, triangles);
  attributes.corner_texture = sheet.corners;
  render::write_png(folder / "print.png", image);
  const fs::path file = folder / "sheet.gltf";
  formats::write(file, formats::Content{sheet, sheet.positions, {}, &attributes}, nullptr, {});
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
  formats::write(folder / "box.obj", box);
  for (const std::size_t v : {2, 5, 8, 11}) {
    box.positions[v][0] -= 0.3;
    box.positions[v][2] += 0.9;
  }
  formats::write(folder / "bent.obj", box);
  REQUIRE(d.open({file, folder / "box.obj", folder / "bent.obj"}));
}

void show_textured_sheet(Driver& d) {
  const test::TemporaryFolder folder;
  d.workspace().view.options.cage = false;
  open_bent_sheet(d, folder.path());
  CHECK(test::run_command(d.workspace(), "shading_file"));
  d.settle();
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
  d.workspace().view.brush.radius = 20;
  d.drag({140, 100}, {180, 115});
  d.settle();
}

void open_model_alone(Driver& d) {
  REQUIRE(d.open({test::bundled_dragon}));
  d.settle();
}

// Adds a probe that rotates the head.
void turn_a_probe(Driver& d) {
  d.open_dragon("", test::bundled_dragon);
  CHECK(test::run_command(d.workspace(), "view_right"));
  d.settle();
  document::Document& document = d.document();
  REQUIRE(document::add_probe(document, {}, {0.75, 1.35, 0}));
  document.changed_probes().all[0].pose = {{0.3, 0, 0.8}, {}, {0.1, 0.1, 0}};
  CHECK(test::run_command(d.workspace(), "tool_select"));
  d.settle();
}

const Picture views[] = {
    {"rest_dark", dragon(""), {720, 480}, true, true},
    {"rest_light_2x", dragon(""), {720, 480}, true, true, false, 2},
    {"hand_move_dark", handles("select_faces", "tool_move"), {720, 400}, true, true},
    {"hand_rotate_light_2x", handles("select_edges", "tool_rotate"), {720, 400}, true, true, false, 2},
    {"view_front", dragon("", {"view_front"})},
    {"view_top_orthographic", dragon("", {"view_top", "toggle_orthographic"})},
    {"wireframe", dragon("", {"toggle_wireframe", "toggle_cage"})},
    {"normals", dragon("pose_alert", {"shading_normals", "toggle_cage"})},
    {"model_alone", dragon("pose_alert", {"toggle_cage", "toggle_grid"})},
    {"posed_light", dragon("pose_alert", {"toggle_theme"})},
    {"ghost", dragon("pose_alert", {"toggle_ghost", "toggle_model"})},
    {"vertices_light", dragon("", {"select_vertices", "tool_select", "select_all", "toggle_theme"})},
    {"edges", dragon("", {"select_edges", "tool_select", "select_all"})},
    {"faces", dragon("", {"select_faces", "tool_select", "select_all"})},
    {"tool_move_light", dragon("", {"select_all", "tool_move", "toggle_theme"})},
    {"tool_rotate", dragon("", {"select_all", "tool_rotate"})},
    {"tool_scale_light", dragon("", {"select_all", "tool_scale", "toggle_theme", "toggle_model"})},
    {"textured", show_textured_sheet},
    {"hovered_vertex", hover_a_vertex},
    {"box_begun", begin_a_box},
    {"painted", paint_a_stroke},
    {"probe", turn_a_probe},
    {"model_without_cage", open_model_alone}};

// Replaces measured numbers and names of hardware, because they differ in each run.
void put_numbers(Driver& d) {
  auto& w = d.workspace();
  d.settle();
  w.about = {"1.2.3", "Release, GCC 12", "avx2", "a graphics card"};
  w.frame.methods = {
      .samples = {{{120, 3e-15, 2e-16}, {40, 2e-9, 4e-14}, {30, 6e-14, 7e-16}, {6, 8e-16, 1e-16}}},
      .matrices = 2048};
  w.frame.method_times = {.stages = {{{{0.01, 0.02, 20, 19.4, 1.2, 0, 0, 0, 0, 0, 0.1}},
                                      {{0.01, 0.02, 20, 18.1, 1.2, 0, 0, 0, 0, 0, 0.1}},
                                      {{0.01, 0.02, 20, 5.6, 1.2, 0, 0, 0, 0, 0, 0.1}},
                                      {{0.01, 0.02, 20, 3.1, 1.2, 0, 0, 0, 0, 0, 0.1}},
                                      {{0.01, 0.02, 0, 0, 0, 0.05, 0.2, 0, 0, 0, 0.1}}}},
                          .fused_error = 4e-6,
                          .measured = true};
  w.view.split.views[0].stats.clear();
  w.view.split.views[0].stats.add({.stages = {{0.01, 0.02, 0.03, 0.04, 0.05, 0.2, 0.1}},
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

void show_keys(Driver& d) {
  d.workspace().view.options.panels = false;
  d.press_key(workspace::Key::f1);
  put_numbers(d);
}

void show_browser(Driver& d) {
  d.frame();
  auto& browser = d.workspace().files.browser;
  browser.open = true;
  browser.path = browser.folder = "/home/ada/models";
  browser.entries = {{"cages", true}, {"armadillo.ply", false, 7'200'000}, {"bunny.obj", false, 812'000}};
  browser.highlighted = 0;
  put_numbers(d);
}

void show_cage_offer(Driver& d) {
  REQUIRE(d.open({test::bundled_dragon}));
  put_numbers(d);
}

void show_making(Driver& d) {
  REQUIRE(d.open({test::bundled_dragon}));
  d.settle();
  d.workspace().making.wish.kind = document::CageKind::box;
  d.workspace().making.wish.cells = {3, 2, 2};
  d.click("make_cage");
  d.finish_making();
  d.frame(3);
  d.move({1, 1});
  put_numbers(d);
}

const Picture texts[] = {
    {"panels", show_panels, {560, 1140}, true},
    {"checks", show_checks, {640, 640}, true},
    {"checks_light", show_checks, {640, 640}, true, false, false},
    {"keys", show_keys, {1400, 800}, true, false, true, 1, of_text},
    {"browser", show_browser, {960, 520}, true, false, true, 1, of_text},
    {"cage_offer", show_cage_offer, {860, 520}, true},
    {"cage_making", show_making, {860, 560}, true},
};

}  // namespace

TEST_CASE("pictures_are_as_they_were_when_someone_looked_at_them") {
  for (const auto& p : views) compare(p);
}

TEST_CASE("panels_are_drawn_as_they_were_when_someone_looked_at_them") {
  for (Picture p : texts) {
    if (IMGUI_VERSION_NUM != 18600) p.tolerance = of_shifted_text;
    compare(p);
  }
}
