#include "app/file_desk.h"

#include "document/pose_edit.h"
#include "support/commands.h"
#include "support/files.h"
#include "support/shapes.h"
#include "support/text.h"
#include "workspace/open_save.h"

using namespace viete;
using What = files::OpenRequest::What;
using FileContent = workspace::SaveFile::Content;
using QuestionKind = workspace::Question::Kind;

namespace {

// A FileDesk without a viewer, with files of cubes and a state folder.
struct Desk {
  test::CubeFiles files;
  std::filesystem::path state = files / "state";
  workspace::Workspace workspace;
  std::optional<app::FileDesk> desk;

  explicit Desk(bool remembers = true) { begin(remembers); }
  void begin(bool remembers = true) {
    desk.reset();
    std::destroy_at(&workspace);
    std::construct_at(&workspace);  // avoids a wrong warning of GCC 12
    desk.emplace(remembers ? state : std::filesystem::path(), workspace);
  }
  void frame(bool no_drag = true) {
    while (!workspace.jobs.wishes.empty()) {
      const workspace::Wish wish = workspace.jobs.wishes.take();
      if (const auto* open = std::get_if<workspace::OpenFiles>(&wish)) desk->open(workspace, open->request);
      if (const auto* save = std::get_if<workspace::SaveFile>(&wish)) desk->save(workspace, *save);
      if (std::holds_alternative<workspace::CloseProgram>(wish)) desk->close(workspace);
    }
    desk->follow(workspace, no_drag);
    apply_opened();
    desk->keep(workspace);
  }
  void apply_opened() {
    if (auto loaded = desk->take_opened()) workspace::apply_opened(workspace, std::move(loaded->opened));
  }
  void finish_loading() {
    desk->finish_loading(workspace);
    apply_opened();
  }
  void open(std::vector<std::filesystem::path> paths, What what = What::model) {
    workspace.jobs.wishes.open({what, std::move(paths)});
    frame();
    finish_loading();
  }
  void save(FileContent content, const std::filesystem::path& file) {
    workspace.jobs.wishes.save(content, file);
    frame();
  }
  void open_cubes() {
    open({files.model, files.cage});
    REQUIRE(workspace.document.has_cage());
  }
  void edit() {
    pose::Pose pose = workspace.document.pose();
    pose.positions[0][0] += 0.25;
    document::set_pose(workspace.document, pose);
  }
  void quit() {
    workspace.jobs.wishes.add(workspace::CloseProgram{});
    frame();
  }
  void answer(workspace::Answer answer) {
    desk->answer(workspace, answer);
    frame();
  }
  bool asks(QuestionKind kind) const {
    return workspace.files.question && workspace.files.question->kind == kind;
  }
  std::string last_message() const {
    return workspace.messages.all().empty() ? "" : workspace.messages.all().back().text;
  }
};

std::size_t files_in(const std::filesystem::path& folder) {
  std::error_code ignored;
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder, ignored), {}));
}

// Renames the recovery files, so that they seem to belong to a program that has ended.
void end_program(Desk& d) {
  const auto recovery = d.state / "recovery";
  d.desk.reset();
  for (const auto& entry : std::filesystem::directory_iterator(recovery)) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with("999999999-"))
      std::filesystem::rename(entry.path(),
                              recovery / ("999999999-1" + name.substr(name.find_first_of("_."))));
  }
  d.begin();
}

void restore(Desk& d) {
  REQUIRE(d.workspace.recovery.files.size() == 1);
  d.open({d.workspace.recovery.files[0].file}, What::recovery);
  d.frame();
}

}  // namespace

TEST_CASE("a_frame_without_wishes_does_nothing_nor_does_an_answer_to_no_question") {
  Desk d;
  d.frame();
  d.answer(workspace::Answer::proceed);
  d.desk->cancel_export();
  d.desk->cancel_opening();
  d.save(FileContent::model, d.files / "out.obj");  // no model is open, so nothing is saved
  CHECK_FALSE(d.desk->closed());
  CHECK_FALSE(d.desk->loading());
  CHECK_FALSE(d.desk->exporting());
  CHECK_FALSE(d.desk->kept());
  CHECK(d.workspace.messages.all().empty());
  CHECK(files_in(d.state) == 0);
}

