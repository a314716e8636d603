// Open, save, lose nothing: sessions that open to the same picture, work that outlives kill -9, large files
// read aside.
#include <random>

#include "mesh/read.h"
#include "mesh/write.h"
#include "program/desktop.h"
#include "program/driver.h"
#include "scene/edit.h"
#include "scene/open.h"
#include "scene/saving.h"
#include "support/folder.h"

using namespace viete;
using test::Child;
using test::Desktop;
using test::Driver;
using test::wait_until;
using What = scene::OpenRequest::What;
namespace fs = std::filesystem;

namespace {

const fs::path dragon = test::assets_dir() / "dragon" / "dragon.ply",
               dragon_cage = test::assets_dir() / "dragon" / "cage.obj";

app::ViewerOptions remembering(const fs::path& state, glm::ivec2 size = {1280, 800}) {
  auto options = Driver::default_options();
  options.state = state;
  options.size = size;
  return options;
}

void open_dragon(Driver& d) {
  REQUIRE(scene::load_model(d.workspace(), dragon, dragon_cage));
  d.settle();
}

void drag_some_vertex(Driver& d, glm::vec2 by) {
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.drag(at, at + by);
}

// Away from everything, until the picture rests; without the panels, whose times are never the same.
render::Image rest_picture(Driver& d) {
  d.move({700, 760});
  d.settle();
  render::Image picture = d.picture();
  if (!d.workspace().view.panels) return picture;
  for (int y = 0; y < picture.height; ++y) {
    const int end = y >= picture.height - 26 ? picture.width : 320;
    std::fill_n(picture.rgba.begin() + 4 * std::ptrdiff_t(y) * picture.width, 4 * end, std::uint8_t{0});
  }
  return picture;
}

double largest_difference(std::span<const mesh::Point> a, std::span<const mesh::Point> b) {
  REQUIRE(a.size() == b.size());
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(a[i][k] - b[i][k]));
  }
  return largest;
}

std::vector<fs::path> kept_files(const fs::path& state) {
  std::vector<fs::path> files;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(state / "recovery", ignored)) files.push_back(entry.path());
  return files;
}

// A model and a cage that are small, so that starting a viewer is quick.
struct SmallModel {
  fs::path model, cage;

  explicit SmallModel(const fs::path& folder) : model(folder / "small.ply"), cage(folder / "small_cage.obj") {
    mesh::write(model, grid_ball(12));
    mesh::write(cage, scaled(grid_ball(3), 1.4));
  }

  static mesh::Surface scaled(mesh::Surface surface, double k) {
    for (auto& p : surface.positions) {
      for (double& x : p) x *= k;
    }
    return surface;
  }

  // A cube of n by n squares a side, blown up to a ball; sides do not share vertices.
  static mesh::Surface grid_ball(std::uint32_t n) {
    std::vector<mesh::Point> points;
    std::vector<mesh::Triangle> triangles;
    for (int side = 0; side < 6; ++side) {
      const auto first = static_cast<std::uint32_t>(points.size());
      for (std::uint32_t i = 0; i <= n; ++i) {
        for (std::uint32_t j = 0; j <= n; ++j)
          points.push_back(on_ball(side, 2.0 * i / n - 1, 2.0 * j / n - 1));
      }
      for (std::uint32_t i = 0; i < n; ++i) {
        for (std::uint32_t j = 0; j < n; ++j) {
          const std::uint32_t a = first + i * (n + 1) + j, b = a + 1, c = a + n + 1, e = c + 1;
          triangles.insert(triangles.end(), {{a, c, b}, {b, c, e}});
        }
      }
    }
    return mesh::from_triangles(std::move(points), triangles);
  }

  static mesh::Point on_ball(int side, double u, double v) {
    const double sign = side % 2 ? 1 : -1;
    mesh::Point p{};
    p[side / 2] = sign;
    p[(side / 2 + 1) % 3] = sign * u;
    p[(side / 2 + 2) % 3] = v;
    const double length = std::hypot(p[0], p[1], p[2]);
    for (double& x : p) x /= length;
    return p;
  }
};

std::string run(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>&1 </dev/null").c_str(), "r");
  REQUIRE(pipe);
  char buffer[4096];
  while (const std::size_t n = std::fread(buffer, 1, sizeof buffer, pipe)) text.append(buffer, n);
  const int status = pclose(pipe);
  return std::to_string(WIFEXITED(status) ? WEXITSTATUS(status) : 128) + " " + text;
}

