// What hands do, recorded as a script and replayed: the same document to the bit; and the tour.
#include <sys/resource.h>

#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "app/assets.h"
#include "app/script_player.h"
#include "app/script_show.h"
#include "base/error.h"
#include "program/driver.h"
#include "program/small_scene.h"
#include "scene/workspace/saving.h"
#include "support/folder.h"
#include "support/pictures.h"
#include "support/text.h"

using namespace viete;
using test::Driver;
namespace fs = std::filesystem;

namespace {

// Where the program writes what has no name yet.
struct WorkingFolder : test::TemporaryFolder {
  fs::path before = fs::current_path();
  WorkingFolder() { fs::current_path(path()); }
  ~WorkingFolder() { fs::current_path(before); }

  std::vector<fs::path> files(const std::string& extension) const {
    std::vector<fs::path> all;
    for (const auto& entry : fs::directory_iterator(path()))
      if (entry.path().extension() == extension) all.push_back(entry.path());
    return all;
  }
};

void record_from_here(Driver& d) {
  d.click("menu/Help");
  d.frame(2);
  d.click("menu/record");
  d.frame(2);
  REQUIRE(d.workspace().scripting.recording);
}

std::string text_of(const fs::path& file) {
  return test::file_bytes(file);
}

// As a shell runs it, without a display: what it says; nothing where it went well.
std::string run_viete(const fs::path& folder, const std::string& arguments) {
  const std::string command = "cd '" + folder.string() + "' && env -u DISPLAY -u WAYLAND_DISPLAY '" +
                              (test::build_dir() / "viete").string() + "' " + arguments + " > said 2>&1";
  const bool well = std::system(command.c_str()) == 0;
  return well ? "" : text_of(folder / "said");
}

// All that the picture is made of, as it would be saved, but for what is unsaved of it.
std::string document(Driver& d) {
  scene::Session session = scene::session_of(d.workspace());
  session.origin.clear(), session.origin_content.reset(), session.first_edit.clear();
  return scene::session_text(session, "/nowhere/of.viete", false);
}

void replay(Driver& d, const fs::path& file) {
  d.workspace().remembered.layout.sections.clear();
  app::ScriptPlayer player(app::read_script(file), d.viewer());
  player.open();
  d.settle();
  app::play_at_once(player, d.viewer());
  d.settle();
}

fs::path write(const fs::path& file, const std::string& text) {
  std::ofstream(file) << text;
  return file;
}

std::string problem_of(const fs::path& file, const std::string& text) {
  try {
    app::read_script(write(file, text));
  } catch (const base::Error& error) {
    return error.what();
  }
  return "";
}

void in_the_view(Driver& d, std::uint32_t v) {
  d.drag({700, 300}, {640, 350}, 2);
  d.move({600, 400});
  d.wheel(1.25f);
  d.click(d.vertex(v));
  d.press_key(scene::key('W'));
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(41.3f, -17.7f));
  d.press_key(scene::key('Z'), true);
  d.press_key(scene::key('Z'), true, true);
  d.press_key(scene::key('B'));
  d.drag({500, 200}, {700, 500});
  d.press_key(scene::key('G'), false, false, true);
}

void in_panels(Driver& d, std::uint32_t v) {
  d.click("method_diag");
  d.choose("way", "way_local");
  REQUIRE(d.until([&] { return !d.viewer().working(); }));
  d.frame(3);
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(-33, 21));
  d.click("keep_pose");
  d.drag(d.place_of("turn"), d.place_of("turn") + glm::vec2(-30, 0));
}

void with_files(Driver& d, std::uint32_t) {
  d.viewer().drop({test::assets_dir() / "dragon" / "shape_coiled.pc2"});
  d.frame();
  REQUIRE(d.until([&] { return d.document().library.poses.size() == 1; }));
  d.drag(d.place_of("pose_weight/0") - glm::vec2(20, 0), d.place_of("pose_weight/0") + glm::vec2(30, 0));
  d.press_key(scene::key('I'));
  d.press_key(scene::Key::right);
  d.frame(7);
  d.press_key(scene::Key::f2);
  d.press_key(scene::Key::f2);
}

