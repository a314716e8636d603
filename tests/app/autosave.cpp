#include "app/autosave.h"

#include <doctest/doctest.h>

#include <chrono>
#include <filesystem>
#include <thread>

#include "base/clock.h"
#include "scene/document/edit.h"
#include "scene/document/pose_edit.h"
#include "scene/files.h"
#include "scene/files/open.h"
#include "scene/files/session.h"
#include "scene/workspace/apply_opened.h"
#include "scene/workspace/saving.h"
#include "support/open.h"

using namespace viete;

namespace {

namespace fs = std::filesystem;

// An open cube in a cage, with autosave to a folder.
struct Kept {
  test::CubeFiles files;
  fs::path folder = files / "recovery";
  scene::Workspace workspace;
  base::BackgroundQueue queue;
  app::Autosave autosave{folder, queue};

  Kept() {
    REQUIRE(test::load_model(workspace, files.model, files.cage));
    autosave.follow(workspace);
  }
  void edit(double x) {
    deform::Pose pose = workspace.document.pose;
    pose.positions[0][0] += x;
    scene::set_pose(workspace.document, pose);
  }
  std::size_t kept_files() const {
    std::error_code ignored;
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder, ignored), {}));
  }
};

}  // namespace

TEST_CASE("nothing_is_kept_before_the_first_edit") {
  Kept k;
  CHECK_FALSE(k.autosave.kept());
  CHECK(k.kept_files() == 0);
}

TEST_CASE("an_edit_is_kept_and_opens_again_as_it_was") {
  Kept k;
  k.edit(0.25);
  REQUIRE(k.autosave.keep_now(k.workspace));
  CHECK(k.autosave.kept());
  const fs::path file = scene::recovery_file(k.folder);
  REQUIRE(fs::exists(file));
  scene::Workspace again;
  REQUIRE(scene::open_now(again, {scene::OpenRequest::What::recovery, {file}}));
  CHECK(again.document.pose.positions == k.workspace.document.pose.positions);
}

TEST_CASE("settings_made_after_the_last_edit_are_kept_too") {
  Kept k;
  k.edit(0.25);
  REQUIRE(k.autosave.keep_now(k.workspace));
  k.workspace.document.put_method(sym3::Method::sd);
  k.workspace.view.wireframe = true;
  REQUIRE(k.autosave.keep_now(k.workspace));
  scene::Workspace again;
  REQUIRE(scene::open_now(again, {scene::OpenRequest::What::recovery, {scene::recovery_file(k.folder)}}));
  CHECK(again.document.method == sym3::Method::sd);
  CHECK(again.view.wireframe);
}

TEST_CASE("camera_and_handling_are_backed_up_with_edits_once_they_rest") {
  Kept k;
  k.workspace.camera.orbit({30, 0});
  k.autosave.follow(k.workspace);
  CHECK(k.kept_files() == 0);  // no edit
  k.edit(0.25);
  REQUIRE(k.autosave.keep_now(k.workspace));
  const auto kept = [&] { return scene::read_session(scene::recovery_file(k.folder)); };
  k.workspace.camera.orbit({40, 10});
  k.workspace.handling.soft.on = true;
  const auto camera = k.workspace.camera.pose();
  const double changed = base::wall_seconds();
  k.autosave.follow(k.workspace);
  const bool early = kept().camera == camera || k.autosave.has_news();
  CHECK((!early || base::wall_seconds() - changed > 0.5));
  while (!k.autosave.has_news()) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  CHECK(kept().camera != camera);  // written only by the frame that has_news() asks for
  k.autosave.follow(k.workspace);
  k.queue.add([] {}).wait();
  k.autosave.follow(k.workspace);
  CHECK(k.autosave.kept());
  CHECK_FALSE(k.autosave.has_news());
  CHECK(kept().camera == camera);
  CHECK(kept().handling.soft.on);
  k.workspace.camera.orbit({-40, 10});
  REQUIRE(k.autosave.keep_now(k.workspace));  // at the end, immediately
  CHECK(kept().camera == k.workspace.camera.pose());
}

TEST_CASE("saved_edits_are_not_backed_up") {
  Kept k;
  k.edit(0.25);
  REQUIRE(k.autosave.keep_now(k.workspace));
  REQUIRE(scene::save_session(k.workspace, k.files / "a.viete"));
  k.autosave.follow(k.workspace);
  CHECK_FALSE(k.autosave.kept());
  k.queue.add([] {}).wait();  // after the removal
  CHECK(k.kept_files() == 0);
}

TEST_CASE("edits_are_set_aside_when_another_document_is_opened") {
  Kept k;
  k.edit(0.25);
  REQUIRE(k.autosave.set_aside(k.workspace));
  REQUIRE(test::load_model(k.workspace, k.files.model, k.files.cage));
  k.autosave.follow(k.workspace);
  CHECK_FALSE(fs::exists(scene::recovery_file(k.folder)));
  REQUIRE(k.workspace.recovery_files.size() == 1);
  CHECK(fs::exists(k.workspace.recovery_files[0].file));
}

TEST_CASE("a_folder_that_cannot_be_made_is_a_message_and_a_reason") {
  Kept k;
  test::put_file(k.folder, "a file");
  k.edit(0.25);
  CHECK_FALSE(k.autosave.keep_now(k.workspace));
  CHECK(k.autosave.problem().find("cannot be saved") != std::string::npos);
  CHECK_FALSE(k.workspace.messages.all().empty());
}

TEST_CASE("without_a_folder_edits_are_not_backed_up_and_the_reason_is_given") {
  Kept k;
  base::BackgroundQueue queue;
  app::Autosave autosave({}, queue);
  k.edit(0.25);
  CHECK_FALSE(autosave.keep_now(k.workspace));
  CHECK_FALSE(autosave.problem().empty());
}