std::string run_viete(const std::string& arguments, const fs::path& folder) {
  return run("cd '" + folder.string() + "' && '" + std::string(VIETE_BUILD_DIR) + "/viete' " + arguments);
}

}  // namespace

TEST_CASE("a_session_opens_to_the_same_picture_also_elsewhere") {
  const test::TemporaryFolder folder;
  fs::create_directories(folder / "work");
  fs::copy(dragon, folder / "work" / "dragon.ply");
  fs::copy(dragon_cage, folder / "work" / "cage.obj");
  render::Image before;
  std::vector<mesh::Point> mesh_before;
  {
    Driver d;
    REQUIRE(scene::load_model(d.workspace(), folder / "work" / "dragon.ply", folder / "work" / "cage.obj"));
    d.settle();
    drag_some_vertex(d, {60, -50});
    d.drag({800, 100}, {730, 160}, 2);  // orbit
    d.move({800, 300});
    d.wheel(2);
    d.press_key(scene::key('L'));
    d.press_key(scene::key('T'));
    d.press_key(scene::key('2'), false, true);
    before = rest_picture(d);
    const auto positions = d.viewer().deformer()->positions();
    mesh_before.assign(positions.begin(), positions.end());
    REQUIRE(scene::save_session(d.workspace(), folder / "work" / "a.viete"));
  }
  fs::rename(folder / "work", folder / "moved");
  const fs::path here = fs::current_path();
  fs::current_path(folder / "moved");
  {
    Driver d;
    REQUIRE(scene::open_now(d.workspace(), {What::model, {"a.viete"}}));
    const auto after = rest_picture(d);
    const auto positions = d.viewer().deformer()->positions();
    CHECK(std::equal(positions.begin(), positions.end(), mesh_before.begin(), mesh_before.end()));
    const double differing = render::difference(before, after, 0);
    if (differing > 0) {
      render::write_png(fs::path(VIETE_BUILD_DIR) / "session-before.png", before);
      render::write_png(fs::path(VIETE_BUILD_DIR) / "session-after.png", after);
    }
    CHECK(differing == 0);
  }
  fs::current_path(here);
}

TEST_CASE("render_and_deform_take_a_session_and_give_what_the_window_shows") {
  const test::TemporaryFolder folder;
  auto options = Driver::default_options();
  options.samples = 4;
  options.size = {800, 500};
  Driver d(options);
  d.workspace().view.panels = false;
  open_dragon(d);
  drag_some_vertex(d, {40, 30});
  const auto before = rest_picture(d);
  REQUIRE(scene::save_session(d.workspace(), folder / "a.viete"));
  REQUIRE(run_viete("render a.viete -o a.png", folder.path()).starts_with("0 "));
  CHECK(render::difference(before, render::read_png(folder / "a.png"), 0) == 0);
  REQUIRE(run_viete("deform a.viete -o a.ply", folder.path()).starts_with("0 "));
  // The window shows floats; what is written is double, by the window too.
  const auto written = mesh::read(folder / "a.ply").surface.positions;
  CHECK(largest_difference(written, d.viewer().deformer()->positions()) < 2e-5 * d.document().cage->diagonal);
  CHECK(largest_difference(written, d.viewer().deformer()->exact_positions()) < 1e-11 * d.document().cage->diagonal);
  d.workspace().requests.save_model = folder / "window.ply";
  d.frame();
  CHECK(largest_difference(written, mesh::read(folder / "window.ply").surface.positions) <
        1e-11 * d.document().cage->diagonal);

  REQUIRE(run_viete("render a.viete -o b.png --size 320x200 --light --look top", folder.path())
              .starts_with("0 "));
  CHECK(render::read_png(folder / "b.png").width == 320);
  CHECK(run_viete("deform a.viete -o b.ply --coordinates mvc", folder.path()).starts_with("0 "));
  CHECK(mesh::read(folder / "b.ply").surface.positions != mesh::read(folder / "a.ply").surface.positions);
}

