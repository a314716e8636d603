#include "workspace/file_browser.h"

#include "support/folder.h"
#include "support/text.h"
#include "workspace/open_save.h"

using namespace viete;
using namespace viete::document;
using namespace viete::workspace;
namespace fs = std::filesystem;

namespace {

// A folder with files of several kinds, and a file browser that shows the folder.
struct Listed : test::TemporaryFolder {
  FileBrowser browser;

  explicit Listed(FileBrowser::Purpose purpose = FileBrowser::Purpose::model, const std::string& name = "") {
    fs::create_directories(*this / "Sub");
    for (const char* file : {"Beta.obj", "alpha.ply", "gamma.viete", "notes.txt", ".hidden.obj"})
      test::put_file(*this / file, "x");
    show(browser, purpose, path(), name);
  }
};

std::string names(const FileBrowser& browser) {
  std::string all;
  for (const auto* entry : shown(browser)) all += entry->name + " ";
  return all;
}

}  // namespace

TEST_CASE("folders_come_first_then_fitting_files_without_regard_to_case") {
  Listed folder;
  FileBrowser& browser = folder.browser;
  CHECK(names(browser) == "Sub alpha.ply Beta.obj gamma.viete ");
  show(browser, FileBrowser::Purpose::pose, folder.path());
  CHECK(names(browser) == "Sub alpha.ply Beta.obj ");
  show(browser, FileBrowser::Purpose::save_session, folder.path());
  CHECK(names(browser) == "Sub gamma.viete ");
  enter(browser, folder / "missing");
  CHECK(browser.folder == fs::weakly_canonical(folder.path()));
  CHECK(test::mentions(browser.problem, "missing"));
  enter(browser, folder / "Sub");
  CHECK(browser.entries.empty());
  CHECK(browser.problem.empty());
}

TEST_CASE("foreign_formats_can_be_opened_but_not_written") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.FBX", "b.obj"}) test::put_file(folder / name, "x");
  FileBrowser browser;
  for (const auto purpose :
       {FileBrowser::Purpose::model, FileBrowser::Purpose::cage, FileBrowser::Purpose::shapes}) {
    show(browser, purpose, folder.path());
    CHECK(names(browser) == "a.FBX b.obj ");
  }
  show(browser, FileBrowser::Purpose::save_model, folder.path());
  CHECK(names(browser) == "b.obj ");
  CHECK_FALSE(test::mentions(format_list(browser), "FBX"));
}

TEST_CASE("formats_of_captures_are_offered_only_for_captures") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.spz", "b.obj"}) test::put_file(folder / name, "x");
  FileBrowser browser;
  for (const bool capture : {false, true}) {
    browser.saves_capture = capture;
    for (const auto purpose : {FileBrowser::Purpose::save_model, FileBrowser::Purpose::save_animation}) {
      show(browser, purpose, folder.path());
      CHECK(test::mentions(format_list(browser), "SPZ") == capture);
    }
    show(browser, FileBrowser::Purpose::model, folder.path());
    CHECK(names(browser) == "a.spz b.obj ");
    show(browser, FileBrowser::Purpose::cage, folder.path());
    CHECK(names(browser) == "b.obj ");
  }
}

TEST_CASE("stl_is_offered_for_surfaces_but_not_for_poses") {
  const test::TemporaryFolder folder;
  for (const char* name : {"a.stl", "b.obj"}) test::put_file(folder / name, "x");
  FileBrowser browser;
  for (const auto purpose :
       {FileBrowser::Purpose::model, FileBrowser::Purpose::cage, FileBrowser::Purpose::save_model}) {
    show(browser, purpose, folder.path());
    CHECK(names(browser) == "a.stl b.obj ");
    if (browser.saves()) CHECK(browser.formats().size() == 6);
  }
  for (const auto purpose : {FileBrowser::Purpose::pose, FileBrowser::Purpose::save_pose}) {
    show(browser, purpose, folder.path());
    CHECK(names(browser) == "b.obj ");
    CHECK(browser.formats().size() == 3);
  }
  show(browser, FileBrowser::Purpose::save_session, folder.path());
  CHECK(browser.formats().empty());
}