// The document after it, and its script in the folder. There is one viewer at a time.
std::string recorded(const WorkingFolder& folder, void (*act)(Driver& d, std::uint32_t v)) {
  Driver d;
  d.open_dragon("pose_alert");
  d.press_key(scene::key('E'));  // the tool that turns, which no session knows
  const std::uint32_t v = d.free_vertex();
  d.drag(d.vertex(v), d.vertex(v) + glm::vec2(20, -10));
  d.settle();
  record_from_here(d);
  REQUIRE(folder.files(".script").size() == 1);
  act(d, v);
  const auto mark = *d.viewer().recorder().find("recording");
  d.click(glm::vec2(0.5f * (mark.x0 + mark.x1), 0.5f * (mark.y0 + mark.y1)));
  d.settle();
  REQUIRE_FALSE(d.workspace().scripting.recording);
  return document(d);
}

}  // namespace

TEST_CASE("what_a_hand_did_is_done_again_to_the_bit") {
  const WorkingFolder folder;
  std::string made;
  SUBCASE("with the mouse in the view and keys") {
    made = recorded(folder, in_the_view);
  }
  SUBCASE("with panels, and a way that is bound aside") {
    made = recorded(folder, in_panels);
  }
  SUBCASE("with files that were dropped, and time") {
    made = recorded(folder, with_files);
  }
  {
    Driver again;
    replay(again, folder.files(".script").front());
    const bool same = document(again) == made;
    CHECK(same);
  }

  REQUIRE(run_viete(folder.path(), "replay " + folder.files(".script").front().string() + " -o end.viete") ==
          "");
  const auto here = nlohmann::json::parse(made),
             there = nlohmann::json::parse(text_of(folder.path() / "end.viete"));
  for (const char* part : {"pose", "method", "selection", "poses", "time", "shapes", "weights"}) {
    INFO(part);
    const bool same = here.value(part, nlohmann::json()) == there.value(part, nlohmann::json());
    CHECK(same);
  }
}

TEST_CASE("a_script_leads_up_to_whatever_ends_the_program") {
  const WorkingFolder folder;
  const auto place = [&] {
    Driver d;
    d.open_dragon();
    record_from_here(d);
    const std::uint32_t v = d.free_vertex();
    d.press_and_move(d.vertex(v), d.vertex(v) + glm::vec2(30, 30));
    return d.document().pose.positions;
  }();
  Driver again;
  replay(again, folder.files(".script").front());
  CHECK(again.document().pose.positions == place);
}

TEST_CASE("a_recording_that_cannot_be_written_ends_and_says_so") {
  const WorkingFolder folder;
  Driver d;
  d.open_dragon();
  record_from_here(d);
  const rlimit before = [] {
    rlimit limit{};
    getrlimit(RLIMIT_FSIZE, &limit);
    return limit;
  }();
  const rlimit full{fs::file_size(folder.files(".script").front()) + 64, before.rlim_max};
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  setrlimit(RLIMIT_FSIZE, &full);
  d.frame(30);
  setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  CHECK_FALSE(d.workspace().scripting.recording);
  CHECK(test::mentions(d.workspace().messages.all().back().text, "not all of it could be written"));
}

TEST_CASE("a_screenshot_without_panels_shows_no_tool") {
  const WorkingFolder folder;
  test::SmallScene small(test::small_options(), test::with_pixels);
  Driver& d = small.d;
  const auto screenshot = [&] {
    d.press_key(scene::Key::f12);
    d.settle();
    const std::vector<fs::path> files = folder.files(".png");
    REQUIRE(files.size() == 1);
    render::Image image = test::read_png(files.front());
    fs::remove(files.front());
    return image;
  };
  d.workspace().view.panels = false;
  d.settle();
  const render::Image plain = screenshot();
  d.press_key('A', true);
  d.settle();
  REQUIRE_FALSE(d.document().selection.empty());
  CHECK(test::difference(plain, d.picture(), 12) > 0.003);  // the window has them
  CHECK(test::difference(plain, screenshot(), 12) == 0);
}

