#include "workspace/open_save.h"

#include "formats/read.h"
#include "interact/transform_drag.h"
#include "support/commands.h"
#include "support/files.h"
#include "support/grips.h"
#include "support/text.h"

using namespace viete;
using namespace viete::document;
using namespace viete::files;
using namespace viete::interact;
using namespace viete::workspace;
namespace fs = std::filesystem;
using Purpose = FileBrowser::Purpose;

namespace {

Workspace edited(const test::CubeFiles& files) {
  Workspace w = test::opened({files.model, files.cage});
  CHECK_FALSE(has_unsaved_edits(w));
  w.document.changed_history().record("move", w.document.state());
  w.document.changed_pose().positions[0][0] -= 0.25;
  CHECK(has_unsaved_edits(w));
  return w;
}

}  // namespace

TEST_CASE("saving_a_session_or_a_pose_makes_edits_saved_and_undo_makes_them_unsaved_again") {
  const test::CubeFiles files;
  Workspace w = edited(files);
  undo(w.document);
  CHECK_FALSE(has_unsaved_edits(w));
  redo(w.document);
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK_FALSE(has_unsaved_edits(w));
  undo(w.document);
  CHECK(has_unsaved_edits(w));
  redo(w.document);
  CHECK_FALSE(has_unsaved_edits(w));
  undo(w.document);
  REQUIRE(save_pose(w, files / "p.ply"));
  CHECK_FALSE(has_unsaved_edits(w));
}

TEST_CASE("a_whole_turn_is_an_edit_and_filling_in_missing_turns_is_none") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  w.document.changed_pose().turns = {{0, 3.14159, 0}};
  CHECK_FALSE(has_unsaved_edits(w));
  w.document.changed_pose().turns = {{0, 1e-9, 0}};
  CHECK_FALSE(has_unsaved_edits(w));
  w.document.changed_selection().select_all(w.document.pose().positions.size());
  transform_selection(w.document, Tool::rotate, test::plain_grip(w.document), {.degrees = 360});
  CHECK(w.document.pose().positions == w.files.saved.state.pose.positions);
  CHECK(has_unsaved_edits(w));
  REQUIRE(save_pose(w, files / "p.obj"));
  CHECK_FALSE(has_unsaved_edits(w));
  undo(w.document);
  CHECK(has_unsaved_edits(w));
}

TEST_CASE("weights_and_radius_are_edits_that_a_session_keeps_and_a_pose_does_not_and_the_method_is_none") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  w.document.put_deformer(pose::deformer_of(pose::Preset::local));
  mark_saved(w);
  w.document.put_method(sym3::Method::diag);
  CHECK_FALSE(has_unsaved_edits(w));
  set_radius(w.document, 0.3);
  CHECK(has_unsaved_edits(w));
  REQUIRE(save_pose(w, files / "p.obj"));
  CHECK(has_unsaved_edits(w));
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK_FALSE(has_unsaved_edits(w));
  test::run_command(w, "blend_linear");
  CHECK(has_unsaved_edits(w));
  test::run_command(w, "blend_srl");
  CHECK_FALSE(has_unsaved_edits(w));

  Workspace back = test::opened({files / "a.viete"});
  CHECK_FALSE(has_unsaved_edits(back));
  set_radius(back.document, 0.25);
  CHECK(has_unsaved_edits(back));
}

TEST_CASE("poses_and_cages_are_not_saved_where_their_vertices_would_not_come_back_in_their_order") {
  const test::CubeFiles files;
  Workspace w = edited(files);
  CHECK_FALSE(save_pose(w, files / "a.STL"));
  CHECK(test::mentions(w.messages.all().back().text, "save as .obj, .ply or .off"));
  for (const char* name : {"a.stl", "a.glb", "a.gltf"}) CHECK_FALSE(save_cage(w, files / name));
  for (const char* name : {"a.STL", "a.stl", "a.glb", "a.gltf"}) CHECK_FALSE(fs::exists(files / name));
  CHECK(has_unsaved_edits(w));
  CHECK(w.document.cage_file().path == files.cage);
}

TEST_CASE("a_failed_save_leaves_file_and_edits_as_they_were") {
  const test::CubeFiles files;
  Workspace w = edited(files);
  const std::string before = test::file_bytes(files.model);
  CHECK_FALSE(save_session(w, files / "none" / "a.viete"));
  CHECK_FALSE(save_pose(w, files / "a.xyz"));
  fs::create_hard_link(files.model, files / "linked.obj");
  CHECK_FALSE(save_pose(w, files.model));
  fs::remove(files / "linked.obj");
  fs::permissions(files.model, fs::perms::owner_read);
  CHECK_FALSE(save_pose(w, files.model));
  CHECK(w.messages.all().back().severity == Severity::error);
  CHECK(has_unsaved_edits(w));
  CHECK(w.files.saved.session.empty());
  CHECK(test::file_bytes(files.model) == before);
}

