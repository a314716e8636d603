#include "scene/files/session.h"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include "base/error.h"
#include "mesh/formats/read.h"
#include "scene/document/edit.h"
#include "scene/files.h"
#include "scene/files/json_file.h"
#include "scene/files/open.h"
#include "scene/files/session_parts.h"
#include "scene/hand/grip.h"
#include "scene/hand/placing.h"
#include "scene/workspace/apply_opened.h"
#include "scene/workspace/saving.h"
#include "scene/workspace/splitting.h"
#include "support/grips.h"
#include "support/open.h"
#include "support/text.h"

using namespace viete;
using test::mentions;
using namespace viete::scene;
namespace fs = std::filesystem;

namespace {

// Every setting of a session differs from its default.
Workspace worked(const test::CubeFiles& files) {
  Workspace w;
  w.viewport = {{1000, 800}, {320, 0}, {680, 774}};
  REQUIRE(test::load_model(w, files.model, files.cage));
  w.document.pose.positions[3] = {0.1, -1.0 / 3, 1e-17};
  w.document.pose.turns = {{0.1, 6.3, -1e-9}};
  w.document.selection.apply(std::vector<std::uint32_t>{2, 5}, SelectMode::replace);
  w.document.method = sym3::Method::sd;
  w.document.scheme = deform::scheme_of(deform::Way::mean_value);
  w.document.scheme.weighting.radius = 0.27;
  w.document.scheme.amounts = {0.29, 1.75};
  w.camera.set_pose({{0.1f, 0.2f, 0.3f}, 3.3f, -2.7f, 0.123f});
  w.view = {.dark = false,
            .model = false,
            .shading = Shading::checker,
            .wireframe = true,
            .cage = false,
            .grid = false,
            .ghost = true,
            .field = lab::Field::turn,
            .panels = false,
            .hints = false};
  put_ways(w.split, {{{deform::scheme_of(deform::Way::rigid), sym3::Method::sd, lab::Field::area, true},
                      {deform::scheme_of(deform::Way::arap)}},
                     false,
                     0.5,
                     {{{0, 0.1f, 0}, 5.5f, 1.25f, -0.2f}, {{1, 0, 0}, 2, 0, 0.5f, true}}});
  return w;
}

void check_same(const Workspace& a, const Workspace& b) {
  CHECK(a.document.pose.positions == b.document.pose.positions);
  CHECK(a.document.pose.turns == b.document.pose.turns);
  CHECK(a.document.selection == b.document.selection);
  CHECK(a.document.method == b.document.method);
  CHECK(a.document.scheme == b.document.scheme);
  CHECK(a.camera.pose() == b.camera.pose());
  CHECK(a.view == b.view);
  CHECK(ways_of(a) == ways_of(b));
  for (std::size_t view = 0; view < a.split.count(); ++view) CHECK(camera_of(a, view) == camera_of(b, view));
  CHECK(a.document.model.surface->positions == b.document.model.surface->positions);
}

std::string refusal(const fs::path& file) {
  Workspace w;
  CHECK_FALSE(open_now(w, {OpenRequest::What::model, {file}}));
  return w.messages.all().back().text;
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
  Workspace back = test::opened({files / "a.viete"});
  check_same(w, back);
  CHECK(back.saved.session == files / "a.viete");
  CHECK_FALSE(has_unsaved_edits(back));
  back.viewport = w.viewport;
  CHECK(session_text(session_of(back), files / "a.viete") == test::file_bytes(files / "a.viete"));
}

TEST_CASE("cameras_of_views_are_kept_wherever_the_hand_is") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  const CameraPose first = w.camera.pose();
  enter_view(w, 2);
  w.camera.orbit({30, 10});
  const CameraPose moved = w.camera.destination();
  REQUIRE(save_session(w, files / "a.viete"));
  Workspace back = test::opened({files / "a.viete"});
  CHECK(back.split.active == 0);
  CHECK(camera_of(back, 0) == first);
  CHECK(camera_of(back, 1) == camera_of(w, 1));
  CHECK(camera_of(back, 2) == moved);
  test::put_file(files / "a.viete", with("cameras", "[{}]"));
  const Session session = read_session(files / "a.viete");
  REQUIRE(session.warnings.size() == 1);
  CHECK(mentions(session.warnings[0],
                 "a.viete: cameras: their number differs from the number of additional views; all views"));
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
  Workspace back = test::opened({elsewhere / "moved" / "one" / "deep" / "a.viete"});
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

TEST_CASE("session_errors_name_file_and_key") {
  const test::CubeFiles files;
  const struct {
    const char *key, *value, *said;
  } cases[] = {
      {"cage", "7", "a.viete: cage: found a number where the name of a file belongs"},
      {"pose", R"({"positions": [[0, 0, 0]]})",
       "a.viete: pose.positions: this is a pose of a vertex, the cage"},
      {"pose", R"({"positions": 3})", "a.viete: pose.positions: found a number where a list belongs"},
      {"pose", "{}", "a.viete: pose: the key \"positions\" is missing"}};
  for (const auto& c : cases) {
    test::put_file(files / "a.viete", with(c.key, c.value));
    const std::string said = refusal(files / "a.viete");
    CHECK_MESSAGE(mentions(said, c.said), said);
  }
}

TEST_CASE("a_damaged_part_of_a_session_is_skipped_with_a_warning") {
  const test::CubeFiles files;
  const struct {
    const char *key, *value, *said;
  } cases[] = {
      {"method", "\"best\"", "a.viete: method: \"best\" is not known; fast instead (choices: diag"},
      {"method", "7", "a.viete: method: found a number where a text belongs; fast instead"},
      {"radius", "0.01", "a.viete: radius: a radius must be 0.1 to 1000 percent"},
      {"turn", "201", "a.viete: turn: an amount must be 0 to 200 percent; 100 percent instead"},
      {"stretch", "-1", "a.viete: stretch: an amount must be 0 to 200 percent; 100 percent instead"},
      {"stitched", "0", "a.viete: stitched: iterations must be 1 to 20; not stitched instead"},
      {"stitched", "21", "a.viete: stitched: iterations must be 1 to 20"},
      {"stitched", "true", "a.viete: stitched: found"},
      {"pins", "101", "a.viete: pins: it must be 0 to 100 percent; 0 instead"},
      {"hold", "-1", "a.viete: hold: it must be 0 to 100 percent; 0 instead"},
      {"radius", "-1e999", "a.viete: radius"},
      {"radius", "\"far\"", "a.viete: radius: found a text where a number belongs"},
      {"camera", "[]",
       "a.viete: camera: found a list of 0 where an object belongs; the whole model is shown"},
      {"camera", R"({"target": [0, 0, 0], "distance": -1, "yaw": 0, "pitch": 0})", "camera.distance"},
      {"camera", R"({"target": [0, 0, 0], "distance": 1e9, "yaw": 0, "pitch": 0})", "camera.distance"},
      {"camera", R"({"target": [0, 0, 0], "distance": 1, "yaw": null, "pitch": 0})",
       "camera: the key \"yaw\""},
      {"camera", R"({"target": [0, 0, 0], "distance": 1, "yaw": 0, "pitch": 1e308})", "camera.pitch"},
      {"camera", R"({"target": [0, 1e308, 0], "distance": 1, "yaw": 0, "pitch": 0})",
       "camera.target: this coordinate is too large"},
      {"camera", R"({"target": [0, null, 0], "distance": 1, "yaw": 0, "pitch": 0})",
       "camera.target[1]: found null"},
      {"camera", R"({"target": [0, 0, "z"], "distance": 1, "yaw": 0, "pitch": 0})", "camera.target[2]"},
      {"view", R"({"grid": 1})", "a.viete: view.grid: found a number where true or false belongs; it stays"},
      {"view", "3", "a.viete: view"},
      {"window", "[1, 1]", "a.viete: window: this is not a valid window size; the usual size instead"},
      {"window", "[8192, 8192]", "a.viete: window: this is not a valid window size"},
      {"window", "[1e999, 800]", "a.viete: window: this is not a valid window size"},
      {"session", "7",
       "a.viete: session: found a number where the name of a file belongs; saving asks for a name"},
      {"selecting", "\"holes\"", "a.viete: selecting: \"holes\" is not known; nothing is selected"},
      {"selection", "[1, -1]",
       "a.viete: selection[1]: found a number where a whole number from 0 on belongs"},
      {"selection", "[1, 8]", "a.viete: selection: vertex 8 is selected, the cage"},
      {"selecting\": \"edges\", \"selection", "[99]", "has 18 edges; nothing is selected instead"},
      {"selecting\": \"faces\", \"selection", "[12]", "face 12 is selected, the cage"},
      {"selecting\": \"faces\", \"selection", "[12]", "has 12 faces"}};
  for (const auto& c : cases) {
    test::put_file(files / "a.viete", with(c.key, c.value));
    Workspace w;
    REQUIRE_MESSAGE(open_now(w, {OpenRequest::What::model, {files / "a.viete"}}), c.value);
    REQUIRE(w.messages.all().size() == 1);
    CHECK(w.messages.all()[0].severity == Severity::warning);
    CHECK_MESSAGE(mentions(w.messages.all()[0].text, c.said), w.messages.all()[0].text);
    CHECK(w.document.method == sym3::Method::fast);
    CHECK(w.document.scheme.weighting.radius == 0.25);
    CHECK_FALSE(w.document.scheme.stitched());
    CHECK(w.document.selection.empty());
    CHECK(std::isfinite(w.camera.pose().target.y));
    CHECK(w.view == ViewOptions{});
  }
}

TEST_CASE("one_bad_number_of_a_pose_resets_its_vertex") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  w.document.pose.positions[0] = {9, 9, 9};
  w.document.pose.positions[5] = {-8, 8, 8};
  REQUIRE(save_session(w, files / "a.viete"));
  const std::string whole = test::file_bytes(files / "a.viete");
  const auto opened = [&](const std::string& from, const std::string& to) {
    std::string damaged = whole;
    const auto at = damaged.find(from);
    REQUIRE(at != std::string::npos);
    test::put_file(files / "a.viete", damaged.replace(at, from.size(), to));
    Workspace back = test::opened({files / "a.viete"});
    return back;
  };
  for (const char* bad :
       {"[9.0,9.0,1e200]", "[9.0,9.0,1e999]", "[9.0,null,9.0]", "[9.0,9.0]", "\"x\"", "{}"}) {
    const Workspace back = opened("[9.0,9.0,9.0]", bad);
    CHECK(back.document.pose.positions[0] == back.document.cage->surface.positions[0]);
    CHECK(back.document.pose.positions[5] == mesh::Point{-8, 8, 8});
    REQUIRE(back.messages.all().size() == 1);
    const std::string said = back.messages.all()[0].text;
    CHECK_MESSAGE(mentions(said, "a.viete: pose.positions[0]"), said);
    CHECK_MESSAGE(mentions(said, "; vertex 0 is at rest instead"), said);
  }
  const Workspace turned = opened("6.3", "1e9");
  CHECK(turned.document.pose.turns == std::vector<deform::Vec3>{{0, 0, 0}});
  CHECK(mentions(turned.messages.all()[0].text,
                 "pose.turns[0]: a number is too large; part 0 is without full rotations"));
  const Workspace none = opened("\"turns\": [\n      [0.1,6.3,-1e-09]\n    ]", "\"turns\": 3");
  CHECK(none.document.pose.turns.empty());
  CHECK(none.document.pose.positions[5] == mesh::Point{-8, 8, 8});
}

