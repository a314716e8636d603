#include "scene/files/recovery.h"

#include <doctest/doctest.h>

#include "base/error.h"
#include "base/process.h"
#include "scene/document/edit.h"
#include "scene/document/pose_edit.h"
#include "scene/files.h"
#include "scene/files/session.h"
#include "scene/hand/grip.h"
#include "scene/hand/placing.h"
#include "scene/hand/transform.h"
#include "scene/workspace/apply_opened.h"
#include "scene/workspace/saving.h"
#include "support/grips.h"
#include "support/zombie.h"

using namespace viete;
using namespace viete::scene;
namespace fs = std::filesystem;

TEST_CASE("only_the_work_of_programs_that_have_ended_is_left_over") {
  const test::TemporaryFolder folder;
  CHECK(find_recovery_files(folder / "none").empty());
  test::put_file(recovery_file(folder.path()), "{}");
  test::put_file(set_aside_file(folder.path()), "{}");
  test::put_file(folder / "999999999-1.viete", "{}");
  test::put_file(folder / "999999999-1_2.viete", "{}");
  test::put_file(folder / "999999999-1.viete.123-0.part", "half");
  const auto recovery_files = find_recovery_files(folder.path());
  REQUIRE(recovery_files.size() == 2);
  CHECK(recovery_files[0].file.filename().string().starts_with("999999999-1"));
}

TEST_CASE("the_work_of_a_program_that_has_ended_and_is_still_listed_is_left_over") {
  const test::TemporaryFolder folder;
  const test::Zombie zombie;
  test::put_file(folder / (zombie.name + ".viete"), "{}");
  CHECK(find_recovery_files(folder.path()).size() == 1);
}

TEST_CASE("leftovers_come_newest_first_and_are_called_by_what_they_belong_to") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  deform::Pose moved = w.document.pose;
  moved.positions[0][0] += 0.25;
  set_pose(w.document, moved);
  const fs::path folder = files / "recovery";
  fs::create_directories(folder);
  const auto put = [&](const std::string& name, int minutes_ago) {
    test::put_file(folder / name, session_text(session_of(w), folder / name, false));
    fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::minutes(minutes_ago));
  };
  put("999999999-1.viete", 30);
  w.saved.session = files / "walk.viete";
  put("999999999-2.viete", 10);
  test::put_file(folder / "999999999-3.viete", "torn");
  fs::last_write_time(folder / "999999999-3.viete",
                      fs::file_time_type::clock::now() - std::chrono::minutes(20));
  const auto recovery_files = find_recovery_files(folder);
  REQUIRE(recovery_files.size() == 3);
  CHECK(recovery_files[0].name == "walk.viete");
  CHECK(recovery_files[1].name == "999999999-3.viete");
  CHECK(recovery_files[1].folder.empty());
  CHECK(recovery_files[2].name == "model.obj");
  for (const std::size_t i : {0u, 2u}) CHECK(recovery_files[i].folder == fs::canonical(files.path()));
}

TEST_CASE("recovered_edits_that_equal_the_files_on_disk_are_not_offered") {
  const test::CubeFiles files;
  const fs::path folder = files / "recovery", kept = folder / "999999999-1.viete",
                 session = files / "a.viete";
  fs::create_directories(folder);
  Workspace w = test::opened({files.model, files.cage});
  const auto move = [&] {
    deform::Pose pose = w.document.pose;
    pose.positions[0][0] += 0.25;
    set_pose(w.document, pose);
  };
  const auto offered = [&] {
    test::put_file(kept, session_text(session_of(w), kept, false));
    const bool any = !find_recovery_files(folder).empty();
    CHECK(fs::exists(kept) == any);
    return any;
  };
  CHECK_FALSE(offered());  // at rest, like the cage's file
  move();
  CHECK(offered());
  REQUIRE(save_session(w, session));
  w.camera.orbit({30, 0});
  w.view.wireframe = true;
  CHECK_FALSE(offered());  // changing the view is no edit
  move();
  CHECK(offered());
  undo(w.document);
  CHECK_FALSE(offered());
  set_radius(w.document, 0.3);
  CHECK(offered());
  undo(w.document);
  fs::remove(session);
  CHECK(offered());  // its session is gone
}

TEST_CASE("names_for_work_set_aside_do_not_collide") {
  const test::TemporaryFolder folder;
  const fs::path first = set_aside_file(folder.path());
  test::put_file(first, "{}");
  CHECK(set_aside_file(folder.path()) != first);
}

TEST_CASE("times_of_today_are_told_without_the_day") {
  std::tm noon{};
  noon.tm_year = 126, noon.tm_mon = 4, noon.tm_mday = 3, noon.tm_hour = 12, noon.tm_min = 5,
  noon.tm_isdst = -1;
  const std::time_t time = std::mktime(&noon);
  CHECK(when(time, time + 3600) == "today 12:05");
  CHECK(when(time, time + 86400) == "yesterday 12:05");
  CHECK(when(time, time + 2 * 86400) == "May 03, 12:05");
  CHECK(when(time, time + 365 * 86400) == "May 03 2026, 12:05");
  CHECK(when(time, time - 86400) == "May 03, 12:05");
}

namespace {

std::string first_edit_kept(const Workspace& w, const fs::path& file) {
  test::put_file(file, session_text(session_of(w), file, false));
  return describe_recovery_file(file).first_edit;
}

}  // namespace

TEST_CASE("recovery_files_store_the_first_unsaved_edit_and_sessions_do_not") {
  const test::CubeFiles files;
  const fs::path kept = files / "999999999-1.viete";
  Workspace w = test::opened({files.model, files.cage});
  CHECK(first_edit_kept(w, kept).empty());
  w.document.selection.select_all(8);
  const auto move = [&] {
    Transform by;
    by.shift = {0.1, 0, 0};
    transform_selection(w.document, Tool::move, test::plain_grip(w.document), by);
  };
  move();
  set_radius(w.document, 0.3);
  CHECK(first_edit_kept(w, kept) == "move 8 vertices");

  REQUIRE(save_session(w, files / "saved.viete"));
  CHECK(read_session(files / "saved.viete").first_edit.empty());
  const std::string last = w.document.history.undo_label();
  undo(w.document);
  CHECK(first_edit_kept(w, kept) == "undo " + last);
  reset_pose(w.document);
  CHECK(first_edit_kept(w, kept) == "reset pose");
  move();
  REQUIRE(save_session(w, files / "saved.viete"));
  reset_pose(w.document);
  REQUIRE(save_pose(w, files / "pose.obj"));
  move();
  CHECK(first_edit_kept(w, kept) == "move 8 vertices");

  Workspace recovered;
  REQUIRE(open_now(recovered, {OpenRequest::What::recovery, {kept}}));
  reset_pose(recovered.document);
  CHECK(first_edit_kept(recovered, files / "999999999-2.viete") == "move 8 vertices");
  REQUIRE(save_session(recovered, files / "saved.viete"));
  move();
  reset_pose(recovered.document);
  CHECK(first_edit_kept(recovered, kept) != "move 8 vertices");
}