TEST_CASE("a_session_changed_on_disk_is_noticed_by_its_content") {
  const test::CubeFiles files;
  Workspace w = edited(files);
  const auto session = files / "a.viete";
  CHECK_FALSE(changed_on_disk(w, session));
  REQUIRE(save_session(w, session));
  CHECK_FALSE(changed_on_disk(w, session));
  const std::string bytes = test::file_bytes(session);
  test::put_file(session, bytes);  // a new file with the same content
  CHECK_FALSE(changed_on_disk(w, session));
  test::put_file(session, bytes + " ");
  CHECK(changed_on_disk(w, session));
  CHECK_FALSE(changed_on_disk(w, files / "b.viete"));
  fs::remove(session);
  CHECK_FALSE(changed_on_disk(w, session));  // the file does not exist
}

TEST_CASE("recovered_work_knows_whether_its_session_has_changed_since") {
  const test::CubeFiles files;
  const auto session = files / "a.viete", kept = files / "r.viete";
  Workspace w = edited(files);
  REQUIRE(save_session(w, session));
  undo(w.document);
  test::put_file(kept, session_text(session_of(w), kept, false));
  for (const bool changed : {false, true}) {
    CAPTURE(changed);
    if (changed) test::put_file(session, test::file_bytes(session) + " ");
    Workspace back;
    REQUIRE(test::open_now(back, {OpenRequest::What::recovery, {kept}}));
    CHECK(changed_on_disk(back, back.files.saved.session) == changed);
  }
}

TEST_CASE("the_title_names_the_session_and_else_the_model_with_a_star_while_edits_are_unsaved") {
  const test::CubeFiles files;
  CHECK(window_title(Workspace()) == "Viete");
  Workspace w = edited(files);
  const std::string model = files.model.filename().string();
  CHECK(window_title(w) == model + "* - Viete");
  REQUIRE(save_session(w, files / "walk.viete"));
  CHECK(window_title(w) == "walk.viete - Viete");
  Workspace again = test::opened({files / "walk.viete"});
  CHECK(window_title(again) == "walk.viete - Viete");
}

TEST_CASE("saving_overwrites_no_open_file_except_its_own_source") {
  const test::CubeFiles files;
  fs::create_symlink(files.cage, files / "link.obj");
  fs::create_directory_symlink(files.path(), files / "way");
  test::put_file(files / "letter.viete", "Dear all");
  test::put_file(files / "key_1.obj", test::file_bytes(files.pose));
  test::put_file(files / "key_9.obj", test::file_bytes(files.cage));
  Workspace w = test::opened({files.model, files.cage});
  REQUIRE(test::load_pose(w, files.pose));
  REQUIRE(test::open_now(w, {OpenRequest::What::animation, {files / "key_1.obj"}}));
  fs::create_hard_link(files.model, files / "model.viete");
  const std::string model = test::file_bytes(files.model), cage = test::file_bytes(files.cage);
  const auto refuses = [&](bool (*save)(Workspace&, const fs::path&), const fs::path& file) {
    const std::string before = test::file_bytes(file);
    CHECK_FALSE_MESSAGE(save(w, file), file);
    CHECK(w.messages.all().back().severity == Severity::error);
    CHECK(test::file_bytes(file) == before);
    return w.messages.all().back().text;
  };
  CHECK(test::mentions(refuses(save_pose, files.cage),
                       "(the cage) and would be replaced; choose another name"));
  CHECK(test::mentions(refuses(save_pose, files / "link.obj"), "such as link-2.obj"));
  CHECK(test::mentions(refuses(save_pose, files / "way/model.obj"), "(the model)"));
  CHECK(test::mentions(refuses(save_pose, files / "key_9.obj"), "(the keys)"));
  CHECK(test::mentions(refuses(save_cage, files.model), "(the model)"));
  CHECK(test::mentions(refuses(save_cage, files.pose), "(the pose)"));
  CHECK(test::mentions(refuses(save_session, files / "letter.viete"), "this file is text, not a session"));
  CHECK(test::mentions(refuses(save_session, files / "model.viete"), "(the model)"));
  CHECK(save_pose(w, files.pose));
  CHECK(save_cage(w, files.cage));
  CHECK(save_session(w, files / "s.viete"));
  CHECK(save_session(w, files / "s.viete"));
  CHECK(test::file_bytes(files.model) == model);
  CHECK(formats::read(files.cage).surface.positions == w.document.cage()->surface.positions);
}