TEST_CASE("files_that_come_and_go_are_listed_anew_and_the_highlight_stays_on_its_file") {
  Listed folder;
  FileBrowser& browser = folder.browser;
  highlight(browser, 2);
  const std::string path = browser.path;
  const auto listed_anew = [&](const std::string& all, std::size_t highlighted) {
    browser.changed = {};  // forces a new list, because file times can have a low resolution
    refresh(browser);
    CHECK(names(browser) == all);
    CHECK(browser.highlighted == highlighted);
    CHECK(browser.path == path);
  };
  test::put_file(folder / "aaa.obj", "x");
  listed_anew("Sub aaa.obj alpha.ply Beta.obj gamma.viete ", 3);
  fs::remove(folder / "aaa.obj");
  fs::remove(folder / "alpha.ply");
  listed_anew("Sub Beta.obj gamma.viete ", 1);
  fs::remove(folder / "Beta.obj");
  fs::remove(folder / "gamma.viete");
  listed_anew("Sub ", 0);
  browser.entries.clear();
  refresh(browser);
  CHECK(browser.entries.empty());  // no new list, because the folder has not changed
}

TEST_CASE("a_filter_narrows_the_list_and_the_highlight_stays_within_it") {
  Listed folder;
  FileBrowser& browser = folder.browser;
  move_highlight(browser, 100);
  CHECK(browser.highlighted == 3);
  move_highlight(browser, -1);
  CHECK(browser.highlighted == 2);
  browser.filter = "PLY";
  CHECK(names(browser) == "alpha.ply ");
  move_highlight(browser, 1);
  CHECK(browser.highlighted == 0);
  browser.filter = "nothing";
  move_highlight(browser, -1);
  CHECK(browser.highlighted == 0);
}

TEST_CASE("a_path_may_be_typed_as_a_filter_and_begin_at_home") {
  FileBrowser browser;
  browser.folder = "/some/where";
  for (const char* name : {"", "dragon", "a/b", ".."}) {
    browser.filter = name;
    CHECK_FALSE(filters_by_path(browser));
  }
  for (const char* path : {"/", "/tmp/x.obj", "~", "~/x.obj"}) {
    browser.filter = path;
    CHECK(filters_by_path(browser));
  }
  browser.path = "x.obj";
  CHECK(typed_path(browser) == "/some/where/x.obj");
  browser.path = "/tmp/x.obj";
  CHECK(typed_path(browser) == "/tmp/x.obj");
  browser.path = "~/x.obj";
  CHECK(typed_path(browser) == fs::path(std::getenv("HOME")) / "x.obj");
  browser.path = "~other";
  CHECK(typed_path(browser) == "/some/where/~other");
}

TEST_CASE("the_file_to_save_gets_the_extension_it_lacks_and_an_existing_one_is_known") {
  Listed folder(FileBrowser::Purpose::save_session, "gamma.viete");
  FileBrowser& browser = folder.browser;
  CHECK(browser.replaces());
  browser.path = "walk";
  CHECK(chosen_file(browser) == browser.folder / "walk.viete");
  CHECK_FALSE(browser.replaces());
  browser.path = "Sub";
  CHECK_FALSE(browser.replaces());
  show(browser, FileBrowser::Purpose::save_model, folder.path(), "Beta.obj");
  CHECK(browser.replaces());
  set_format(browser, "ply");
  CHECK(chosen_file(browser) == browser.folder / "Beta.ply");
  CHECK(format_of(browser) == "ply");
  browser.path = "Beta.OBJ";
  CHECK(format_of(browser) == "obj");
  set_format(browser, "ply");
  CHECK_FALSE(browser.replaces());
  enter(browser, folder / "Sub");
  CHECK(chosen_file(browser).filename() == "Beta.ply");
  show(browser, FileBrowser::Purpose::model, folder.path());
  browser.path = (folder / "alpha.ply").string();
  CHECK_FALSE(browser.replaces());
}