TEST_CASE("a_replay_writes_no_file_of_a_persons") {
  const WorkingFolder folder;
  {
    Driver d;
    d.open_dragon("pose_alert");
    scene::save_session(d.workspace(), folder.path() / "work.viete");
  }
  const std::string before = text_of(folder.path() / "work.viete");
  const fs::path script =
      write(folder.path() / "save.script",
            "viete script 1\nopen \"work.viete\"\nframe 0.1 3\ncommand reset_pose\nframe 0.1\n"
            "key down Ctrl\nframe 0.1\nkey down S\nframe 0.1\nkey up S\nkey up Ctrl\nframe 0.1 3\n"
            "command screenshot\nframe 0.1\ncommand record\nframe 0.1\ncommand quit\nframe 0.1\n");
  const std::size_t count = folder.files(".script").size();
  Driver d;
  replay(d, script);
  CHECK(text_of(folder.path() / "work.viete") == before);
  CHECK(folder.files(".png").empty());
  CHECK(folder.files(".script").size() == count);
  CHECK_FALSE(d.viewer().closed());
  CHECK_FALSE(scene::differs_from_rest(d.document()));

  const auto run = [&](const std::string& arguments) {
    return run_viete(folder.path(), "replay save.script " + arguments);
  };
  CHECK(test::mentions(run("-o work.viete"), "what the script opens"));
  CHECK(test::mentions(run("-o save.script"), ".viete or .png"));
  CHECK(test::mentions(run(""), "no window"));
  CHECK(text_of(folder.path() / "work.viete") == before);
  REQUIRE(run("-o end.png") == "");
  CHECK(fs::file_size(folder.path() / "end.png") > 10000);
}