TEST_CASE("all_typed_values_and_views_survive_saving") {
  const test::CubeFiles files;
  for (const double amount : {1e150, -1e150, 1e99, 1e20, 1e5, 1e-300}) {
    Workspace w = worked(files);
    w.view.cage = true;
    Transform t;
    t.shift = {amount, 0, 0};
    t.factors = {1, amount, 1};
    t.degrees = amount;
    for (const Tool tool : {Tool::move, Tool::scale, Tool::rotate})
      transform_selection(w.document, tool, test::plain_grip(w.document), t);
    frame_selection(w, false);
    w.camera.pan({1e30f, -1e30f}, w.viewport);
    REQUIRE(save_session(w, files / "a.viete"));
    CHECK_FALSE(mentions(test::file_bytes(files / "a.viete"), "null"));
    Workspace back = test::opened({files / "a.viete"});
    CHECK(back.messages.all().empty());
    check_same(w, back);
  }
}

TEST_CASE("more_turns_than_the_cage_has_parts_are_refused") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  w.document.pose.turns.resize(2);
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK(mentions(refusal(files / "a.viete"), "a.viete: pose.turns"));
}

TEST_CASE("weights_and_blend_are_kept_and_older_programs_read_what_they_know") {
  const test::CubeFiles files;
  for (deform::Scheme scheme : deform::valid_schemes()) {
    CAPTURE(text(scheme));
    scheme.weighting.radius = 0.3;
    Workspace w = test::opened({files.model, files.cage});
    w.document.scheme = scheme;
    REQUIRE(save_session(w, files / "a.viete"));
    const auto json = read_json(files / "a.viete");
    CHECK(json["weights"] == std::string(deform::entry(scheme.weighting.weights).name));
    CHECK(json["blend"] == std::string(deform::entry(scheme.blend).name));
    CHECK_FALSE(json.contains("stitched"));
    Workspace back = test::opened({files / "a.viete"});
    CHECK(back.document.scheme == w.document.scheme);
    CHECK(back.document.scheme.weighting.radius == 0.3);
  }
}

