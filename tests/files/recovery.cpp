#include "files/recovery.h"

#include <set>

#include "document/pose_edit.h"
#include "support/files.h"
#include "support/zombie.h"
#include "workspace/open_save.h"

using namespace viete;
using namespace viete::document;
using namespace viete::files;
using namespace viete::workspace;
namespace fs = std::filesystem;

TEST_CASE("only_the_work_of_programs_that_have_ended_is_left_over") {
  const test::TemporaryFolder folder;
  CHECK(find_recovery_files(folder / "none").empty());
  const test::Zombie zombie;  // an ended process that the system still lists
  const fs::path aside = set_aside_file(folder.path());
  for (const fs::path& file : {recovery_file(folder.path()), aside, folder / "999999999-1.viete",
                               folder / "999999999-1_2.viete", folder / (zombie.name + ".viete")})
    test::put_file(file, "{}");
  test::put_file(folder / "999999999-1.viete.123-0.part", "half");
  CHECK(set_aside_file(folder.path()) != aside);
  std::set<std::string> names;
  for (const RecoveryFile& found : find_recovery_files(folder.path())) names.insert(found.file.stem());
  CHECK(names == std::set<std::string>{"999999999-1", "999999999-1_2", zombie.name});
}

TEST_CASE("leftovers_come_newest_first_and_are_called_by_what_they_belong_to") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  pose::Pose moved = w.document.pose();
  moved.positions[0][0] += 0.25;
  set_pose(w.document, moved);
  const fs::path folder = files / "recovery";
  fs::create_directories(folder);
  const auto put = [&](const std::string& name, int minutes_ago) {
    test::put_file(folder / name, session_text(session_of(w), folder / name, false));
    fs::last_write_time(folder / name, fs::file_time_type::clock::now() - std::chrono::minutes(minutes_ago));
  };
  put("999999999-1.viete", 30);
  w.files.saved.session = files / "walk.viete";
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
  const fs::path folder = files / "recovery", kept = folder / "999999999-1.viete";
  fs::create_directories(folder);
  Workspace w = test::opened({files.model, files.cage});
  const auto move = [&] {
    pose::Pose pose = w.document.pose();
    pose.positions[0][0] += 0.25;
    set_pose(w.document, pose);
  };
  const auto offered = [&] {
    test::put_file(kept, session_text(session_of(w), kept, false));
    const bool any = !find_recovery_files(folder).empty();
    CHECK(fs::exists(kept) == any);
    return any;
  };
  CHECK_FALSE(offered());  // the pose equals the cage file
  move();
  CHECK(offered());
  REQUIRE(save_session(w, files / "a.viete"));
  w.view.camera.orbit({30, 0});
  w.view.options.wireframe = true;
  CHECK_FALSE(offered());  // a change of the view is not an edit
  move();
  CHECK(offered());
  undo(w.document);
  CHECK_FALSE(offered());
  fs::remove(files / "a.viete");
  CHECK(offered());
}

TEST_CASE("times_are_told_with_their_day") {
  std::tm noon{};
  noon.tm_year = 126;
  noon.tm_mon = 4;
  noon.tm_mday = 3;
  noon.tm_hour = 12;
  noon.tm_min = 5;
  noon.tm_isdst = -1;
  CHECK(when(std::mktime(&noon)) == "May 03, 12:05");
}