TEST_CASE("a_session_on_the_command_line_stands_alone_and_its_errors_name_it") {
  const test::TemporaryFolder folder;
  test::put_file(folder / "a.viete", R"({"format": "viete session", "version": 1, "model": "gone.ply"})");
  CHECK(run_viete("render a.viete cage.obj -o a.png", folder.path()).starts_with("2 "));
  CHECK(run_viete("deform a.viete --pose p.obj -o a.ply", folder.path()).starts_with("2 "));
  CHECK(run_viete("a.viete cage.obj", folder.path()).starts_with("2 "));
  for (const char* line : {"render a.viete -o a.png", "deform a.viete -o a.ply", "a.viete"}) {
    const std::string said =
        run("cd '" + folder.path().string() + "' && env -u DISPLAY -u WAYLAND_DISPLAY '" +
            std::string(VIETE_BUILD_DIR) + "/viete' " + line);
    CHECK_MESSAGE((said.starts_with("1 ") && said.find("a.viete: model: ") != std::string::npos &&
                   said.find("gone.ply: there is no such file") != std::string::npos),
                  said);
  }
}

TEST_CASE("a_session_is_saved_and_opened_with_the_keyboard_alone") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state"));
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.settle();
  drag_some_vertex(d, {30, 20});
  CHECK(scene::has_unsaved_edits(d.workspace()));
  const auto posed = d.document().pose.positions;
  d.press_key(scene::key('S'), true);
  d.frame(2);
  REQUIRE(d.workspace().browser.open);
  d.press_key(scene::Key::enter);
  d.frame(2);
  CHECK(fs::exists(folder / "small.viete"));
  CHECK_FALSE(scene::has_unsaved_edits(d.workspace()));
  d.press_key(scene::key('R'), true);
  CHECK(scene::has_unsaved_edits(d.workspace()));

  d.press_key(scene::key('O'), true);
  d.frame(2);
  d.type("small.v");
  d.press_key(scene::Key::enter);
  d.settle();
  CHECK_FALSE(d.workspace().browser.open);
  CHECK(d.document().pose.positions == posed);
  CHECK(d.workspace().saved.session.filename() == "small.viete");
}

TEST_CASE("the_list_is_walked_with_arrows_and_folders_with_enter_and_backspace") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  fs::create_directories(folder / "a_folder");
  Driver d;
  d.workspace().remembered.folder = folder.path();
  d.press_key(scene::key('O'), true);
  d.frame(2);
  const fs::path top = d.workspace().browser.folder;
  d.press_key(scene::Key::enter);
  d.frame(2);
  CHECK(d.workspace().browser.folder == top / "a_folder");
  d.press_key(scene::Key::backspace);
  d.frame(2);
  CHECK(d.workspace().browser.folder == top);
  d.press_key(scene::Key::down);
  d.press_key(scene::Key::enter);
  d.settle();
  CHECK(d.document().model.path.filename() == "small.ply");
  d.press_key(scene::key('O'), true);
  d.frame(2);
  d.press_key(scene::Key::escape);
  CHECK_FALSE(d.workspace().browser.open);
}

TEST_CASE("replacing_a_file_is_said_before_it_is_done") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  test::put_file(folder / "small_deformed.ply", "precious");
  Driver d;
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.settle();
  d.press_key(scene::key('E'), true);
  d.frame(2);
  CHECK_FALSE(d.viewer().recorder().find("file_replaces"));
  d.click("format_ply");
  d.frame(2);
  CHECK(d.viewer().recorder().find("file_replaces"));
  d.click("file_cancel");
  CHECK(test::file_bytes(folder / "small_deformed.ply") == "precious");
  d.press_key(scene::key('E'), true);
  d.frame(2);
  d.click("format_ply");
  d.click("file_choose");
  d.frame(2);
  CHECK(mesh::read(folder / "small_deformed.ply").surface.positions.size() ==
        d.document().model.facts.vertices);
}

TEST_CASE("unsaved_edits_are_in_a_file_after_each_finished_edit_and_gone_when_saved_or_undone") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state";
  const auto kept_pose = [&] { return scene::read_session(kept_files(state).front()).pose->positions; };
  const auto settled = [&](std::size_t files) {
    return wait_until([&] { return kept_files(state).size() == files; }, 5);
  };
  {
    Driver d(remembering(state));
    REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
    d.settle();
    CHECK(kept_files(state).empty());
    drag_some_vertex(d, {30, 20});
    REQUIRE(settled(1));
    CHECK(kept_pose() == d.document().pose.positions);
    const auto first = d.document().pose.positions;

    const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
    d.press_and_move(at, at + glm::vec2(50, 5));
    CHECK(kept_pose() == first);
    d.press_key(scene::Key::escape);
    d.button(0, false);
    CHECK(kept_pose() == first);

    d.press_key(scene::key('Z'), true);
    REQUIRE(settled(0));
    d.press_key(scene::key('Y'), true);
    REQUIRE(settled(1));
    REQUIRE(scene::save_session(d.workspace(), folder / "a.viete"));
    d.frame();
    REQUIRE(settled(0));
    drag_some_vertex(d, {-30, 20});
  }
  CHECK_MESSAGE(kept_files(state).size() == 1, "quitting without saving keeps the work");
}