TEST_CASE("stitching_is_kept_and_refused_where_it_cannot_be") {
  const test::CubeFiles files;
  for (const int iterations : {1, 3, deform::most_iterations}) {
    Workspace w = test::opened({files.model, files.cage});
    w.document.scheme.iterations = iterations;
    REQUIRE(save_session(w, files / "a.viete"));
    const auto json = read_json(files / "a.viete");
    CHECK(json["stitched"] == iterations);
    Workspace back = test::opened({files / "a.viete"});
    CHECK(back.document.scheme.iterations == iterations);
  }
  for (const int iterations : {0, 2}) {  // stored for later stitching
    Workspace w = test::opened({files.model, files.cage});
    w.document.scheme.iterations = iterations;
    w.document.scheme.holding = {0.29, 0.07};
    REQUIRE(save_session(w, files / "a.viete"));
    CHECK(read_json(files / "a.viete")["pins"] == 29);
    CHECK(read_session(files / "a.viete").scheme == w.document.scheme);
  }
  test::put_file(files / "a.viete", with("weights\": \"mean-value\", \"stitched", "1"));
  const Session session = read_session(files / "a.viete");
  CHECK_FALSE(session.scheme.stitched());
  REQUIRE(session.warnings.size() == 1);
  CHECK(mentions(session.warnings[0], "a.viete: stitched: cage vertices give no maps"));
}

