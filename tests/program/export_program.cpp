// Exports deformed models in the background.
#include "document/pose_edit.h"
#include "document/time_edit.h"
#include "formats/point_cache.h"
#include "formats/read.h"
#include "program/kept_work.h"
#include "support/commands.h"
#include "support/pictures.h"
#include "support/text.h"

using namespace viete;
using namespace test;

namespace {

const std::string saved = "Saved ", old = "v 0 0 0\n";

// A posed model, so large that an export takes many frames.
struct LargeModel : Driver {
  explicit LargeModel(const fs::path& folder, int level = 7) : Driver(small_window()) {
    formats::write(folder / "large.ply", ball(1, level));
    formats::write(folder / "cage.obj", ball(1.4, 1));
    REQUIRE(open({folder / "large.ply", folder / "cage.obj"}));
    workspace().view.options.model = false;  // drawing the model would take longer than the export
    settle();
    drag_some_vertex(*this, {20, 10});
  }
  static app::ViewerOptions small_window() {
    auto options = Driver::default_options({640, 400});
    options.program = build_dir() / "viete";
    return options;
  }
  void ask_for(const fs::path& file) {
    workspace().jobs.wishes.save(workspace::SaveFile::Content::model, file);
    frame();
  }
};

}  // namespace

TEST_CASE("a_background_export_has_the_pose_at_the_request") {
  const test::TemporaryFolder folder;
  LargeModel d(folder.path());
  const auto expected = d.exact_positions();
  const fs::path file = folder / "out.ply";
  d.ask_for(file);
  CHECK(d.viewer().exporting());
  CHECK(d.workspace().jobs.exporting.what == "Exporting out.ply");
  drag_some_vertex(d, {-40, 25});  // the program still reacts
  double furthest = 0;
  REQUIRE(d.until([&] {
    const auto& exporting = d.workspace().jobs.exporting;
    CHECK((d.last_message().find(saved) == std::string::npos || fs::exists(file)));
    if (exporting.running) CHECK(exporting.done >= furthest);
    furthest = std::max(furthest, exporting.done);
    return !d.viewer().exporting();
  }));
  CHECK(d.last_message() == "Saved out.ply.");
  CHECK(formats::read(file).surface.positions == expected);
  CHECK(d.exact_positions() != expected);
}

TEST_CASE("a_cancelled_export_changes_no_file") {
  const test::TemporaryFolder folder;
  LargeModel d(folder.path());
  const fs::path file = folder / "out.obj";
  test::put_file(file, old);
  const auto before = folder.entries();
  d.workspace().jobs.wishes.save(workspace::SaveFile::Content::model, file);
  d.workspace().jobs.wishes.add(  // in the frame that starts the export
      workspace::CancelWork{workspace::CancelWork::Work::exporting});
  d.frame();
  REQUIRE(d.until([&] { return !d.viewer().exporting(); }));
  CHECK(d.last_message() == "Cancelled exporting out.obj; no file was changed.");
  CHECK(test::file_bytes(file) == old);
  CHECK(folder.entries() == before);

  d.ask_for(file);
  CHECK_FALSE_MESSAGE(test::run_command(d.workspace(), "stop_work"), "Esc is not for what runs beside work");
  REQUIRE(d.until([&] { return !d.viewer().exporting(); }));
}

TEST_CASE("an_animation_is_exported_aside") {
  const test::TemporaryFolder folder;
  LargeModel d(folder.path(), 6);
  d.workspace().document.put_frame(1);
  REQUIRE(test::run_command(d.workspace(), "set_key"));
  drag_some_vertex(d, {-40, 25});
  document::set_key(d.document(), 600);
  const fs::path file = folder / "out.pc2";
  d.save(workspace::SaveFile::Content::animation, file);
  CHECK(d.last_message() == "Saved out.pc2.");
  const auto& all = d.workspace().messages.all();
  CHECK(all[all.size() - 2].text.starts_with("out.pc2: 600 frames of "));
  CHECK_FALSE(all[all.size() - 2].visible);
  CHECK(formats::PointCache(file).head().frames == 600);
}

TEST_CASE("pictures_of_what_plays_are_drawn_aside_as_the_window_looks_at_them") {
  const test::TemporaryFolder folder;
  LargeModel d(folder.path(), 4);
  d.workspace().document.put_frame(1);
  document::set_key(d.document(), 1);
  pose::Pose pose = d.document().pose();
  for (auto& p : pose.positions) p[1] *= 1.3;
  document::set_pose(d.document(), pose);
  document::set_key(d.document(), 3);
  d.document().changed_timeline().last = 3;
  d.workspace().view.options.model = true;
  d.workspace().jobs.wishes.save(workspace::SaveFile::Content::animation, folder / "f_##.png");
  d.frame();
  CHECK(d.workspace().jobs.exporting.what == "Exporting f_##.png");
  REQUIRE(d.until([&] { return !d.viewer().exporting(); }));
  CHECK_MESSAGE(d.last_message().starts_with("Saved f_##.png"), d.last_message());
  const auto& messages = d.workspace().messages.all();
  CHECK(messages[messages.size() - 2].text.starts_with("ffmpeg -framerate 24 -start_number 1 -i '"));
  const auto first = test::read_png(folder / "f_01.png"), last = test::read_png(folder / "f_03.png");
  CHECK(first.width == 640);
  CHECK(first.height == 400);
  CHECK(first.rgba != last.rgba);
  CHECK(fs::exists(folder / "f_02.png"));
  CHECK_FALSE(fs::exists(folder / "f_04.png"));

  // Changes theme and size in the dialog. By default, cage and panels are not drawn.
  d.run("save_animation");
  d.press_key('A', true);
  d.type((folder / "h_##.png").string());
  d.click("picture_light");
  REQUIRE(d.workspace().files.browser.pictures);
  CHECK_FALSE(d.workspace().files.browser.pictures->cage);
  CHECK_FALSE(d.workspace().files.browser.pictures->panels);
  d.workspace().files.browser.pictures->width = 200;
  d.workspace().files.browser.pictures->height = 120;
  d.press_key(workspace::Key::enter);
  REQUIRE(d.until([&] { return !d.viewer().exporting(); }));
  const auto other = test::read_png(folder / "h_01.png");
  CHECK(other.width == 200);
  CHECK(other.height == 120);
  const auto brightness = [](const render::Image& image) { return int{image.rgba[0]}; };
  CHECK(brightness(other) > brightness(first) + 60);
  test::put_file(folder / "g_02.png", "somebody's");
  d.save(workspace::SaveFile::Content::animation, folder / "g_##.png");
  CHECK(d.workspace().messages.all().back().severity == workspace::Severity::error);
  CHECK(test::mentions(d.last_message(), "g_02.png"));
  CHECK(test::file_bytes(folder / "g_02.png") == "somebody's");
}
