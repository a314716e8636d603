// Sessions restore the same picture; opening and saving with real events.
#include "mesh/formats/read.h"
#include "mesh/formats/write.h"
#include "program/kept_work.h"
#include "scene/workspace/saving.h"
#include "support/pictures.h"

using namespace viete;
using namespace test;

namespace {

double largest_difference(std::span<const mesh::Point> a, std::span<const mesh::Point> b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(a[i][k] - b[i][k]));
  }
  return largest;
}

std::string run(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>&1 </dev/null").c_str(), "r");
  REQUIRE(pipe);
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, n);
  const int status = pclose(pipe);
  return std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : 128) + " " + text;
}

std::string run_viete(const std::string& arguments, const fs::path& folder) {
  return run("cd '" + folder.string() + "' && '" + test::build_dir().string() + "/viete' " + arguments);
}

}  // namespace

TEST_CASE("a_session_opens_to_the_same_picture_also_elsewhere") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "work");
  fs::copy(dragon, folder / "work" / "dragon.ply");
  fs::copy(dragon_cage, folder / "work" / "cage.obj");
  render::Image before;
  std::vector<mesh::Point> mesh_before;
  {
    Driver d(test::with_pixels);
    REQUIRE(d.open({folder / "work" / "dragon.ply", folder / "work" / "cage.obj"}));
    d.settle();
    drag_some_vertex(d, {60, -50});
    d.drag({800, 100}, {730, 160}, 2);  // orbit
    d.move({800, 300});
    d.wheel(2);
    d.press_key(scene::key('L'));
    d.press_key(scene::key('T'));
    d.press_key(scene::key('2'), false, true);
    before = rest_picture(d);
    const auto positions = d.viewer().deformer()->positions();
    mesh_before.assign(positions.begin(), positions.end());
    REQUIRE(scene::save_session(d.workspace(), folder / "work" / "a.viete"));
  }
  fs::rename(folder / "work", folder / "moved");
  const fs::path here = fs::current_path();
  fs::current_path(folder / "moved");
  {
    Driver d(test::with_pixels);
    REQUIRE(d.open({"a.viete"}));
    const auto after = rest_picture(d);
    const auto positions = d.viewer().deformer()->positions();
    CHECK(std::equal(positions.begin(), positions.end(), mesh_before.begin(), mesh_before.end()));
    const double differing = test::difference(before, after, 0);
    if (differing > 0) {
      render::write_png(test::build_dir() / "session-before.png", before);
      render::write_png(test::build_dir() / "session-after.png", after);
    }
    CHECK(differing == 0);
  }
  fs::current_path(here);
}

TEST_CASE("render_and_deform_take_a_session_and_give_what_the_window_shows") {
  const test::TemporaryFolder folder;
  auto options = Driver::default_options();
  options.samples = 4;
  options.size = {800, 500};
  Driver d(options, test::with_pixels);
  d.workspace().view.panels = false;
  d.open_dragon();
  drag_some_vertex(d, {40, 30});
  d.workspace().tools = false;
  const auto before = rest_picture(d);
  REQUIRE(scene::save_session(d.workspace(), folder / "a.viete"));
  REQUIRE(run_viete("render a.viete --show-cage -o a.png", folder.path()).starts_with("0 "));
  CHECK(test::difference(before, test::read_png(folder / "a.png"), 0) == 0);
  REQUIRE(run_viete("deform a.viete -o a.obj", folder.path()).starts_with("0 "));
  // The window displays floats; exports are in double, from the window too. (A PLY would contain floats, like
  // its model.)
  const auto written = mesh::read(folder / "a.obj").surface.positions;
  CHECK(largest_difference(written, d.viewer().deformer()->positions()) < 2e-5 * d.document().cage->diagonal);
  CHECK(largest_difference(written, d.exact_positions()) < 1e-11 * d.document().cage->diagonal);
  d.workspace().requests.save_model = folder / "window.obj";
  d.frame();
  d.viewer().finish_exports();
  CHECK(largest_difference(written, mesh::read(folder / "window.obj").surface.positions) <
        1e-11 * d.document().cage->diagonal);

  REQUIRE(run_viete("render a.viete -o b.png --size 320x200 --light --look top", folder.path())
              .starts_with("0 "));
  CHECK(test::read_png(folder / "b.png").width == 320);
  CHECK(run_viete("deform a.viete -o b.obj --deformer mean-value", folder.path()).starts_with("0 "));
  CHECK(mesh::read(folder / "b.obj").surface.positions != mesh::read(folder / "a.obj").surface.positions);
}