TEST_CASE("an_animation_is_a_cache_or_gets_a_place_for_the_number_of_the_frame") {
  const test::TemporaryFolder folder;
  FileBrowser browser;
  show(browser, FileBrowser::Purpose::save_animation, folder.path(), "dragon");
  CHECK(format_list(browser) == "PC2, MDD, GLB, GLTF, OBJ, PLY, OFF, STL, PNG, MP4, WEBM or GIF");
  CHECK(chosen_file(browser).filename() == "dragon.pc2");
  for (const char* name : {"f_2.obj", "f_3.obj", "f_4.obj"}) test::put_file(folder / name, "");
  const std::string proposed = browser.path;
  browser.path = "f_#.obj";
  CHECK_FALSE(browser.replaces());
  browser.first_frame = 3;
  browser.last_frame = 9;
  CHECK(browser.replaced() == std::pair(browser.folder / "f_3.obj", std::size_t{2}));
  browser.path = "f_#_#.obj";
  CHECK_FALSE(browser.replaces());
  browser.path = proposed;
  CHECK(problem_of_name(browser) == "");
  set_format(browser, "obj");
  CHECK(chosen_file(browser).filename() == "dragon_####.obj");
  browser.path = (folder / "dragon_##.ply").string();
  CHECK(chosen_file(browser).filename() == "dragon_##.ply");
  set_format(browser, "glb");
  CHECK(chosen_file(browser).filename() == "dragon_##.glb");
  browser.path = (folder / "dragon.png").string();
  CHECK(chosen_file(browser).filename() == "dragon_####.png");
  browser.path = (folder / "dragon.mp4").string();
  CHECK(chosen_file(browser).filename() == "dragon.mp4");
  CHECK(problem_of_name(browser) == "");
  browser.path = (folder / "dragon.avi").string();
  CHECK(problem_of_name(browser) != "");
}

TEST_CASE("a_selected_file_fills_the_name_and_a_folder_keeps_it") {
  Listed folder;
  FileBrowser& browser = folder.browser;
  std::filesystem::create_directory(folder / "a folder");
  for (std::size_t i = 0; i < shown(browser).size(); ++i) {
    highlight(browser, i);
    CHECK(browser.highlighted == i);
    CHECK(browser.path == browser.folder / shown(browser)[i]->name);
  }
  move_highlight(browser, -100);
  CHECK(browser.path == browser.folder / shown(browser)[0]->name);
  highlight(browser, 1000);
  CHECK(browser.highlighted == 0);
  show(browser, FileBrowser::Purpose::save_model, folder.path(), "new.obj");
  CHECK(browser.highlighted == FileBrowser::none);
  REQUIRE(shown(browser)[0]->folder);
  highlight(browser, 0);
  CHECK(browser.path == browser.folder / "new.obj");
  highlight(browser, shown(browser).size() - 1);
  CHECK(browser.path == browser.folder / shown(browser).back()->name);
}

TEST_CASE("an_unwritable_name_is_detected_before_the_work") {
  Listed folder(FileBrowser::Purpose::save_pose, "pose.obj");
  FileBrowser& browser = folder.browser;
  CHECK(problem_of_name(browser).empty());
  browser.path = "pose.xyz";
  CHECK(test::mentions(problem_of_name(browser), "OBJ, PLY or OFF"));
  browser.path = "pose.stl";
  CHECK(problem_of_name(browser) == "pose.stl has an unsuitable format here; use OBJ, PLY or OFF");
  browser.path = "pose";
  CHECK(problem_of_name(browser).empty());
  browser.path = "no/such/folder/pose.obj";
  CHECK_FALSE(problem_of_name(browser).empty());
  show(browser, FileBrowser::Purpose::model, folder.path());
  browser.path = "none.ply";
  CHECK(test::mentions(problem_of_name(browser), "none.ply"));
}

TEST_CASE("files_in_use_are_neither_proposed_nor_accepted") {
  Listed folder;
  FileBrowser& browser = folder.browser;
  FilesInUse in_use;
  in_use.add(folder / "Beta.obj", "the model");
  in_use.add(folder / "alpha.ply", "the cage");
  show(browser, FileBrowser::Purpose::save_model, folder.path(), "Beta.obj", in_use);
  CHECK(chosen_file(browser).filename() == "Beta-2.obj");
  CHECK_FALSE(browser.replaces());
  fs::create_symlink("Beta.obj", folder / "link.obj");
  for (const char* name : {"Beta.obj", "./Beta.obj", "link.obj", "Beta"}) {
    browser.path = name;
    CHECK_FALSE(browser.replaces());
    CHECK(test::mentions(problem_of_name(browser), "is open (the model) and cannot be replaced; "));
  }
  browser.path = "alpha.obj";
  CHECK(problem_of_name(browser) == "");
  set_format(browser, "ply");
  CHECK(chosen_file(browser).filename() == "alpha-2.ply");
  enter(browser, folder / "Sub");
  CHECK(chosen_file(browser).filename() == "alpha.ply");
}