TEST_CASE("opening_another_file_over_unsaved_edits_sets_them_aside_and_restore_brings_them_back") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state"));
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.settle();
  drag_some_vertex(d, {30, 20});
  const auto posed = d.document().pose.positions;
  const auto picture = rest_picture(d);
  d.workspace().requests.open = scene::OpenRequest{What::model, {dragon, dragon_cage}};
  d.settle();
  CHECK(d.document().model.path == dragon);
  REQUIRE(d.workspace().leftovers.size() == 1);
  CHECK(d.workspace().leftovers[0].name == "small.ply");

  d.frame(3);
  d.click("restore_leftover");
  d.settle();
  CHECK(d.document().pose.positions == posed);
  CHECK(d.workspace().leftovers.empty());
  CHECK(scene::has_unsaved_edits(d.workspace()));
  CHECK(render::difference(picture, rest_picture(d), 0) == 0);
  CHECK(wait_until([&] { return kept_files(folder / "state").size() == 1; }, 5));
  CHECK(scene::read_session(kept_files(folder / "state").front()).pose->positions == posed);
}

TEST_CASE("discarded_work_is_removed_and_work_put_off_stays") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  const fs::path state = folder / "state";
  fs::create_directories(state / "recovery");
  for (const char* name : {"999999999-1.viete", "999999999-2.viete"})
    test::put_file(state / "recovery" / name, "{}");
  Driver d(remembering(state));
  d.frame(3);
  REQUIRE(d.workspace().leftovers.size() == 2);
  d.click("put_off_leftover");
  d.frame(3);
  CHECK(kept_files(state).size() == 2);
  REQUIRE(d.workspace().leftovers.size() == 1);
  d.click("restore_leftover");  // it is broken: said, and still there
  d.settle();
  CHECK(d.workspace().messages.all().back().severity == scene::Severity::error);
  CHECK(d.workspace().leftovers.size() == 1);
  d.click("discard_leftover");
  d.frame(3);
  CHECK(d.workspace().leftovers.empty());
  CHECK(kept_files(state).size() == 1);
}

TEST_CASE("a_state_folder_that_cannot_be_written_is_said_once_and_nothing_breaks") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  test::put_file(folder / "state", "a file, not a folder");
  Driver d(remembering(folder / "state"));
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.settle();
  drag_some_vertex(d, {30, 20});
  d.frame(5);
  REQUIRE(wait_until(
      [&] {
        d.frame();
        return !d.workspace().messages.all().empty();
      },
      5));
  CHECK(d.workspace().messages.all().back().text.find((folder / "state").string()) != std::string::npos);
  CHECK(d.document().history.undo_count() == 1);
}

TEST_CASE("recent_files_and_the_seen_hints_are_remembered_from_run_to_run") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  {
    Driver d(remembering(folder / "state"));
    CHECK(d.workspace().view.hints);
    REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
    d.settle();
    drag_some_vertex(d, {30, 20});
  }
  Driver d(remembering(folder / "state"));
  CHECK_FALSE(d.workspace().view.hints);
  REQUIRE(d.workspace().remembered.recent.size() == 1);
  d.frame(3);
  d.click("recent/0");
  d.settle();
  CHECK(d.document().model.path == small.model);
  CHECK(d.document().cage_file.path == small.cage);
}