TEST_CASE("a_cage_that_was_edited_is_still_not_replaced_by_a_pose") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  w.document.replace_cage(generated_surface(*w.document.cage_file().surface, "cage.obj, edited"),
                          w.document.cage(), w.document.pose());
  CHECK_FALSE(save_pose(w, files.cage));  // after an undo, this file could be the cage again
  CHECK(save_cage(w, files.cage));
}

TEST_CASE("save_asks_for_a_name_once_and_then_writes_there") {
  const test::CubeFiles files;
  Workspace w;
  CHECK_FALSE(test::run_command(w, "save_session"));
  REQUIRE(test::load_model(w, files.model, files.cage));
  REQUIRE(test::run_command(w, "save_session"));
  CHECK(w.files.browser.open);
  CHECK(w.files.browser.purpose == Purpose::save_session);
  CHECK(chosen_file(w.files.browser).filename() == "model.viete");
  w.files.browser.open = false;
  w.files.saved.session = files / "walk.viete";
  REQUIRE(test::run_command(w, "save_session"));
  CHECK_FALSE(w.files.browser.open);
  const auto* wish = w.jobs.wishes.find<workspace::SaveFile>();
  REQUIRE(wish);
  CHECK(wish->content == workspace::SaveFile::Content::session);
  CHECK(wish->file == files / "walk.viete");
  REQUIRE(test::run_command(w, "save_session_as"));
  CHECK(w.files.browser.open);
  CHECK(chosen_file(w.files.browser).filename() == "walk.viete");
}

TEST_CASE("the_folder_where_a_file_was_chosen_last_is_shown_first_and_a_lost_one_does_no_harm") {
  const test::CubeFiles files;
  Workspace w = test::opened({files.model, files.cage});
  test::run_command(w, "open_model");
  CHECK(w.files.browser.folder == std::filesystem::canonical(files.path()));
  std::filesystem::create_directories(files / "other");
  w.preferences.folder = files / "other";
  test::run_command(w, "open_model");
  CHECK(w.files.browser.folder == std::filesystem::canonical(files.path()) / "other");
  test::run_command(w, "open_pose");  // opens in the folder of the cage
  CHECK(w.files.browser.folder == std::filesystem::canonical(files.path()));
  test::run_command(w, "open_cage");
  CHECK(w.files.browser.folder == std::filesystem::canonical(files.path()));
  w.preferences.folder = files / "gone";
  test::run_command(w, "open_model");
  CHECK(w.files.browser.folder == std::filesystem::canonical(std::filesystem::current_path()));
  CHECK(w.files.browser.problem.empty());
}

TEST_CASE("no_dialog_proposes_a_file_that_is_open") {
  const test::CubeFiles files;
  for (const char* name : {"a.obj", "a_cage.obj", "a_cage_pose.obj", "a_deformed.obj", "a_animation.pc2"})
    std::filesystem::copy(std::string(name) == "a.obj" ? files.model : files.cage, files / name);
  Workspace w;
  REQUIRE(test::load_model(w, files / "a.obj", files / "a_cage.obj"));
  const auto proposed = [&](const char* command) {
    REQUIRE(test::run_command(w, command));
    return chosen_file(w.files.browser).filename().string();
  };
  CHECK(proposed("save_pose") == "a_cage_pose.obj");  // the file exists, but is not open
  REQUIRE(test::load_pose(w, files / "a_cage_pose.obj"));
  CHECK(proposed("save_pose") == "a_cage_pose.obj");  // the pose came from this file
  CHECK(proposed("save_cage") == "a_cage.obj");
  CHECK(proposed("save_model") == "a_deformed.obj");
  REQUIRE(test::load_model(w, files / "a.obj", files / "a_deformed.obj"));
  CHECK(proposed("save_model") == "a_deformed-2.obj");
  CHECK(proposed("save_cage") == "a_cage.obj");
  REQUIRE(test::load_model(w, files / "a_cage.obj", files / "a_deformed.obj"));
  w.document.put_saved_model(files / "way" / ".." / "a.obj");
  w.document.changed_also_read().push_back({files / "a_cage.obj", the_model});
  CHECK(proposed("save_cage") == "a_cage-2.obj");
}
