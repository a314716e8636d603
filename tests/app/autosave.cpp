#include "app/autosave.h"

#include <doctest/doctest.h>

#include <filesystem>

#include "scene/document/edit.h"
#include "scene/document/pose_edit.h"
#include "scene/files.h"
#include "scene/files/open.h"
#include "scene/workspace/apply_opened.h"
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

TEST_CASE("edits_and_later_settings_are_kept_and_open_again_as_they_were") {
  Kept k;
  CHECK_FALSE(k.autosave.kept());
  CHECK(k.kept_files() == 0);
  k.edit(0.25);
  REQUIRE(k.autosave.keep_now(k.workspace));
  CHECK(k.autosave.kept());
  k.workspace.document.put_method(sym3::Method::sd);
  k.workspace.view.wireframe = true;
  REQUIRE(k.autosave.keep_now(k.workspace));
  scene::Workspace again;
  REQUIRE(scene::open_now(again, {scene::OpenRequest::What::recovery, {scene::recovery_file(k.folder)}}));
  CHECK(again.document.pose.positions == k.workspace.document.pose.positions);
  CHECK(again.document.method == sym3::Method::sd);
  CHECK(again.view.wireframe);
}

TEST_CASE("a_folder_that_cannot_be_made_is_a_message_and_a_reason") {
  Kept k;
  test::put_file(k.folder, "a file");
  k.edit(0.25);
  CHECK_FALSE(k.autosave.keep_now(k.workspace));
  CHECK(k.autosave.problem().find("cannot be saved") != std::string::npos);
  CHECK_FALSE(k.workspace.messages.all().empty());
}