// Runs in a process of its own, see the next test: finishes edit after edit, and says in a log which one is
// about to be finished and which one is.
TEST_CASE("child_that_edits_until_it_is_killed" * doctest::skip()) {
  const fs::path folder = std::getenv("VIETE_TEST_FOLDER");
  const SmallModel small(folder);
  Driver d(remembering(folder / "state", {640, 400}));
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.workspace().view.panels = false;
  d.settle();
  const int log = open((folder / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0600);
  const auto say = [&](const char* what, double x) {
    char line[64];
    const int n = std::snprintf(line, sizeof line, "%s %.17g\n", what, x);
    REQUIRE(write(log, line, static_cast<std::size_t>(n)) == n);
  };
  const std::uint32_t v = d.free_vertex();
  std::mt19937 random(7);
  for (;;) {
    const glm::vec2 at = glm::round(d.vertex(v)), center(320, 200);
    const glm::vec2 by = glm::sign(center - at) * glm::vec2(static_cast<float>(5 + random() % 20),
                                                            static_cast<float>(5 + random() % 20));
    d.press_and_move(at, at + by);
    say("about", d.document().pose.positions[v][0]);
    d.button(0, false);
    d.frame();
    say("done", d.document().pose.positions[v][0]);
  }
}

TEST_CASE("kill_9_at_any_moment_loses_at_most_the_running_drag") {
  std::mt19937 random(11);
  for (int round = 0; round < 12; ++round) {
    CAPTURE(round);
    const test::TemporaryFolder folder;
    const fs::path log = folder / "log";
    {
      Child child("env VIETE_TEST_FOLDER='" + folder.path().string() + "' '" +
                      fs::read_symlink("/proc/self/exe").string() +
                      "' --no-skip --test-case=child_that_edits_until_it_is_killed",
                  folder / "out");
      REQUIRE_MESSAGE(wait_until([&] { return fs::exists(log) && fs::file_size(log) > 60; }, 60),
                      test::file_bytes(folder / "out"));
      std::this_thread::sleep_for(std::chrono::microseconds(random() % 200000));
      child.kill_now();
    }
    // The edits that may be in the file: the last that was finished, and the one that was just being
    // finished.
    std::vector<double> allowed;
    std::ifstream lines(log);
    std::string what;
    for (double x = 0; lines >> what >> x;) {
      if (what == "done") allowed.clear();
      allowed.push_back(x);
    }
    REQUIRE_FALSE(allowed.empty());
    const auto leftovers = scene::find_leftovers(folder / "state" / "recovery");
    REQUIRE(leftovers.size() == 1);
    const auto positions = scene::read_session(leftovers[0].file).pose->positions;
    const auto holds = [&](double x) {
      return std::any_of(positions.begin(), positions.end(), [x](const auto& p) { return p[0] == x; });
    };
    CHECK(std::any_of(allowed.begin(), allowed.end(), holds));
  }
}

TEST_CASE("a_real_window_that_is_killed_offers_its_work_at_the_next_start") {
  if (test::no_desktop()) return;
  auto options = Driver::default_options();
  options.size = {1440, 900};
  Driver d(options);
  open_dragon(d);
  d.frame();
  const glm::ivec2 from(glm::round(d.vertex(d.free_vertex()))), to = from + glm::ivec2(72, -56);
  d.drag(from, to);

  Desktop desktop;
  Child viewer(desktop.viete(""), desktop.folder / "first.log");
  desktop.xdotool("search --sync --onlyvisible --name dragon");
  std::this_thread::sleep_for(std::chrono::seconds(3));
  desktop.drag(from, to);
  REQUIRE(wait_until([&] { return !kept_files(desktop.folder / "state" / "viete").empty(); }, 20));
  viewer.kill_now();
  const auto leftovers = scene::find_leftovers(desktop.folder / "state" / "viete" / "recovery");
  REQUIRE(leftovers.size() == 1);
  CHECK(leftovers[0].name == "dragon.ply");
  const auto kept = scene::read_session(leftovers[0].file).pose->positions;
  CHECK(kept == d.document().pose.positions);

  Child again(desktop.viete(""), desktop.folder / "second.log");
  desktop.xdotool("search --sync --onlyvisible --name dragon");
  std::this_thread::sleep_for(std::chrono::seconds(3));
  desktop.xdotool("key ctrl+b");  // Restore
  REQUIRE(wait_until([&] { return !fs::exists(leftovers[0].file); }, 20));
  const auto files = kept_files(desktop.folder / "state" / "viete");
  REQUIRE(files.size() == 1);
  CHECK(scene::read_session(files[0]).pose->positions == kept);
  desktop.xdotool("key ctrl+z");  // recovered work has no history: nothing happens
  desktop.xdotool("key ctrl+q");
  REQUIRE(wait_until([&] { return again.finished(); }, 20));
  CHECK(again.exit_code() == 0);
  CHECK(test::file_bytes(desktop.folder / "second.log").find("unsaved edits are kept") != std::string::npos);
}

// Frames until the bar with its button is there; false if the file was read before a person could have seen one.
bool sees_loading_bar(Driver& d) {
  bool seen = false;
  const bool ended = wait_until(
      [&] {
        d.frame();
        seen = d.viewer().recorder().find("stop_work").has_value();
        return seen || !d.viewer().loading();
      },
      60);
  REQUIRE(ended);
  return seen;
}

TEST_CASE("a_large_file_is_read_aside_with_progress_and_can_be_cancelled") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  auto options = Driver::default_options();
  options.size = {640, 400};
  Driver d(options);
  const scene::OpenRequest request{What::model, {folder / "large.obj"}};

  // 348,000 vertices, 36 MB of text; a machine that reads them in a moment gets more.
  int cells = 240;
  const mesh::Surface* surface = nullptr;
  for (;; cells *= 2) {
    REQUIRE_MESSAGE(cells < 1000, "5.5 million vertices were read within 0.2 s");
    mesh::write(folder / "large.obj", SmallModel::grid_ball(cells));
    REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
    d.settle();
    drag_some_vertex(d, {20, 10});
    surface = d.document().model.surface.get();
    d.workspace().requests.open = request;
    if (!sees_loading_bar(d)) continue;
    CHECK(d.workspace().loading.what == "Reading large.obj");
    CHECK(d.document().model.surface.get() == surface);
    d.viewer().input().push(app::InputEvent::key(ui::key_code(scene::Key::escape), true));
    d.viewer().input().push(app::InputEvent::key(ui::key_code(scene::Key::escape), false));
    REQUIRE(wait_until(
        [&] {
          d.frame();
          return !d.viewer().loading();
        },
        60));
    if (d.document().model.surface.get() == surface) break;
  }
  CHECK(d.document().history.undo_count() == 1);
  CHECK(d.workspace().messages.all().back().text.find("Stopped reading") != std::string::npos);

  d.workspace().requests.open = request;
  double furthest = 0;
  REQUIRE(wait_until(
      [&] {
        d.frame();
        const auto& loading = d.workspace().loading;
        if (loading.running) CHECK(loading.done >= furthest);
        furthest = std::max(furthest, loading.done);
        return !d.viewer().loading();
      },
      60));
  CHECK(furthest > 0.1);
  CHECK(d.document().model.facts.vertices == static_cast<std::size_t>(6 * (cells + 1) * (cells + 1)));
}

