#include "scene/session.h"

#include <doctest/doctest.h>

#include <random>

#include "base/error.h"
#include "scene/edit.h"
#include "scene/files.h"
#include "scene/open.h"
#include "scene/saving.h"

using namespace viete;
using namespace viete::scene;
namespace fs = std::filesystem;

namespace {

// Everything a session holds is away from its default.
Workspace worked(const test::CubeFiles& files) {
  Workspace w;
  w.viewport = {{1000, 800}, {320, 0}, {680, 774}};
  REQUIRE(load_model(w, files.model, files.cage));
  w.document.pose.positions[3] = {0.1, -1.0 / 3, 1e-17};
  w.document.pose.turns = {{0.1, 6.3, -1e-9}};
  w.document.selection.apply(std::vector<std::uint32_t>{2, 5}, SelectMode::replace);
  w.document.method = sym3::Method::sd;
  w.document.coordinates = deform::Coordinates::mean_value;
  w.document.reach = 2.7;
  w.camera.set_pose({{0.1f, 0.2f, 0.3f}, 3.3f, -2.7f, 0.123f});
  w.view = {.dark = false,
            .model = false,
            .wireframe = true,
            .cage = false,
            .grid = false,
            .ghost = true,
            .error_map = true,
            .panels = false,
            .hints = false};
  return w;
}

void check_same(const Workspace& a, const Workspace& b) {
  CHECK(a.document.pose.positions == b.document.pose.positions);
  CHECK(a.document.pose.turns == b.document.pose.turns);
  CHECK(a.document.selection == b.document.selection);
  CHECK(a.document.method == b.document.method);
  CHECK(a.document.coordinates == b.document.coordinates);
  CHECK(a.document.reach == b.document.reach);
  CHECK(a.camera.pose() == b.camera.pose());
  CHECK(a.view == b.view);
  CHECK(a.document.model.surface->positions == b.document.model.surface->positions);
}

std::string refusal(const fs::path& file) {
  Workspace w;
  CHECK_FALSE(open_now(w, {OpenRequest::What::model, {file}}));
  return w.messages.all().back().text;
}

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

std::string with(const std::string& key, const std::string& value) {
  return R"({"format": "viete session", "version": 1, "model": "model.obj", "cage": "cage.obj", ")" + key +
         "\": " + value + "}";
}

}  // namespace

TEST_CASE("a_session_brings_everything_back_to_the_last_bit") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  REQUIRE(save_session(w, files / "a.viete"));
  Workspace back;
  REQUIRE(open_now(back, {OpenRequest::What::model, {files / "a.viete"}}));
  check_same(w, back);
  CHECK(back.saved.session == files / "a.viete");
  CHECK_FALSE(has_unsaved_edits(back));
  back.viewport = w.viewport;
  CHECK(session_text(session_of(back), files / "a.viete") == test::file_bytes(files / "a.viete"));
}

TEST_CASE("a_session_names_its_files_relative_to_itself_and_moves_with_them") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  fs::create_directories(files / "one" / "deep");
  REQUIRE(save_session(w, files / "one" / "deep" / "a.viete"));
  CHECK(mentions(test::file_bytes(files / "one" / "deep" / "a.viete"), "\"../../model.obj\""));
  const test::TemporaryFolder elsewhere;
  fs::copy(files.path(), elsewhere / "moved", fs::copy_options::recursive);
  fs::remove(files.model);
  Workspace back;
  REQUIRE(open_now(back, {OpenRequest::What::model, {elsewhere / "moved" / "one" / "deep" / "a.viete"}}));
  check_same(w, back);
}

TEST_CASE("a_session_saved_through_a_linked_folder_finds_its_files") {
  const test::CubeFiles files;
  fs::create_directories(files / "real" / "deep");
  fs::create_directory_symlink(files / "real" / "deep", files / "link");
  Workspace w = worked(files);
  REQUIRE(save_session(w, files / "link" / "a.viete"));
  Workspace back;
  CHECK(open_now(back, {OpenRequest::What::model, {files / "link" / "a.viete"}}));
  CHECK(open_now(back, {OpenRequest::What::model, {files / "real" / "deep" / "a.viete"}}));
}