TEST_CASE("a_session_on_the_command_line_stands_alone_and_its_errors_name_it") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a.viete", R"({"format": "viete session", "version": 1, "model": "gone.ply"})");
  CHECK(run_viete("render a.viete cage.obj -o a.png", folder.path()).starts_with("2 "));
  CHECK(run_viete("deform a.viete --pose p.obj -o a.ply", folder.path()).starts_with("2 "));
  CHECK(run_viete("a.viete cage.obj", folder.path()).starts_with("2 "));
  for (const char* line : {"render a.viete -o a.png", "deform a.viete -o a.ply", "a.viete"}) {
    const std::string said =
        run("cd '" + folder.path().string() + "' && env -u DISPLAY -u WAYLAND_DISPLAY '" +
            test::build_dir().string() + "/viete' " + line);
    CHECK_MESSAGE((said.starts_with("1 ") && said.find("a.viete: model: ") != std::string::npos &&
                   said.find("gone.ply: there is no such file") != std::string::npos),
                  said);
  }
}

TEST_CASE("a_moved_model_and_cage_are_named_to_every_command_that_takes_a_session") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d;
  REQUIRE(d.open({small.model, small.cage}));
  REQUIRE(scene::save_session(d.workspace(), folder / "a.viete"));
  fs::rename(small.model, folder / "new.ply");
  const auto said = [&](const std::string& arguments) {
    return run("cd '" + folder.path().string() + "' && env -u DISPLAY -u WAYLAND_DISPLAY '" +
               test::build_dir().string() + "/viete' " + arguments);
  };
  for (const std::string line :
       {"render a.viete --size 64x48 -o a.png", "deform a.viete -o a.ply",
        "animate a.viete --turntable --frames 1-1 --size 64x48 -o a_#.png", "view a.viete"}) {
    const std::string refused = said(line);
    CHECK_MESSAGE(
        refused.find("small.ply: there is no such file; give it with --model FILE") < refused.size(),
        refused);
    const std::string done = said(line + " --model new.ply");
    CHECK_MESSAGE(done.starts_with("0 "), line << done);
  }
  fs::rename(small.cage, folder / "grid.obj");
  const std::string refused = said("deform a.viete -o b.ply --model new.ply");
  CHECK_MESSAGE(refused.find("there is no such file; give it with --cage FILE") < refused.size(), refused);
  CHECK(said("deform a.viete -o b.ply --model new.ply --cage grid.obj").starts_with("0 "));
  CHECK(file_bytes(folder / "b.ply") == file_bytes(folder / "a.ply"));
  CHECK(said("deform a.viete -o new.ply --model new.ply --cage grid.obj").starts_with("1 "));
}

TEST_CASE("a_moved_model_is_located_in_the_window") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  deform::Pose pose;
  {
    Driver d;
    REQUIRE(d.open({small.model, small.cage}));
    d.settle();
    drag_some_vertex(d, {30, 20});
    pose = d.document().pose;
    REQUIRE(scene::save_session(d.workspace(), folder / "a.viete"));
  }
  fs::rename(small.model, folder / "new.ply");
  Driver other;
  CHECK_FALSE(other.open({folder / "a.viete"}));
  other.frame(2);
  other.click("question_save");
  other.frame(2);
  other.click("file/new.ply");
  other.click("file_choose");
  other.settle();
  CHECK(other.document().model.path == fs::canonical(folder / "new.ply"));
  CHECK(other.document().pose.positions == pose.positions);
}

TEST_CASE("a_session_is_saved_and_opened_with_the_keyboard_alone") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state"));
  REQUIRE(d.open({small.model, small.cage}));
  d.settle();
  drag_some_vertex(d, {30, 20});
  CHECK(scene::has_unsaved_edits(d.workspace()));
  const auto posed = d.document().pose.positions;
  d.press_key(scene::key('S'), true);
  d.frame(2);
  REQUIRE(d.workspace().browser.open);
  d.press_key(scene::Key::enter);
  d.frame(2);
  CHECK(fs::exists(folder / "small.viete"));
  CHECK_FALSE(scene::has_unsaved_edits(d.workspace()));
  d.press_key(scene::key('R'), true);
  CHECK(scene::has_unsaved_edits(d.workspace()));

  d.press_key(scene::key('O'), true);
  d.frame(2);
  d.type("small.v");
  d.press_key(scene::Key::enter);
  d.settle();
  CHECK_FALSE(d.workspace().browser.open);
  CHECK(d.document().pose.positions == posed);
  CHECK(d.workspace().saved.session.filename() == "small.viete");
}

TEST_CASE("the_list_is_walked_with_arrows_and_folders_with_enter_and_backspace") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  fs::create_directories(folder / "a_folder");
  Driver d;
  d.workspace().preferences.folder = folder.path();
  d.press_key(scene::key('O'), true);
  d.frame(2);
  const fs::path top = d.workspace().browser.folder;
  d.press_key(scene::Key::enter);
  d.frame(2);
  CHECK(d.workspace().browser.folder == top / "a_folder");
  d.press_key(scene::Key::backspace);
  d.frame(2);
  CHECK(d.workspace().browser.folder == top);
  d.press_key(scene::Key::down);
  d.press_key(scene::Key::enter);
  d.settle();
  CHECK(d.document().model.path.filename() == "small.ply");
  d.press_key(scene::key('O'), true);
  d.frame(2);
  d.press_key(scene::Key::escape);
  CHECK_FALSE(d.workspace().browser.open);
}