TEST_CASE("loaded_files_wait_for_the_end_of_a_drag") {
  Desk d;
  d.workspace.jobs.wishes.open({What::model, {d.files.model}});
  for (int i = 0; i < 20; ++i) {
    d.frame(false);
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  CHECK(d.desk->loading());
  CHECK_FALSE(d.workspace.document.model().surface);
  d.finish_loading();
  CHECK(d.workspace.document.model().surface);
}

TEST_CASE("without_edits_or_with_edits_that_are_kept_the_program_closes_at_once") {
  for (const bool edited : {false, true}) {
    Desk d;
    d.open_cubes();
    if (edited) d.edit();
    d.quit();
    CHECK(d.desk->closed());
    CHECK(d.desk->kept() == edited);
    CHECK(files_in(d.state / "recovery") == (edited ? 1 : 0));
  }
}

TEST_CASE("edits_that_cannot_be_kept_are_asked_about") {
  Desk d(false);
  d.open_cubes();
  d.edit();
  CHECK_FALSE(d.desk->keep_now(d.workspace));
  SUBCASE("before the program closes, and it stays") {
    d.quit();
    REQUIRE(d.asks(QuestionKind::close));
    d.answer(workspace::Answer::cancel);
    CHECK_FALSE(d.workspace.files.question);
    CHECK_FALSE(d.desk->closed());
  }
  SUBCASE("before the program closes, and it goes without them") {
    d.quit();
    d.answer(workspace::Answer::proceed);
    CHECK(d.desk->closed());
  }
  SUBCASE("before the program closes, and it goes once they are saved") {
    d.workspace.files.saved.session = d.files / "a.viete";
    d.quit();
    d.answer(workspace::Answer::save);
    d.frame();
    CHECK(d.desk->closed());
    CHECK(std::filesystem::exists(d.files / "a.viete"));
  }
  SUBCASE("before the program closes, and again when saving fails") {
    d.workspace.files.saved.session = d.files / "no" / "such" / "folder.viete";
    d.quit();
    d.answer(workspace::Answer::save);
    d.frame();
    CHECK(d.asks(QuestionKind::close));
    CHECK_FALSE(d.desk->closed());
  }
  SUBCASE("before another file takes their place, and it does not") {
    d.open({d.files.cage});
    REQUIRE(d.asks(QuestionKind::open));
    d.answer(workspace::Answer::cancel);
    CHECK(d.workspace.document.model().path == d.files.model);
    CHECK(workspace::has_unsaved_edits(d.workspace));
  }
  SUBCASE("before another file takes their place, and it does") {
    d.open({d.files.cage});
    CHECK(d.workspace.document.model().path == d.files.model);
    d.answer(workspace::Answer::proceed);
    CHECK(d.workspace.document.model().path == d.files.cage);
  }
}

TEST_CASE("edits_that_can_be_kept_are_set_aside_for_another_file_but_stay_with_another_pose") {
  Desk d;
  d.open_cubes();
  d.edit();
  d.open({d.files.pose}, What::pose);
  CHECK(d.workspace.recovery.files.empty());
  d.open({d.files.cage});
  CHECK_FALSE(d.workspace.files.question);
  CHECK(d.workspace.document.model().path == d.files.cage);
  CHECK(d.workspace.recovery.files.size() == 1);
  d.frame();
  CHECK_FALSE(d.workspace.recovery.offered);
  CHECK(d.last_message() ==
        "Unsaved edits of model.obj were saved; File > Restore recovered edits restores them.");
}

TEST_CASE("a_session_changed_on_disk_is_overwritten_only_after_confirmation") {
  Desk d;
  const auto session = d.files / "a.viete";
  d.open_cubes();
  const auto save = [&] { d.save(FileContent::session, session); };
  save();
  CHECK_FALSE(d.workspace.files.question);
  test::put_file(session, "theirs");
  save();
  REQUIRE(d.asks(QuestionKind::replace));
  d.answer(workspace::Answer::cancel);
  CHECK(test::file_bytes(session) == "theirs");
  save();
  d.answer(workspace::Answer::save);  // asks for another name
  CHECK(d.workspace.files.browser.open);
  CHECK(test::file_bytes(session) == "theirs");
  d.workspace.files.browser.open = false;
  save();
  d.answer(workspace::Answer::proceed);
  CHECK(test::file_bytes(session) != "theirs");
}

TEST_CASE("closing_waits_for_exports_and_is_given_up_when_one_fails") {
  for (const bool fails : {false, true}) {
    CAPTURE(fails);
    Desk d;
    formats::write(d.files / "large.ply", test::sphere(6));  // large enough to be written in the background
    d.open({d.files / "large.ply", d.files.cage});
    d.workspace.jobs.wishes.save(FileContent::model,
                                 fails ? d.files / "no" / "such" / "folder.obj" : d.files / "out.obj");
    d.quit();
    CHECK_FALSE(d.desk->closed());
    if (!fails) CHECK(d.workspace.jobs.exporting.what.ends_with(", then closing"));
    d.desk->finish_exports(d.workspace);
    CHECK_FALSE(d.desk->exporting());
    d.frame();
    CHECK(d.desk->closed() != fails);
    CHECK(std::filesystem::exists(d.files / "out.obj") != fails);
  }
}

TEST_CASE("recovered_edits_are_offered_until_they_were_restored_and_stay_on_disk_until_saved") {
  Desk d;
  d.open_cubes();
  d.edit();
  d.frame();
  d.workspace.document.put_method(sym3::Method::sd);  // stored with the unsaved edit
  const auto posed = d.workspace.document.pose().positions;
  d.quit();
  REQUIRE(d.desk->closed());
  CHECK(d.desk->kept());
  end_program(d);
  CHECK(d.workspace.recovery.offered);

  restore(d);
  CHECK(d.workspace.document.method() == sym3::Method::sd);
  CHECK(d.workspace.recovery.files.empty());
  CHECK_FALSE(d.workspace.recovery.offered);
  SUBCASE("closed without further edits, they are kept where they were and not offered again") {
    document::record_edit(d.workspace.document, "select all");
    d.workspace.document.changed_selection().select_all(8);
    d.quit();
    REQUIRE(d.desk->closed());
    CHECK_FALSE(d.desk->kept());
    test::put_file(d.state / "recovery" / "999999999-7.viete", "of another program");
    end_program(d);
    CHECK(d.workspace.recovery.offered);  // the other file
    REQUIRE(d.workspace.recovery.offers().size() == 1);
    test::run_command(d.workspace, "discard_leftovers");
    d.answer(workspace::Answer::save);
    CHECK_FALSE(d.workspace.recovery.offered);
    REQUIRE(d.workspace.recovery.files.size() == 1);
    CHECK(d.workspace.recovery.files[0].cage->positions.size() == d.workspace.recovery.files[0].posed.size());
    restore(d);
    CHECK(d.workspace.document.pose().positions == posed);
  }
  SUBCASE("another model in their place offers nothing") {
    d.open({d.files.model});
    d.frame();
    CHECK_FALSE(d.workspace.recovery.offered);
    CHECK(d.workspace.messages.all().empty());
    restore(d);
    CHECK(d.workspace.document.pose().positions == posed);
  }
  SUBCASE("a program that is killed offers them again") {
    end_program(d);
    CHECK(d.workspace.recovery.offered);
    restore(d);
    CHECK(d.workspace.document.pose().positions == posed);
  }
  SUBCASE("edited further, they are offered again") {
    d.edit();
    d.quit();
    CHECK(d.desk->kept());
    end_program(d);
    CHECK(d.workspace.recovery.offered);
    restore(d);
    CHECK(d.workspace.document.pose().positions != posed);
  }
  SUBCASE("saved, they are gone") {
    d.save(FileContent::session, d.files / "a.viete");
    end_program(d);
    CHECK(d.workspace.recovery.files.empty());
    CHECK(files_in(d.state / "recovery") == 0);
  }
}

TEST_CASE("preferences_persist_with_a_state_folder_only") {
  for (const bool remembers : {true, false}) {
    Desk d(remembers);
    CHECK(d.workspace.view.options.hints);
    d.open_cubes();
    d.workspace.view.options.hints = false;
    d.frame();
    d.begin(remembers);
    CHECK(d.workspace.view.options.hints == !remembers);
    CHECK(d.workspace.preferences.recent.size() == (remembers ? 1 : 0));
    CHECK(std::filesystem::exists(d.state) == remembers);
  }
}

TEST_CASE("unreadable_preferences_give_a_message_and_defaults") {
  Desk d;
  std::filesystem::create_directories(d.state);
  test::put_file(d.state / "remembered.json", "nonsense");
  d.begin();
  CHECK(d.workspace.messages.all().back().severity == workspace::Severity::warning);
  CHECK(d.last_message().ends_with("; using the default preferences"));
  CHECK(d.workspace.view.options.hints);
}

TEST_CASE("files_of_a_session_that_were_moved_are_asked_for_and_then_opened") {
  for (const What what : {What::model, What::recovery}) {
    Desk d;
    d.open_cubes();
    d.edit();
    const auto pose = d.workspace.document.pose();
    REQUIRE(workspace::save_session(d.workspace, d.files / "a.viete"));
    std::filesystem::rename(d.files.model, d.files / "new.obj");
    std::filesystem::rename(d.files.cage, d.files / "grid.obj");
    d.begin();
    d.open({d.files / "a.viete"}, what);
    REQUIRE(d.asks(QuestionKind::locate_model));
    CHECK(test::mentions(d.workspace.files.question->why, "model.obj: there is no such file"));
    CHECK(d.workspace.messages.all().empty());
    d.answer(workspace::Answer::cancel);
    CHECK(d.last_message() == "Cancelled opening; nothing was changed.");
    d.open({d.files / "a.viete"}, what);
    for (const auto& [kind, name] : {std::pair{QuestionKind::locate_model, "new.obj"},
                                     std::pair{QuestionKind::locate_cage, "grid.obj"}}) {
      REQUIRE(d.asks(kind));
      d.answer(workspace::Answer::save);
      CHECK(d.workspace.files.browser.open);
      const bool beside = d.workspace.files.browser.folder == std::filesystem::canonical(d.files.path());
      CHECK(beside == (what == What::model));
      const bool model = kind == QuestionKind::locate_model;
      CHECK(d.workspace.files.browser.purpose == (model ? workspace::FileBrowser::Purpose::locate_model
                                                        : workspace::FileBrowser::Purpose::locate_cage));
      auto request = std::exchange(d.workspace.files.unopened, std::nullopt);
      REQUIRE(request);
      (model ? request->located.model : request->located.cage) = d.files / name;
      d.workspace.jobs.wishes.open(*request);
      d.frame();
      d.finish_loading();
    }
    CHECK_FALSE(d.workspace.files.question);
    CHECK(d.workspace.document.model().path == d.files / "new.obj");
    CHECK(d.workspace.document.pose().positions == pose.positions);
    CHECK(d.workspace.files.saved.recovered == (what == What::recovery));
  }
}

TEST_CASE("a_cage_with_a_fin_is_opened_without_it_after_a_question") {
  Desk d;
  const auto cage = d.files / "fin.obj";
  test::put_file(cage, test::file_bytes(d.files.cage) + "v 0 3 3\nf 7 8 9\n");
  d.open({cage, d.files.model}, What::dropped);
  REQUIRE(d.asks(QuestionKind::fins));
  d.answer(workspace::Answer::cancel);
  CHECK_FALSE(d.workspace.document.model().surface);
  d.open({d.files.model});
  for (const auto& [what, paths] :
       {std::pair{What::dropped, std::vector{cage, d.files.model}}, {What::cage, {cage}}}) {
    d.open(paths, what);
    d.answer(workspace::Answer::save);
    d.finish_loading();
    REQUIRE(d.workspace.document.has_cage());
    CHECK(d.workspace.document.cage()->surface.positions.size() == 8);
    CHECK(test::mentions(d.last_message(), "removed 1 protruding face of fin.obj"));
  }
}

TEST_CASE("an_export_overwrites_no_open_file") {
  Desk d;
  test::put_file(d.files / "model.mtl", "newmtl skin\nmap_Kd skin_0003.png\n");
  test::put_file(d.files / "m.obj", "mtllib model.mtl\nusemtl skin\n" + test::file_bytes(d.files.model));
  test::put_file(d.files / "skin_0003.png", "\x89PNG\r\n\x1a\n");
  std::filesystem::create_symlink("m.obj", d.files / "link.obj");
  for (const char* key : {"key_1.obj", "key_9.obj"}) std::filesystem::copy(d.files.pose, d.files / key);
  d.begin();
  d.open({d.files / "m.obj", d.files.cage});
  d.open({d.files / "key_1.obj"}, What::animation);
  REQUIRE(d.workspace.document.timeline().keys.size() == 2);
  const auto refuses = [&](FileContent content, const char* name, const char* why) {
    const std::string before = test::file_bytes(d.files / name);
    d.workspace.jobs.wishes.save(content, d.files / name);
    d.frame();
    d.desk->finish_exports(d.workspace);
    CHECK(d.workspace.messages.all().back().severity == workspace::Severity::error);
    CHECK_MESSAGE(test::mentions(d.last_message(), why), d.last_message());
    CHECK(test::file_bytes(d.files / name) == before);
  };
  refuses(FileContent::model, "m.obj", "(the model)");
  refuses(FileContent::model, "link.obj", "such as link-2.obj");
  refuses(FileContent::model, "cage.obj", "(the cage)");
  refuses(FileContent::model, "key_9.obj", "(the keys)");
  refuses(FileContent::animation, "key_#.obj", "(the keys)");
  refuses(FileContent::animation, "skin_####.png", "(used by the model)");
  d.save(FileContent::model, d.files / "out.obj");
  d.desk->finish_exports(d.workspace);
  CHECK(std::filesystem::exists(d.files / "out.obj"));
}

TEST_CASE("a_session_whose_meshes_were_moved_is_saved_with_new_files_of_them_after_asking") {
  Desk d;
  d.open_cubes();
  d.edit();
  const auto posed = d.workspace.document.pose().positions;
  std::filesystem::create_directory(d.files / "moved");
  for (const char* name : {"model.obj", "cage.obj"})
    std::filesystem::rename(d.files / name, d.files / "moved" / name);
  std::filesystem::create_directory(d.files / "work");
  const auto session = d.files / "work" / "a.viete";
  const auto save = [&] {
    d.save(FileContent::session, session);
    REQUIRE(d.asks(QuestionKind::moved));
    CHECK(d.workspace.files.question->title == "model.obj and cage.obj were moved or deleted");
  };
  save();
  d.answer(workspace::Answer::cancel);
  CHECK_FALSE(std::filesystem::exists(session));
  SUBCASE("with the meshes") {
    test::put_file(d.files / "work" / "cage.obj", "somebody's");
    save();
    d.answer(workspace::Answer::save);
    CHECK_FALSE(workspace::has_unsaved_edits(d.workspace));
    CHECK(test::file_bytes(d.files / "work" / "cage.obj") == "somebody's");
    d.open({session});
    CHECK(d.workspace.document.model().path.filename() == "model.obj");
    CHECK(d.workspace.document.cage_file().path.filename() == "cage-2.obj");
    CHECK(d.workspace.document.pose().positions == posed);
    CHECK(d.workspace.messages.all().back().severity == workspace::Severity::info);
  }
  SUBCASE("the session only") {
    save();
    d.answer(workspace::Answer::proceed);
    CHECK(std::filesystem::exists(session));
    CHECK_FALSE(std::filesystem::exists(d.files / "work" / "model.obj"));
  }
}
