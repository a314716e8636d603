#include "scene/workspace/file_commands.h"

#include <doctest/doctest.h>

#include "scene/files.h"
#include "scene/files/output.h"
#include "scene/workspace/command.h"
#include "scene/workspace/saving.h"
#include "support/commands.h"
#include "support/open.h"

using namespace viete;
using namespace viete::scene;
using Purpose = FileBrowser::Purpose;

TEST_CASE("save_asks_for_a_name_once_and_then_writes_there") {
  const test::CubeFiles files;
  Workspace w;
  CHECK_FALSE(test::run_command(w, "save_session"));
  REQUIRE(test::load_model(w, files.model, files.cage));
  REQUIRE(test::run_command(w, "save_session"));
  CHECK(w.browser.open);
  CHECK(w.browser.purpose == Purpose::save_session);
  CHECK(chosen_file(w.browser).filename() == "model.viete");
  w.browser.open = false;
  w.saved.session = files / "walk.viete";
  REQUIRE(test::run_command(w, "save_session"));
  CHECK_FALSE(w.browser.open);
  CHECK(w.requests.save_session == files / "walk.viete");
  REQUIRE(test::run_command(w, "save_session_as"));
  CHECK(w.browser.open);
  CHECK(chosen_file(w.browser).filename() == "walk.viete");
}

TEST_CASE("the_folder_where_a_file_was_chosen_last_is_shown_first_and_a_lost_one_does_no_harm") {
  const test::CubeFiles files;
  Workspace w;
  REQUIRE(test::load_model(w, files.model, files.cage));
  test::run_command(w, "open_model");
  CHECK(w.browser.folder == std::filesystem::canonical(files.path()));
  std::filesystem::create_directories(files / "other");
  w.remembered.folder = files / "other";
  test::run_command(w, "open_model");
  CHECK(w.browser.folder == std::filesystem::canonical(files.path()) / "other");
  test::run_command(w, "open_pose");  // beside its cage
  CHECK(w.browser.folder == std::filesystem::canonical(files.path()));
  test::run_command(w, "open_cage");
  CHECK(w.browser.folder == std::filesystem::canonical(files.path()));
  w.remembered.folder = files / "gone";
  test::run_command(w, "open_model");
  CHECK(w.browser.folder == std::filesystem::canonical(std::filesystem::current_path()));
  CHECK(w.browser.problem.empty());
}

TEST_CASE("recovered_edits_are_restored_from_their_notice_and_discarded_or_put_off_all_at_once") {
  Workspace w;
  CHECK_FALSE(test::run_command(w, "restore_leftover"));
  w.leftovers = {{"/a.viete", "a", 0}, {"/b.viete", "b", 0}};
  CHECK_FALSE(test::run_command(w, "discard_leftovers"));  // no notice lists them
  REQUIRE(test::run_command(w, "restore_leftover"));
  CHECK(w.offers_leftovers);
  CHECK_FALSE(w.requests.open);
  REQUIRE(test::run_command(w, "restore_leftover"));
  CHECK(w.requests.open->what == OpenRequest::What::recovery);
  CHECK(w.requests.open->files.front() == "/a.viete");
  REQUIRE(test::run_command(w, "discard_leftovers"));
  REQUIRE(w.question);
  CHECK(w.question->kind == Question::Kind::discard);
  REQUIRE(test::run_command(w, "put_off_leftovers"));
  CHECK_FALSE(w.offers_leftovers);
  CHECK(w.leftovers.size() == 2);
}

TEST_CASE("no_dialog_proposes_a_file_that_is_open") {
  const test::CubeFiles files;
  for (const char* name : {"a.obj", "a_cage.obj", "a_cage_pose.obj", "a_deformed.obj", "a_animation.pc2"})
    std::filesystem::copy(std::string(name) == "a.obj" ? files.model : files.cage, files / name);
  Workspace w;
  REQUIRE(test::load_model(w, files / "a.obj", files / "a_cage.obj"));
  const auto proposed = [&](const char* command) {
    REQUIRE(test::run_command(w, command));
    return chosen_file(w.browser).filename().string();
  };
  CHECK(proposed("save_pose") == "a_cage_pose.obj");  // there, but not open: it asks before it replaces
  REQUIRE(test::load_pose(w, files / "a_cage_pose.obj"));
  CHECK(proposed("save_pose") == "a_cage_pose.obj");  // its own
  CHECK(proposed("save_cage") == "a_cage.obj");
  CHECK(proposed("save_model") == "a_deformed.obj");
  REQUIRE(test::load_model(w, files / "a.obj", files / "a_deformed.obj"));
  CHECK(proposed("save_model") == "a_deformed-2.obj");
  CHECK(proposed("save_cage") == "a_cage.obj");
  REQUIRE(test::load_model(w, files / "a_cage.obj", files / "a_deformed.obj"));
  w.document.model.path = files / "way" / ".." / "a.obj";
  w.document.also_read.push_back({files / "a_cage.obj", the_model});
  CHECK(proposed("save_cage") == "a_cage-2.obj");
}