TEST_CASE("settings_of_weights_are_kept_and_those_out_of_range_are_told") {
  const test::CubeFiles files;
  for (const deform::Weighting& weighting :
       {deform::Weighting{deform::Elements::face, deform::Weights::cut_off, 0.29},
        deform::Weighting{deform::Elements::face, deform::Weights::biharmonic, 0.29}}) {
    Workspace w = test::opened({files.model, files.cage});
    w.document.scheme.weighting = weighting;
    REQUIRE(save_session(w, files / "a.viete"));
    const auto json = read_json(files / "a.viete");
    CHECK(json["radius"] == 29);
    Workspace back = test::opened({files / "a.viete"});
    const deform::Weighting& kept = back.document.scheme.weighting;
    CHECK(kept == weighting);
    CHECK(kept.radius == 0.29);  // also settings these weights do not use
  }
  const struct {
    const char *key, *value, *warning;
  } wrong[] = {
      {"radius", "0", "radius: a radius must be 0.1 to 1000 percent of the cage's size; 25 percent instead"},
      {"radius", "1001", "radius: a radius must be 0.1"}};
  for (const auto& w : wrong) {
    test::put_file(files / "a.viete", with(w.key, w.value));
    const Session session = read_session(files / "a.viete");
    REQUIRE(session.warnings.size() == 1);
    CHECK_MESSAGE(mentions(session.warnings[0], w.warning), session.warnings[0]);
    CHECK(session.scheme == deform::Scheme{});
  }
}

TEST_CASE("a_session_may_name_any_part_of_a_scheme") {
  const test::CubeFiles files;
  const auto scheme = [&](const std::string& keys) {
    test::put_file(files / "a.viete",
                   R"({"format": "viete session", "version": 1, "model": "model.obj", "cage": "cage.obj", )" +
                       keys + "}");
    return read_session(files / "a.viete");
  };
  const auto word = [](const Session& s) { return text(s.scheme); };
  CHECK(word(scheme(R"("radius": 30)")) == "inverse, srl");
  CHECK(word(scheme(R"("weights": "mean-value")")) == "mean-value, linear");
  CHECK(word(scheme(R"("blend": "linear")")) == "inverse, linear");
  CHECK(scheme(R"("blend": "linear")").warnings.empty());
  CHECK(word(scheme(R"("blend": "mls-rigid", "weights": "biharmonic")")) == "biharmonic, mls-rigid");
  const Session apart = scheme(R"("blend": "srl", "weights": "mean-value")");
  CHECK(word(apart) == "inverse, srl");
  REQUIRE(apart.warnings.size() == 1);
  CHECK(mentions(apart.warnings[0], "a.viete: blend: these weights and this blend cannot be combined"));
  const Session unknown = scheme(R"("blend": "magic", "weights": "mean-value")");
  CHECK(word(unknown) == "mean-value, linear");
  REQUIRE(unknown.warnings.size() == 1);
  CHECK(mentions(unknown.warnings[0], "a.viete: blend: \"magic\" is not known; a matching one instead"));
}