TEST_CASE("a_camera_that_is_still_easing_is_saved_where_it_will_be") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  w.camera.look(StandardView::front);
  const CameraPose goal = w.camera.destination();
  CHECK(session_of(w).camera == goal);
  CHECK(goal.yaw == 0);
}

TEST_CASE("only_a_model_is_required_and_unknown_keys_are_ignored") {
  const test::CubeFiles files;
  test::put_file(files / "a.viete",
                 R"({"format": "viete session", "version": 1, "model": "model.obj", "later": {"x": [1]}})");
  Workspace w;
  CHECK(open_now(w, {OpenRequest::What::model, {files / "a.viete"}}));
  CHECK_FALSE(w.document.has_cage());
  test::put_file(files / "b.viete", with("view", R"({"dark": false, "holograms": 3})"));
  CHECK(open_now(w, {OpenRequest::What::model, {files / "b.viete"}}));
  CHECK_FALSE(w.view.dark);
  CHECK(w.view.grid);
  CHECK_FALSE(differs_from_rest(w.document));
}

TEST_CASE("what_is_wrong_in_a_session_is_named_with_file_and_key") {
  const test::CubeFiles files;
  const struct {
    const char *key, *value, *said;
  } cases[] = {
      {"method", "\"best\"", "a.viete: method: \"best\" is not known; use diag"},
      {"method", "7", "a.viete: method: found a number where a text belongs"},
      {"coordinates", "\"x\"", "a.viete: coordinates"},
      {"reach", "1.4", "a.viete: reach: a reach must be 1.5 or more; leave it out for the whole cage"},
      {"reach", "-3", "a.viete: reach: a reach must be 1.5 or more"},
      {"reach", "\"far\"", "a.viete: reach: found a text where a number belongs"},
      {"camera", "[]", "a.viete: camera: found a list of 0 where an object belongs"},
      {"camera", R"({"target": [0, 0, 0], "distance": -1, "yaw": 0, "pitch": 0})", "camera.distance"},
      {"camera", R"({"target": [0, 0, "z"], "distance": 1, "yaw": 0, "pitch": 0})", "camera.target[2]"},
      {"view", R"({"grid": 1})", "a.viete: view.grid: found a number where true or false belongs"},
      {"window", "[1, 1]", "a.viete: window"},
      {"selection", "[1, -1]", "a.viete: selection[1]"},
      {"selection", "[1, 8]", "a.viete: selection: vertex 8 is selected, the cage"},
      {"pose", R"({"positions": [[0, 0, 0]]})", "a.viete: pose.positions: there are 1 vertices, the cage"},
      {"pose", R"({"positions": [[0, 0, 1e200]]})", "a.viete: pose.positions[0]: a number is too large"},
      {"pose", R"({"positions": 3})", "a.viete: pose.positions: found a number where a list belongs"},
      {"pose", "{}", "a.viete: pose: the key \"positions\" is missing"}};
  for (const auto& c : cases) {
    test::put_file(files / "a.viete", with(c.key, c.value));
    const std::string said = refusal(files / "a.viete");
    CHECK_MESSAGE(mentions(said, c.said), said);
  }
}

TEST_CASE("a_session_without_a_reach_has_the_whole_cage") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  w.document.reach = deform::whole_cage;
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK_FALSE(mentions(test::file_bytes(files / "a.viete"), "reach"));
  Workspace back;
  back.document.reach = 3;
  REQUIRE(open_now(back, {OpenRequest::What::model, {files / "a.viete"}}));
  CHECK(back.document.reach == deform::whole_cage);
}