TEST_CASE("a_script_that_is_wrong_is_told_by_its_line") {
  const WorkingFolder folder;
  const fs::path file = folder.path() / "a.script";
  const auto problem = [&](const std::string& lines) { return problem_of(file, "viete script 1\n" + lines); };
  CHECK(problem("frame 0.1\n# nothing\n\nframe 0.1 3\nkey down Page Up\nmove by -1.5 2\n").empty());
  CHECK(test::mentions(problem_of(file, "solid cube\n"), "a.script:1: this is no script"));
  CHECK(test::mentions(problem_of(file, ""), "there is no step"));
  CHECK(test::mentions(problem("frame 0.1\nfrobnicate\n"), "a.script:3: \"frobnicate\" is nothing"));
  CHECK(test::mentions(problem("move view 1 two\n"), "\"two\" is no number"));
  CHECK(test::mentions(problem("move view 1 nan\n"), "is no number"));
  CHECK(test::mentions(problem("move there 1 1\n"), "is no place"));
  CHECK(test::mentions(problem("move widget way 1 1\n"), "in quotation marks"));
  CHECK(test::mentions(problem("press fourth\n"), "left, right or middle"));
  CHECK(test::mentions(problem("key down Hyper\n"), "\"Hyper\" is no key"));
  CHECK(test::mentions(problem("command launch\n"), "no command \"launch\""));
  CHECK(test::mentions(problem("frame -1\n"), "no number from 0"));
  CHECK(test::mentions(problem("frame 0.1 0.5\n"), "no number from 1"));
  CHECK(test::mentions(problem("wait a minute\n"), "more on this line"));
  CHECK(test::mentions(problem("frame 0.1\nwindow 100 100\n"), "\"window\" is nothing"));
  CHECK_THROWS_WITH_AS(app::read_script(folder.path()), doctest::Contains("this is a folder"), base::Error);
  CHECK_THROWS_WITH_AS(app::read_script(folder.path() / "none"), doctest::Contains("cannot be read"),
                       base::Error);

  const auto played = [&](const std::string& lines) -> std::string {
    Driver d;
    try {
      replay(d, write(file, "viete script 1\n" + lines));
    } catch (const base::Error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(test::mentions(played("move vertex 3 0 0\n"), "a.script:2: there is no cage with a vertex 3"));
  CHECK(test::mentions(played("command play\n"), "cannot be done here"));
  CHECK(played("try play\nframe 0.1\n").empty());
  CHECK(test::mentions(played("move widget \"no such\" 0 0\n"), "\"no such\" is not to be seen"));
}

TEST_CASE("every_step_of_a_script_reads_as_it_was_written") {
  const test::TemporaryFolder folder;
  const std::string lines =
      "move widget \"pose/1 \\\"a\\\"\" -0.0625 3\nglide 0.5 vertex 7 0 0\nmove window 1 2\npress middle\n"
      "release middle\nkey down Right Ctrl\nkey up Num 1\nkey down 280\nkey up -\ntype "
      "\"\xC3\xA4\\\\b\"\nwheel -1.5\nleave\n"
      "drop \"a b.obj\" \"../c.obj\"\ncommand undo\ntry redo\nframe 0.015625 3\nwait\npause 2.5\nsize 640 "
      "480\n"
      "chapter \"Title\" \"Text.\"\n";
  const std::string head =
      "viete script 1\nwindow 800 600\nview 500.5\nopen \"m.obj\"\nbrush 12.5 0.25\narranged {}\n";
  const app::Script script = app::read_script(write(folder.path() / "a.script", head + lines));
  std::string again;
  for (const app::Step& step : script.steps) again += app::text_of(step, folder.path());
  CHECK(again == lines);
  CHECK(app::head_of(script) == head);
}

TEST_CASE("the_tour_goes_on_as_a_person_asks_and_leaves_what_it_found") {
  Driver d;
  REQUIRE(d.open({test::dragon}));
  d.settle();
  auto& w = d.workspace();
  w.remembered.layout.sections["Poses"] = false;
  const auto layout = w.remembered.layout;
  app::ScriptShow show(d.viewer());
  const auto& state = w.scripting;
  const auto frame = [&] { d.viewer().frame(show.step(1.0f / 20)); };
  const auto until = [&](auto condition) {
    for (int i = 0; i < 4000 && !condition(); ++i) {
      frame();
      if (d.viewer().working()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
    INFO(state.chapter, " ", state.title);
    for (const auto& message : w.messages.all())
      CHECK_MESSAGE(message.severity != scene::Severity::error, message.text);
    REQUIRE(condition());
  };
  const auto hand = [&](const std::string& widget) {
    const auto at = d.place_of(widget);
    const auto send = [&](platform::InputEvent event) {
      if (!show.takes(event)) d.viewer().input().push(event);
      frame();
    };
    send(platform::InputEvent::move(at));
    send(platform::InputEvent::button(0, true));
    send(platform::InputEvent::button(0, false));
    frame();
  };
  d.click("menu/Help");
  d.frame(2);
  d.click("menu/tour");
  until([&] { return state.waits; });
  CHECK(state.chapter == 1);
  CHECK(state.of == 6);
  CHECK(scene::differs_from_rest(d.document()));  // it was dragged
  CHECK_FALSE(scene::has_unsaved_edits(w));       // but not by the user
  hand("next_chapter");
  until([&] { return state.playing && state.chapter == 2; });
  hand("next_chapter");  // while it plays: the hand has the cursor
  until([&] { return state.chapter == 3 && state.waits; });
  CHECK(d.document().method == sym3::Method::fast);
  hand("previous_chapter");
  until([&] { return state.chapter == 2 && state.waits; });
  for (std::size_t chapter = 3; chapter <= 6; ++chapter) {
    hand("next_chapter");
    until([&] { return state.chapter == chapter && state.waits; });
  }
  CHECK(d.document().library.poses.size() == 4);  // with the shape
  hand("end_script");
  CHECK_FALSE(show.running());
  CHECK_FALSE(state.shown());
  CHECK_FALSE(scene::has_unsaved_edits(w));
  scene::find_command("keep_pose")->run(w);  // as a user does
  CHECK(scene::has_unsaved_edits(w));
  CHECK(w.remembered.layout == layout);
}