TEST_CASE("another_format_and_another_version_are_refused_with_advice") {
  const test::CubeFiles files;
  test::put_file(files / "a.viete", R"({"version": 1, "model": "model.obj"})");
  CHECK(mentions(refusal(files / "a.viete"), "not a session"));
  test::put_file(files / "a.viete", R"({"format": "viete session", "version": 2, "model": "model.obj"})");
  CHECK(mentions(refusal(files / "a.viete"),
                 "version: the session has version 2, this version of Viete reads 1"));
  for (const char* text : {"", "[]", "3", "{", "null", "\xff\xfe{}"}) {
    test::put_file(files / "a.viete", text);
    CHECK_MESSAGE(mentions(refusal(files / "a.viete"), "a.viete"), text);
  }
}

namespace {

// The same cage with reordered vertices.
void permute(const fs::path& cage) {
  mesh::Surface surface = mesh::read(cage).surface;
  const auto n = static_cast<std::uint32_t>(surface.positions.size());
  std::reverse(surface.positions.begin(), surface.positions.end());
  for (auto& t : surface.triangles) {
    for (auto& v : t) v = n - 1 - v;
  }
  mesh::write(cage, mesh::from_triangles(surface.positions, surface.triangles));
}

std::vector<std::string> said_on_opening(const fs::path& session) {
  Workspace w = test::opened({session});
  std::vector<std::string> all;
  for (const auto& message : w.messages.all()) all.push_back(message.text);
  return all;
}

}  // namespace

TEST_CASE("opening_a_session_warns_of_a_changed_model_or_cage") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  REQUIRE(save_session(w, files / "a.viete"));
  fs::copy(files.cage, files / "same.obj");
  fs::rename(files / "same.obj", files.cage);  // a new file with the old content
  CHECK(said_on_opening(files / "a.viete").empty());

  permute(files.cage);
  auto said = said_on_opening(files / "a.viete");
  REQUIRE(said.size() == 1);
  CHECK_MESSAGE((mentions(said[0], "a.viete: cage: ") && mentions(said[0], "cage.obj has changed since")),
                said[0]);
  CHECK(mentions(said[0], "restore the older file"));

  mesh::write(files.model, test::cube(1.25));
  said = said_on_opening(files / "a.viete");
  REQUIRE(said.size() == 2);
  CHECK(mentions(said[0], "model.obj has changed since"));

  Workspace again = test::opened({files / "a.viete"});
  REQUIRE(save_session(again, files / "a.viete"));
  CHECK_MESSAGE(said_on_opening(files / "a.viete").empty(), "what was saved since is of the new ones");
}

TEST_CASE("a_session_of_an_older_program_and_one_with_odd_keys_opens_too") {
  const test::CubeFiles files;
  test::put_file(files / "a.viete", with("method", "\"fast\""));
  CHECK(said_on_opening(files / "a.viete").empty());
  for (const char* odd : {"\"xyz\"", "7", "[]", "\"00\"", "\"0123456789abcdeg\""}) {
    test::put_file(files / "a.viete", with("cage_content", odd));
    const auto said = said_on_opening(files / "a.viete");
    REQUIRE(said.size() == 1);
    CHECK_MESSAGE((mentions(said[0], "a.viete: cage_content: ") && mentions(said[0], "it is unknown")),
                  said[0]);
  }
}

TEST_CASE("a_pose_that_is_cut_short_is_not_blamed_on_the_cage") {
  const test::CubeFiles files;
  Workspace w = worked(files);
  w.document.pose.positions.pop_back();
  REQUIRE(save_session(w, files / "a.viete"));
  CHECK(mentions(refusal(files / "a.viete"), "use an older copy"));
  mesh::write(files.cage, test::cube(1.25));
  CHECK(mentions(refusal(files / "a.viete"), "the cage has changed"));
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
    if (open_now(back, {OpenRequest::What::model, {files / "b.viete"}})) {
      for (const auto& p : back.document.pose.positions) CHECK(std::isfinite(p[0] + p[1] + p[2]));
      continue;
    }
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
  REQUIRE(test::load_model(w, folder / "m\xff.obj", folder / "c\xff.obj"));
  for (const fs::path& session : {folder / "s\xff.viete", files / "s.viete"}) {
    REQUIRE(save_session(w, session));
    Workspace back = test::opened({session});
    CHECK(back.document.model.path.filename() == "m\xff.obj");
    CHECK(back.document.cage_file.path.filename() == "c\xff.obj");
  }
}
