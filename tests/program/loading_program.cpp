#include "formats/read.h"
#include "program/kept_work.h"
#include "support/edits.h"

using namespace viete;
using namespace test;
using What = files::OpenRequest::What;

namespace {

// Runs frames until the progress bar is visible. If the file is read earlier, returns false.
bool sees_loading_bar(Driver& d) {
  bool seen = false;
  d.frame();  // starts to read the file
  REQUIRE(d.until([&] {
    seen = d.recorder().find("stop_work").has_value();
    return seen || !d.viewer().loading();
  }));
  return seen;
}

}  // namespace

TEST_CASE("a_large_file_is_read_aside_with_progress_and_can_be_cancelled") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state", {640, 400}));
  const files::OpenRequest request{What::model, {folder / "large.obj"}};

  int level = 7;  // 164,000 vertices, 17 MB of text; increased if reading is too fast
  const mesh::Surface* surface = nullptr;
  for (;; ++level) {
    REQUIRE_MESSAGE(level < 10, "2.6 million vertices were read within 0.2 s");
    formats::write(folder / "large.obj", ball(1, level));
    REQUIRE(d.open({small.model, small.cage}));
    d.settle();
    drag_some_vertex(d, {20, 10});
    surface = d.document().model().surface.get();
    d.workspace().jobs.wishes.open(request);
    if (!sees_loading_bar(d)) continue;
    CHECK(d.workspace().jobs.loading.what == "Reading large.obj");
    CHECK(d.document().model().surface.get() == surface);
    d.viewer().input().push(platform::InputEvent::key(static_cast<int>(workspace::Key::escape), true));
    d.viewer().input().push(platform::InputEvent::key(static_cast<int>(workspace::Key::escape), false));
    REQUIRE(d.until([&] { return !d.viewer().loading(); }));
    if (d.document().model().surface.get() == surface) break;
  }
  CHECK(test::edit_count(d.document().history()) == 1);
  CHECK(d.workspace().messages.all().back().text.find("Cancelled opening") != std::string::npos);

  d.workspace().jobs.wishes.open(request);
  double last = 0;
  d.frame();
  REQUIRE(d.until([&] {
    const auto& loading = d.workspace().jobs.loading;
    if (loading.running) CHECK(loading.done >= last);
    last = std::max(last, loading.done);
    return !d.viewer().loading();
  }));
  CHECK(d.document().model().summary.vertices ==
        formats::read(folder / "large.obj").surface.positions.size());
}

TEST_CASE("a_foreign_file_that_crashes_or_hangs_its_reader_leaves_the_document_as_it_was") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state", {640, 400}));
  REQUIRE(d.open({small.model, small.cage}));
  d.settle();
  const mesh::Surface* const surface = d.document().model().surface.get();
  put_file(folder / "import", "#!/bin/sh\ncase $1 in *hang*) exec sleep 100 ;; esac\nkill -SEGV $$\n");
  std::filesystem::permissions(folder / "import", std::filesystem::perms::owner_all);
  set_environment("VIETE_IMPORT", (folder / "import").string());
  for (const std::string name : {"crash.fbx", "hang.fbx"}) {
    put_file(folder / name, "content");
    d.workspace().jobs.wishes.open({What::dropped, {folder / name}});
    if (name == "hang.fbx") {
      REQUIRE(sees_loading_bar(d));
      for (const bool down : {true, false})
        d.viewer().input().push(platform::InputEvent::key(static_cast<int>(workspace::Key::escape), down));
    }
    d.frame();
    REQUIRE(d.until([&] { return !d.viewer().loading(); }));
    CHECK(d.document().model().surface.get() == surface);
    const std::string said = d.workspace().messages.all().back().text;
    CHECK_MESSAGE(mentions(said, name == "hang.fbx" ? "Cancelled opening" : "it crashed, or used too"), said);
  }
  unsetenv("VIETE_IMPORT");
}
