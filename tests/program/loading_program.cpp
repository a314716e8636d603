// Large files read in the background, and failed loads.
#include "program/kept_work.h"
#include "scene/workspace/saving.h"
#include "support/edits.h"

using namespace viete;
using namespace test;
using What = scene::OpenRequest::What;

namespace {

// Runs frames until the progress bar is visible; false if the file was read too quickly for it.
bool sees_loading_bar(Driver& d) {
  bool seen = false;
  d.frame();  // takes the request
  REQUIRE(d.until([&] {
    seen = d.viewer().recorder().find("stop_work").has_value();
    return seen || !d.viewer().loading();
  }));
  return seen;
}

}  // namespace

TEST_CASE("a_large_file_is_read_aside_with_progress_and_can_be_cancelled") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state", {640, 400}));
  const scene::OpenRequest request{What::model, {folder / "large.obj"}};

  // 348,000 vertices, 36 MB of text; fast machines get more.
  int cells = 240;
  const mesh::Surface* surface = nullptr;
  for (;; cells *= 2) {
    REQUIRE_MESSAGE(cells < 1000, "5.5 million vertices were read within 0.2 s");
    mesh::write(folder / "large.obj", SmallModel::grid_ball(cells));
    REQUIRE(d.open({small.model, small.cage}));
    d.settle();
    drag_some_vertex(d, {20, 10});
    surface = d.document().model.surface.get();
    d.workspace().requests.open = request;
    if (!sees_loading_bar(d)) continue;
    CHECK(d.workspace().loading.what == "Reading large.obj");
    CHECK(d.document().model.surface.get() == surface);
    d.viewer().input().push(platform::InputEvent::key(ui::key_code(scene::Key::escape), true));
    d.viewer().input().push(platform::InputEvent::key(ui::key_code(scene::Key::escape), false));
    REQUIRE(d.until([&] { return !d.viewer().loading(); }));
    if (d.document().model.surface.get() == surface) break;
  }
  CHECK(test::edit_count(d.document().history) == 1);
  CHECK(d.workspace().messages.all().back().text.find("Cancelled reading") != std::string::npos);

  double furthest = 0;
  for (int i = 0; i < 20 && furthest <= 0.1; ++i) {  // it may be read between two frames
    d.workspace().requests.open = request;
    double last = 0;
    d.frame();
    REQUIRE(d.until([&] {
      const auto& loading = d.workspace().loading;
      if (loading.running) CHECK(loading.done >= last);
      last = std::max(last, loading.done);
      return !d.viewer().loading();
    }));
    furthest = std::max(furthest, last);
  }
  CHECK(furthest > 0.1);
  CHECK(d.document().model.summary.vertices == static_cast<std::size_t>(6 * (cells + 1) * (cells + 1)));
}

TEST_CASE("loaded_files_are_applied_after_the_drag") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state"));
  REQUIRE(d.open({small.model, small.cage}));
  d.settle();
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.press_and_move(at, at + glm::vec2(40, 5));
  d.workspace().requests.open = scene::OpenRequest{What::model, {dragon, dragon_cage}};
  for (int i = 0; i < 20; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    d.frame();
  }
  CHECK(d.document().model.path == small.model);
  d.button(0, false);
  REQUIRE(d.until([&] { return d.document().model.path == dragon; }));
  CHECK_MESSAGE(d.workspace().recovery_files.size() == 1, "the drag that was finished is kept");
}

TEST_CASE("a_load_that_fails_leaves_everything_as_it_was") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  test::put_file(folder / "broken.obj", "v 0 0 0\nf 1 2 3\n");
  Driver d;
  REQUIRE(d.open({small.model, small.cage}));
  d.settle();
  drag_some_vertex(d, {20, 10});
  const auto posed = d.document().pose.positions;
  const auto opened = d.workspace().opened;
  for (const What what : {What::model, What::cage, What::pose, What::dropped, What::recovery}) {
    CHECK_FALSE(d.open({folder / "broken.obj"}, what));
    const std::string said = d.workspace().messages.all().back().text;
    CHECK_MESSAGE(said.find("broken.obj:") != std::string::npos, said);
    CHECK(d.document().pose.positions == posed);
    CHECK(d.workspace().opened == opened);
  }
}