TEST_CASE("what_was_read_waits_until_the_drag_is_over") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  Driver d(remembering(folder / "state"));
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.settle();
  const glm::vec2 at = glm::round(d.vertex(d.free_vertex()));
  d.press_and_move(at, at + glm::vec2(40, 5));
  d.workspace().requests.open = scene::OpenRequest{What::model, {dragon, dragon_cage}};
  for (int i = 0; i < 20; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
    d.frame();
  }
  CHECK(d.document().model.path == small.model);
  d.button(0, false);
  REQUIRE(wait_until(
      [&] {
        d.frame();
        return d.document().model.path == dragon;
      },
      20));
  CHECK_MESSAGE(d.workspace().leftovers.size() == 1, "the drag that was finished is kept");
}

TEST_CASE("a_load_that_fails_leaves_everything_as_it_was") {
  const test::TemporaryFolder folder;
  const SmallModel small(folder.path());
  test::put_file(folder / "broken.obj", "v 0 0 0\nf 1 2 3\n");
  Driver d;
  REQUIRE(scene::load_model(d.workspace(), small.model, small.cage));
  d.settle();
  drag_some_vertex(d, {20, 10});
  const auto posed = d.document().pose.positions;
  const auto opened = d.workspace().opened;
  for (const What what : {What::model, What::cage, What::pose, What::dropped, What::recovery}) {
    d.workspace().requests.open = scene::OpenRequest{what, {folder / "broken.obj"}};
    d.settle();
    const std::string said = d.workspace().messages.all().back().text;
    CHECK_MESSAGE(said.find("broken.obj:") != std::string::npos, said);
    CHECK(d.document().pose.positions == posed);
    CHECK(d.workspace().opened == opened);
  }
}