TEST_CASE("more_turns_than_the_cage_has_parts_are_refused") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  w.document.pose.turns.resize(2);
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK(mentions(refusal(files / "a.viete"), "a.viete: pose.turns"));
}

TEST_CASE("another_format_and_a_newer_version_are_refused_with_advice") {
  const test::CubeFiles files;
  test::put_file(files / "a.viete", R"({"version": 1, "model": "model.obj"})");
  CHECK(mentions(refusal(files / "a.viete"), "not a session"));
  test::put_file(files / "a.viete", R"({"format": "viete session", "version": 2, "model": "model.obj"})");
  CHECK(mentions(refusal(files / "a.viete"), "version: the session has version 2"));
  for (const char* text : {"", "[]", "3", "{", "null", "\xff\xfe{}"}) {
    test::put_file(files / "a.viete", text);
    CHECK_MESSAGE(mentions(refusal(files / "a.viete"), "a.viete"), text);
  }
}

TEST_CASE("a_missing_or_broken_model_names_both_files") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  REQUIRE(save_session(w, files / "a.viete"));
  fs::rename(files.model, files / "away.obj");
  std::string said = refusal(files / "a.viete");
  CHECK_MESSAGE((mentions(said, "a.viete: model: ") && mentions(said, "model.obj: there is no such file")),
                said);
  fs::rename(files / "away.obj", files.model);
  fs::rename(files.broken, files.cage);
  said = refusal(files / "a.viete");
  CHECK_MESSAGE((mentions(said, "a.viete: cage: ") && mentions(said, "cage.obj:2")), said);
}

TEST_CASE("recovered_work_has_absolute_names_and_knows_its_session") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  w.saved.session = files / "mine.viete";
  test::put_file(files / "r.viete", session_text(session_of(w), files / "r.viete", false));
  const Session session = read_session(files / "r.viete");
  CHECK(session.model == fs::canonical(files.model));
  CHECK(session.origin == fs::canonical(files.path()) / "mine.viete");
  CHECK(read_session(files / "r.viete").pose->positions == w.document.pose.positions);
}

TEST_CASE("damaged_sessions_are_opened_or_refused_and_never_more") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  REQUIRE(save_session(w, files / "a.viete"));
  const std::string whole = test::file_bytes(files / "a.viete");
  const std::string noise = "0123456789-+.eE\"[]{},:tfn \x80";
  std::mt19937 random(3);
  int refused = 0;
  for (int i = 0; i < 1000; ++i) {
    std::string damaged = whole.substr(0, i % 4 == 0 ? random() % whole.size() : whole.size());
    for (unsigned n = random() % 4; n-- > 0 && !damaged.empty();) {
      damaged[random() % damaged.size()] = noise[random() % noise.size()];
    }
    test::put_file(files / "b.viete", damaged);
    Workspace back;
    if (open_now(back, {OpenRequest::What::model, {files / "b.viete"}})) continue;
    ++refused;
    CHECK(back.messages.all().back().text.find("b.viete") != std::string::npos);
    CHECK_FALSE(back.document.model.surface);
  }
  CHECK(refused > 300);
}

TEST_CASE("a_model_and_a_cage_whose_names_are_not_utf_8_come_back") {
  const test::CubeFiles files;
  const fs::path folder = files / "caf\xe9 100%";
  fs::create_directories(folder);
  fs::rename(files.model, folder / "m\xff.obj");
  fs::rename(files.cage, folder / "c\xff.obj");
  Workspace w;
  REQUIRE(load_model(w, folder / "m\xff.obj", folder / "c\xff.obj"));
  for (const fs::path& session : {folder / "s\xff.viete", files / "s.viete"}) {
    REQUIRE(save_session(w, session));
    Workspace back;
    REQUIRE(open_now(back, {OpenRequest::What::model, {session}}));
    CHECK(back.document.model.path.filename() == "m\xff.obj");
    CHECK(back.document.cage_file.path.filename() == "c\xff.obj");
  }
}
