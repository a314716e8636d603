// Sessions must restore equal pictures. Simulated events open and save files.
#include "formats/read.h"
#include "formats/write.h"
#include "program/command_line.h"
#include "program/kept_work.h"
#include "support/pictures.h"
#include "workspace/open_save.h"

using namespace viete;
using namespace test;

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
    d.press_key(workspace::key('L'));
    d.press_key(workspace::key('T'));
    d.press_key(workspace::key('2'), false, true);
    before = rest_picture(d);
    const auto positions = d.viewer().deformer()->positions();
    mesh_before.assign(positions.begin(), positions.end());
    REQUIRE(workspace::save_session(d.workspace(), folder / "work" / "a.viete"));
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
    CHECK(test::difference(before, after, 0) == 0);
  }
  fs::current_path(here);
}

TEST_CASE("render_and_deform_take_a_session_and_give_what_the_window_shows") {
  const WorkFolder folder;
  auto options = Driver::default_options({800, 500});
  options.samples = 4;
  Driver d(options, test::with_pixels);
  d.workspace().view.options.panels = false;
  d.open_dragon();
  drag_some_vertex(d, {40, 30});
  d.workspace().view.tools = false;
  const auto before = rest_picture(d);
  REQUIRE(workspace::save_session(d.workspace(), folder / "a.viete"));
  folder.done("render a.viete --show-cage -o a.png");
  CHECK(test::difference(before, test::read_png(folder / "a.png"), 0) == 0);
  folder.done("deform a.viete -o a.obj");
  // The window draws in single precision, but the exported OBJ has double precision.
  const auto written = formats::read(folder / "a.obj").surface.positions;
  CHECK(largest_distance(written, d.viewer().deformer()->positions()) < 2e-5 * d.document().cage()->diagonal);
  CHECK(largest_distance(written, d.exact_positions()) < 1e-11 * d.document().cage()->diagonal);
  d.save(workspace::SaveFile::Content::model, folder / "window.obj");
  CHECK(largest_distance(written, formats::read(folder / "window.obj").surface.positions) <
        1e-11 * d.document().cage()->diagonal);

  folder.done("render a.viete -o b.png --size 320x200 --light --look top");
  CHECK(test::read_png(folder / "b.png").width == 320);
  folder.done("deform a.viete -o b.obj --deformer mean-value");
  CHECK(formats::read(folder / "b.obj").surface.positions !=
        formats::read(folder / "a.obj").surface.positions);
}

TEST_CASE("a_session_on_the_command_line_stands_alone_and_its_errors_name_it") {
  const WorkFolder folder;
  test::put_file(folder / "a.viete", R"({"format": "viete session", "version": 1, "model": "gone.ply"})");
  folder.refused("render a.viete cage.obj -o a.png", 2, "the session a.viete has its own");
  for (const char* line : {"render a.viete -o a.png", "deform a.viete -o a.ply", "a.viete"}) {
    const Outcome outcome = run(line, without_display(folder.path()));
    CHECK(outcome.code == 1);
    for (const char* part : {"a.viete: model: ", "gone.ply: there is no such file"})
      CHECK_MESSAGE(mentions(outcome, part), outcome.text);
  }
}

TEST_CASE("a_moved_model_and_cage_are_named_to_every_command_that_takes_a_session") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d;
  REQUIRE(d.open({small.model, small.cage}));
  REQUIRE(workspace::save_session(d.workspace(), folder / "a.viete"));
  fs::rename(small.model, folder / "new.ply");
  const auto said = [&](const std::string& arguments) {
    return run(arguments, without_display(folder.path()));
  };
  for (const std::string line :
       {"render a.viete --size 64x48 -o a.png", "deform a.viete -o a.ply",
        "animate a.viete --turntable --frames 1-1 --size 64x48 -o a_#.png", "view a.viete"}) {
    const Outcome refused = said(line);
    CHECK_MESSAGE(mentions(refused, "small.ply: there is no such file; name the file with --model FILE"),
                  refused.text);
    const Outcome done = said(line + " --model new.ply");
    CHECK_MESSAGE(done.code == 0, line << done.text);
  }
  fs::rename(small.cage, folder / "grid.obj");
  CHECK(mentions(said("deform a.viete -o b.ply --model new.ply"),
                 "there is no such file; name the file with --cage FILE"));
  CHECK(said("deform a.viete -o b.ply --model new.ply --cage grid.obj").code == 0);
  CHECK(file_bytes(folder / "b.ply") == file_bytes(folder / "a.ply"));
  CHECK(said("deform a.viete -o new.ply --model new.ply --cage grid.obj").code == 1);
}

TEST_CASE("a_moved_model_is_located_in_the_window") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  pose::Pose pose;
  {
    Driver d;
    REQUIRE(d.open({small.model, small.cage}));
    d.settle();
    drag_some_vertex(d, {30, 20});
    pose = d.document().pose();
    REQUIRE(workspace::save_session(d.workspace(), folder / "a.viete"));
  }
  fs::rename(small.model, folder / "new.ply");
  Driver other;
  CHECK_FALSE(other.open({folder / "a.viete"}));
  other.frame(2);
  other.click("question_save");
  other.click("file/new.ply");
  other.click("file_choose");
  other.settle();
  CHECK(other.document().model().path == fs::canonical(folder / "new.ply"));
  CHECK(other.document().pose().positions == pose.positions);
}

TEST_CASE("a_session_is_saved_and_opened_with_the_keyboard_alone") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state"));
  REQUIRE(d.open({small.model, small.cage}));
  d.settle();
  drag_some_vertex(d, {30, 20});
  CHECK(workspace::has_unsaved_edits(d.workspace()));
  const auto posed = d.document().pose().positions;
  d.press_key(workspace::key('S'), true);
  REQUIRE(d.workspace().files.browser.open);
  d.press_key(workspace::Key::enter);
  CHECK(fs::exists(folder / "small.viete"));
  CHECK_FALSE(workspace::has_unsaved_edits(d.workspace()));
  d.press_key(workspace::key('R'), true);
  CHECK(workspace::has_unsaved_edits(d.workspace()));

  d.press_key(workspace::key('O'), true);
  d.type("small.v");
  d.press_key(workspace::Key::enter);
  d.settle();
  CHECK_FALSE(d.workspace().files.browser.open);
  CHECK(d.document().pose().positions == posed);
  CHECK(d.workspace().files.saved.session.filename() == "small.viete");
}

TEST_CASE("the_list_is_walked_with_arrows_and_folders_with_enter_and_backspace") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  fs::create_directories(folder / "a_folder");
  Driver d;
  d.workspace().preferences.folder = folder.path();
  d.press_key(workspace::key('O'), true);
  const fs::path top = d.workspace().files.browser.folder;
  d.press_key(workspace::Key::enter);
  CHECK(d.workspace().files.browser.folder == top / "a_folder");
  d.press_key(workspace::Key::backspace);
  CHECK(d.workspace().files.browser.folder == top);
  d.press_key(workspace::Key::down);
  d.press_key(workspace::Key::enter);
  d.settle();
  CHECK(d.document().model().path.filename() == "small.ply");
}
